"""result.xdmf through the XDMF readers of ParaView, which bring VTK (Debian's python3-paraview; its python3-vtk9 has none): blocks,
names, components, and values equal to those of the HDF5 files. studies/paraview_run.py on the same run."""
import importlib
import os
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from support import CommandLineTest, overrides, plane_strain, source

readers = {}
for module, name in (("vtkIOXdmf2", "vtkXdmfReader"), ("vtkIOXdmf3", "vtkXdmf3Reader")):
    try:
        readers[name] = getattr(importlib.import_module(f"vtkmodules.{module}"), name)
    except (ImportError, AttributeError):
        pass


def blocks_at(reader_class, path, number):
    """{name: {array: values}} of output `number`, points as "points"."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    reader = reader_class()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    times = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    information = reader.GetOutputInformation(0)
    reader.UpdateTimeStep(information.Get(times, number))
    data = reader.GetOutputDataObject(0)
    found = {}
    for block in range(data.GetNumberOfBlocks()):
        grid, arrays = data.GetBlock(block), {}
        arrays["points"] = vtk_to_numpy(grid.GetPoints().GetData()).copy()
        for array in range(grid.GetPointData().GetNumberOfArrays()):
            arrays[grid.GetPointData().GetArrayName(array)] = vtk_to_numpy(grid.GetPointData().GetArray(array)).copy()
        found[data.GetMetaData(block).Get(vtkCompositeDataSet.NAME()).split("[")[0]] = arrays
        assert grid.GetNumberOfCells() == grid.GetNumberOfPoints()
    return information.Length(times), found


def expected(result, step, body):
    """What is to be read, from the fields of the HDF5 files."""
    rows = result["particles/body"][()] == body
    fields = {name: data[()][rows] for name, data in result["steps"][step]["particles"].items()}
    flat = np.zeros(rows.sum())
    arrays = {name: values for name, values in fields.items() if values.ndim == 1 and not name.startswith("normal_")}
    arrays["points"] = np.column_stack([fields["position"], flat])
    arrays["velocity"] = np.column_stack([fields["velocity"], flat])
    if "normal_r" in fields:
        arrays["normal"] = np.column_stack([fields["normal_r"], fields["normal_z"], flat])
    for name in ("stress", "elastic_strain"):
        if name in fields:
            arrays[name] = np.column_stack([fields[name], flat, flat])
    rr, zz, tt, rz = fields["stress"].T
    deviator = np.array([rr, zz, tt]) + (pressure := -(rr + zz + tt) / 3.0)
    arrays["pressure"] = pressure
    arrays["von_mises"] = np.sqrt(1.5 * (np.sum(deviator**2, axis=0) + 2.0 * rz**2))
    arrays["mass"], arrays["size"] = result["particles/mass"][()][rows], result["particles/size"][()][rows]
    return arrays


@unittest.skipUnless(readers, "no XDMF reader of VTK (python3-paraview)")
class ParaView(CommandLineTest):
    def assert_readable(self, out, number):
        with h5py.File(out / "result.h5") as result:
            steps, names = sorted(result["steps"]), [name.decode() for name in result["bodies"]]
            for reader in readers.values():
                count, found = blocks_at(reader, out / "result.xdmf", number)
                self.assertEqual(count, len(steps))
                self.assertEqual(list(found), names)
                for body, name in enumerate(names):
                    arrays = expected(result, steps[number], body)
                    separable = "fragment" in found[name]
                    self.assertEqual(set(found[name]) - {"fragment"}, set(arrays), (reader.__name__, name))
                    for field, values in arrays.items():
                        shown = found[name][field]
                        self.assertEqual(shown.shape, values.shape, (reader.__name__, name, field))
                        if field in ("pressure", "von_mises"):
                            np.testing.assert_allclose(shown, values, rtol=1e-9, atol=1e-9 * np.abs(arrays["stress"]).max(initial=0.0))
                        elif field == "points":  # VTK's points may be of single precision
                            np.testing.assert_allclose(shown, values, rtol=1e-6, atol=1e-9)
                        else:
                            np.testing.assert_array_equal(shown, values, f"{reader.__name__}, {name}, {field}")
                    if separable and "decohesion" in arrays:
                        decohesion, fragment = arrays["decohesion"], found[name]["fragment"]
                        np.testing.assert_array_equal(fragment == -1.0, decohesion >= 1.0)

    def test_axisymmetric(self):
        out = self.run_scene("out")
        for number in (0, 1, 10):
            self.assert_readable(out, number)

    def test_plane_strain_and_elastic_strain(self):
        """In a folder that has been moved, with names that XML must escape."""
        scene = self.folder / "scene.toml"
        scene.write_text(plane_strain.read_text().replace('name = "disk"', 'name = "a <disk> & \\"co\\""'))
        out = self.run_scene("here", *overrides(output__fields='["velocity", "stress", "elastic_strain"]'), scene=scene)
        (self.folder / "over there").mkdir()
        self.assert_readable(out.rename(self.folder / "over there" / "run"), 1)

    @unittest.skipIf(shutil.which("pvpython") is None or shutil.which("xvfb-run") is None, "pvpython or xvfb-run is missing")
    def test_picture(self):
        out, picture = self.run_scene("out"), self.folder / "picture.png"
        for _ in range(3):  # on a busy machine a display may come too late
            done = subprocess.run(["xvfb-run", "-a", "pvpython", source / "studies" / "paraview_run.py", out, "--picture", picture],
                                  capture_output=True, text=True, timeout=120, env={**os.environ, "HOME": str(self.folder)})
            if done.returncode == 0:
                break
        self.assertEqual(done.returncode, 0, done.stderr)
        from matplotlib.image import imread
        pixels = imread(picture)[..., :3]
        drawn = np.any(np.abs(pixels - pixels[0, 0]) > 0.05, axis=2)
        self.assertGreater(drawn.mean(), 0.05)
        # Reflected at the axis: particles on both sides of the middle.
        columns = np.flatnonzero(drawn[: len(drawn) * 3 // 4].any(axis=0))
        self.assertLess(columns.min(), pixels.shape[1] // 3)
        self.assertGreater(columns.max(), pixels.shape[1] * 2 // 3)


if __name__ == "__main__":
    unittest.main()
