"""Sets up a picture of a run in ParaView (5.11 and later).

    pvpython studies/paraview_run.py OUT [--picture FILE.png]     or, from ParaView's Python shell: run this file after `out = "OUT"`

Every particle is a square of its size at the start, coloured by how far its crack plane has separated (`decohesion`, 0 to 1; by
`damage` or the body's velocity where a run has none), at the last output; an axisymmetric run is reflected at its axis.
"""
import argparse
import pathlib
import tomllib

import h5py
from paraview import simple


def geometry_of(out):
    with h5py.File(out / "result.h5") as result:
        return tomllib.loads(result["scene/resolved"][()].decode())["space"]["geometry"]


def colour_field(reader):
    """The first of these that the run has."""
    known = [reader.PointData.GetArray(number).Name for number in range(reader.PointData.GetNumberOfArrays())]
    return next(name for name in ("decohesion", "damage", "velocity", "mass") if name in known)


def show(out):
    """The view with the run in the folder `out`."""
    reader = simple.Xdmf3ReaderS(FileName=[str(out.resolve() / "result.xdmf")])
    reader.UpdatePipeline(reader.TimestepValues[-1] if hasattr(reader.TimestepValues, "__len__") else reader.TimestepValues)
    source = reader
    if geometry_of(out) == "axisymmetric":
        source = simple.Reflect(Input=reader, Plane="X", Center=0.0, CopyInput=1)
    squares = simple.Glyph(Input=source, GlyphType="2D Glyph", GlyphMode="All Points")
    squares.GlyphType.GlyphType, squares.GlyphType.Filled = "Square", 1  # its side is 1
    squares.OrientationArray = ["POINTS", "No orientation array"]
    squares.ScaleArray, squares.ScaleFactor = ["POINTS", "size"], 1.0
    view = simple.GetActiveViewOrCreate("RenderView")
    view.InteractionMode, view.ViewSize, view.OrientationAxesVisibility = "2D", [1600, 900], 0
    view.ViewTime = simple.GetTimeKeeper().TimestepValues[-1]
    field = colour_field(reader)
    shown = simple.Show(squares, view)
    simple.ColorBy(shown, ("POINTS", field))
    table = simple.GetColorTransferFunction(field)
    table.ApplyPreset("Cool to Warm", True)
    if field in ("decohesion", "damage"):
        table.RescaleTransferFunction(0.0, 1.0)
    table.NanColor = [0.7, 0.7, 0.7]  # bodies without that model
    shown.SetScalarBarVisibility(view, True)
    simple.ResetCamera(view)
    return view


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", metavar="OUT", type=pathlib.Path, help="folder of a run")
    parser.add_argument("--picture", metavar="FILE.png", help="write a picture; without it the view opens")
    arguments = parser.parse_args()
    view = show(arguments.out)
    if arguments.picture:
        simple.SaveScreenshot(arguments.picture, view)
    else:
        simple.Interact(view)


if "out" in globals():
    show(pathlib.Path(globals()["out"]))
elif __name__ == "__main__":
    main()
