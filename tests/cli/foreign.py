"""HDF5 files that vitrum did not write, most of them a part of a result with one thing about it changed:
{name: (part, writer(path, original))}."""
import shutil

import h5py
import numpy as np


def _changed(change):
    def write(path, result):
        shutil.copy(result, path)
        with h5py.File(path, "r+", libver=("v110", "v110")) as file:
            change(file)
    return write


def _replaced(name, make):
    def change(file):
        attributes = dict(file[name].attrs)
        del file[name]
        make(file, name)
        if name in file and isinstance(file.get(name, getlink=True), h5py.HardLink):
            file[name].attrs.update(attributes)
    return _changed(change)


def _dataset(**arguments):
    return lambda file, name: file.create_dataset(name, **arguments)


def _empty(path, result):
    h5py.File(path, "w").close()


def _old_format(path, result):
    """The same content as HDF5's first format stores it: no checksum anywhere."""
    with h5py.File(result) as source, h5py.File(path, "w", libver="earliest") as file:
        def copy(name, item):
            # (HDF5 1.10 crashes when it copies texts of variable length between its formats.)
            if isinstance(item, h5py.Dataset):
                source.copy(item, file, name, without_attrs=True)
            else:
                file.require_group(name)
            file[name].attrs.update(item.attrs)

        source.visititems(copy)
        file.attrs.update(source.attrs)
        for name in ("particles", *(f"steps/{step}" for step in source["steps"])):
            file[name] = source.get(name, getlink=True)


def _variable_texts(path, result):
    shutil.copy(result, path)
    with h5py.File(path, "r+") as file:
        file.attrs[".title"] = "of variable length"


def _set_attribute(object_name, name, value):
    def change(file):
        del file[object_name].attrs[name]
        file[object_name].attrs[name] = value
    return _changed(change)


def _virtual(file, name):
    layout = h5py.VirtualLayout(shape=(4,), dtype="f8")
    layout[:] = h5py.VirtualSource("elsewhere.h5", "x", shape=(4,))
    file.create_virtual_dataset(name, layout)


def _loop(file, name):
    file[name] = h5py.SoftLink("/" + name)


def _cycle(file, name):
    group = file.create_group(name)
    group["00000"] = file["/"]


def _many_steps(file):
    for index in range(len(file["steps"]), 3000):
        file["steps"][f"{index:05d}"] = h5py.ExternalLink("steps/00000.h5", "/")


door, output, constants = "result.h5", "steps/00000.h5", "steps/particles.h5"
mass, position, kinetic = "particles/mass", "particles/position", "series/kinetic"
huge = 1 << 50
writers = {
    "empty": (door, _empty),
    "old_format": (door, _old_format),
    "variable_texts": (door, _variable_texts),
    "format_of_another_version": (door, _set_attribute("/", ".format", np.bytes_("vitrum result 2"))),
    "format_is_a_number": (door, _set_attribute("/", ".format", 2)),
    "time_is_text": (output, _set_attribute("/", "time", np.bytes_("now"))),
    "time_is_a_list": (output, _set_attribute("/", "time", [0.0, 1.0])),
    "time_is_nothing": (output, _set_attribute("/", "time", h5py.Empty("f8"))),
    "step_index_is_real": (output, _set_attribute("/", "step_index", 0.5)),
    "bodies_missing": (door, _changed(lambda file: file.__delitem__("bodies"))),
    "steps_missing": (door, _changed(lambda file: file.__delitem__("steps"))),
    "series_missing": (door, _changed(lambda file: file.__delitem__("series"))),
    "step_missing": (door, _changed(lambda file: file.move("steps/00000", "steps/00099"))),
    "steps_is_data": (door, _replaced("steps", _dataset(data=[1.0]))),
    "bodies_are_numbers": (door, _replaced("bodies", _dataset(data=[1.0, 2.0]))),
    "no_body": (door, _replaced("bodies", _dataset(data=np.array([b"plate"])))),
    "body_is_signed": (constants, _replaced("particles/body", _dataset(data=np.zeros(200, "i4")))),
    "position_is_single": (output, _replaced(position, _dataset(data=np.zeros((200, 2), "f4")))),
    "position_is_compound": (output, _replaced(position, _dataset(data=np.zeros(200, [("r", "f8"), ("z", "f8")])))),
    "position_has_three_dimensions": (output, _replaced(position, _dataset(data=np.zeros((10, 10, 4))))),
    "position_has_thirty_dimensions": (output, _replaced(position, _dataset(data=np.zeros((1,) * 30)))),
    "position_is_nothing": (output, _replaced(position, _dataset(data=h5py.Empty("f8")))),
    "position_is_huge": (output, _replaced(position, _dataset(shape=(huge, 2), dtype="f8", chunks=(1024, 2)))),
    "position_is_huge_in_both": (output, _replaced(position, _dataset(shape=(1 << 40, 1 << 40), dtype="f8", chunks=(32, 32)))),
    "position_is_huge_and_contiguous": (output, _replaced(position, _dataset(shape=(1 << 28, 2), dtype="f8"))),
    "position_is_compressed_and_huge": (output, _replaced(position, _dataset(shape=(1 << 40,), dtype="f8", chunks=(1 << 20,), compression=9))),
    "kinetic_is_huge": (door, _replaced(kinetic, _dataset(shape=(huge,), dtype="f8", chunks=(128,), maxshape=(None,)))),
    "bodies_are_huge": (door, _replaced("bodies", _dataset(shape=(2,), dtype="S2000000000", chunks=(1,)))),
    "mass_is_elsewhere": (constants, _replaced(mass, _dataset(shape=(200,), dtype="f8", external=[("/dev/zero", 0, 1600)]))),
    "position_is_elsewhere": (output, _replaced(position, _dataset(shape=(200, 2), dtype="f8", external=[("/dev/zero", 0, 3200)]))),
    "position_is_virtual": (output, _replaced(position, _virtual)),
    "steps_loop": (door, _replaced("steps", _loop)),
    "steps_cycle": (door, _replaced("steps", _cycle)),
    "steps_in_another_file": (door, _replaced("steps", lambda file, name: file.__setitem__(name, h5py.ExternalLink("/dev/zero", "/x")))),
    "position_in_another_file": (output, _replaced(position, lambda file, name: file.__setitem__(name, h5py.ExternalLink("00001.h5", position)))),
    "position_dangles": (output, _replaced(position, lambda file, name: file.__setitem__(name, h5py.SoftLink("/nowhere")))),
    "many_steps": (door, _changed(_many_steps)),
}
