"""HDF5 files that vitrum did not write, most of them a result with one thing about it changed: {name: writer(path, result)}."""
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
        file["steps"][f"{index:05d}"] = file["steps/00000"]


mass, position, kinetic = "particles/mass", "steps/00000/particles/position", "series/kinetic"
huge = 1 << 50
writers = {
    "empty": _empty,
    "old_format": _old_format,
    "variable_texts": _variable_texts,
    "format_of_another_version": _set_attribute("/", ".format", np.bytes_("vitrum result 1")),
    "format_is_a_number": _set_attribute("/", ".format", 2),
    "time_is_text": _set_attribute("steps/00000", "time", np.bytes_("now")),
    "time_is_a_list": _set_attribute("steps/00000", "time", [0.0, 1.0]),
    "time_is_nothing": _set_attribute("steps/00000", "time", h5py.Empty("f8")),
    "step_index_is_real": _set_attribute("steps/00000", "step_index", 0.5),
    "bodies_missing": _changed(lambda file: file.__delitem__("bodies")),
    "steps_missing": _changed(lambda file: file.__delitem__("steps")),
    "series_missing": _changed(lambda file: file.__delitem__("series")),
    "step_missing": _changed(lambda file: file.move("steps/00000", "steps/00099")),
    "steps_is_data": _replaced("steps", _dataset(data=[1.0])),
    "bodies_are_numbers": _replaced("bodies", _dataset(data=[1.0, 2.0])),
    "no_body": _replaced("bodies", _dataset(data=np.array([b"plate"]))),
    "body_is_signed": _replaced("particles/body", _dataset(data=np.zeros(200, "i4"))),
    "position_is_single": _replaced(position, _dataset(data=np.zeros((200, 2), "f4"))),
    "position_is_compound": _replaced(position, _dataset(data=np.zeros(200, [("r", "f8"), ("z", "f8")]))),
    "position_has_three_dimensions": _replaced(position, _dataset(data=np.zeros((10, 10, 4)))),
    "position_has_thirty_dimensions": _replaced(position, _dataset(data=np.zeros((1,) * 30))),
    "position_is_nothing": _replaced(position, _dataset(data=h5py.Empty("f8"))),
    "position_is_huge": _replaced(position, _dataset(shape=(huge, 2), dtype="f8", chunks=(1024, 2))),
    "position_is_huge_in_both": _replaced(position, _dataset(shape=(1 << 40, 1 << 40), dtype="f8", chunks=(32, 32))),
    "position_is_huge_and_contiguous": _replaced(position, _dataset(shape=(1 << 28, 2), dtype="f8")),
    "position_is_compressed_and_huge": _replaced(position, _dataset(shape=(1 << 40,), dtype="f8", chunks=(1 << 20,), compression=9)),
    "kinetic_is_huge": _replaced(kinetic, _dataset(shape=(huge,), dtype="f8", chunks=(128,), maxshape=(None,))),
    "bodies_are_huge": _replaced("bodies", _dataset(shape=(2,), dtype="S2000000000", chunks=(1,))),
    "mass_is_elsewhere": _replaced(mass, _dataset(shape=(200,), dtype="f8", external=[("/dev/zero", 0, 1600)])),
    "position_is_elsewhere": _replaced(position, _dataset(shape=(200, 2), dtype="f8", external=[("/dev/zero", 0, 3200)])),
    "position_is_virtual": _replaced(position, _virtual),
    "steps_loop": _replaced("steps", _loop),
    "steps_cycle": _replaced("steps", _cycle),
    "steps_in_another_file": _replaced("steps", lambda file, name: file.__setitem__(name, h5py.ExternalLink("/dev/zero", "/x"))),
    "position_in_another_file": _replaced(position, lambda file, name: file.__setitem__(name, h5py.ExternalLink("good.h5", position))),
    "position_dangles": _replaced(position, lambda file, name: file.__setitem__(name, h5py.SoftLink("/nowhere"))),
    "many_steps": _changed(_many_steps),
}
