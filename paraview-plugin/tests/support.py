# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the plugin's tests share: the plugin, environments as files, pictures as arrays."""
import contextlib
import os
import tempfile

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def load_plugin():
    LoadPlugin(os.environ["VTKIBL_PLUGIN"], remote=False, ns=globals())


def program(name):
    """One of ParaView's, beside that which runs this."""
    return os.path.join(os.environ["VTKIBL_PARAVIEW"], name)


def mpirun(ranks):
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)]


def mpi_environment():
    """For mpirun: without what MPI, which pvpython starts, has left in the environment."""
    return {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "ORTE_"))}


def make_view(kind="IBLRenderView", size=(200, 200)):
    return make_plain(CreateView(kind), size)


def make_plain(view, size=(200, 200)):
    """Black, without ornaments, looking along -z."""
    view.ViewSize = size
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0, 0, 0]
    view.CameraParallelProjection = 1
    view.CameraPosition = [0, 0, 5]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraParallelScale = 0.7
    return view


def show(source, view, color=(1, 1, 1), **properties):
    return make_matt(Show(source, view), color, **properties)


def make_matt(shown, color=(1, 1, 1), **properties):
    shown.ColorArrayName = [None, ""]
    shown.AmbientColor = shown.DiffuseColor = color
    for name, value in properties.items():
        setattr(shown, name, value)
    return shown


def picture(view, size=None):
    """What the view shows, of its own size by default: rows x columns x 3, top row first, in [0, 255]."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "picture.png")
        SaveScreenshot(name, view, ImageResolution=list(size or view.ViewSize))
        return read_png(name)


def read_png(name):
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return values.reshape(rows, columns, -1)[::-1, :, :3].astype(float)


def write_panorama(name, radiance):
    """Rows x columns x 3, top row first, as float PFM."""
    rows, columns, _ = radiance.shape
    with open(name, "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (columns, rows))
        file.write(radiance[::-1].astype("<f4").tobytes())
    return os.path.abspath(name)


def write_constant(name, radiance):
    return write_panorama(name, numpy.full((32, 64, 3), radiance, float))


def write_half(name):
    """Light from where x > 0, none from elsewhere: columns of u in (1/4, 3/4)."""
    radiance = numpy.zeros((64, 128, 3))
    radiance[:, 32:96] = 1
    return write_panorama(name, radiance)


def check(true, *what):
    print("ok:" if true else "FAILED:", *what, flush=True)
    if not true:
        os._exit(1)  # sys.exit() with a view open crashes ParaView 5.11


def check_near(one, other, tolerance, *what):
    difference = numpy.abs(numpy.subtract(one, other)).max()
    check(difference <= tolerance, *what, f"differs by {difference:.3f}, at most {tolerance} allowed")


@contextlib.contextmanager
def messages():
    """A list that gets what ParaView writes to its log meanwhile."""
    lines = []
    with tempfile.TemporaryFile() as log:
        old = os.dup(2)
        os.dup2(log.fileno(), 2)
        try:
            yield lines
        finally:
            os.dup2(old, 2)
            os.close(old)
            log.seek(0)
            lines += log.read().decode(errors="replace").splitlines()
