# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
"""Vortices of a made-up turbulent flow, coloured by speed, under an HDRI.

    paraview-plugin/run.sh pvpython paraview-plugin/demo.py [OUT.png] [HDRI]
    paraview-plugin/run.sh paraview --script=paraview-plugin/demo.py
"""
import os
import sys

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter


def write_flow(name, n=128):
    """Velocity on n^3 points of a cube of edge 1: random Fourier modes, each without divergence, with Kolmogorov's spectrum."""
    random = numpy.random.default_rng(7)
    x = numpy.linspace(0, 1, n)
    velocity = numpy.zeros((n, n, n, 3))
    for _ in range(96):
        length = 2 * 3 ** random.random()
        axis = random.normal(size=3)
        wave = 2 * length * axis / numpy.linalg.norm(axis)
        across = numpy.cross(axis, random.normal(size=3))
        across *= length ** (-5 / 6) / numpy.linalg.norm(across)
        phases = [numpy.exp(1j * wave[k] * x * numpy.pi) for k in range(3)]
        turn = numpy.exp(2j * numpy.pi * random.random())
        cosine = (turn * phases[2][:, None, None] * phases[1][None, :, None] * phases[0][None, None, :]).real
        velocity += cosine[..., None] * across
    image = vtkImageData()
    image.SetDimensions(n, n, n)
    image.SetSpacing([1 / (n - 1)] * 3)
    array = numpy_to_vtk(velocity.reshape(-1, 3).astype(numpy.float32), deep=True)
    array.SetName("velocity")
    image.GetPointData().AddArray(array)
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(name)
    writer.SetInputData(image)
    writer.Write()


arguments = [one for one in sys.argv[1:] if not one.startswith("-")]
picture = arguments[0] if arguments else "vtkIBL-paraview.png"
hdri = arguments[1] if len(arguments) > 1 else "/usr/share/blender/datafiles/studiolights/world/interior.exr"
if not hasattr(servermanager.rendering, "IBLRenderView") and "VTKIBL_PLUGIN" in os.environ:
    LoadPlugin(os.environ["VTKIBL_PLUGIN"], remote=False, ns=globals())

flow = os.path.abspath("flow.vti")
if not os.path.exists(flow):
    write_flow(flow)
source = XMLImageDataReader(registrationName="flow.vti", FileName=[flow])
swirl = Gradient(registrationName="Swirl", Input=source, ScalarArray=["POINTS", "velocity"], ComputeGradient=0, ComputeQCriterion=1)
swirl.UpdatePipeline()
_, high = swirl.PointData["Q Criterion"].GetRange(0)
vortices = Contour(registrationName="Vortices", Input=swirl, ContourBy=["POINTS", "Q Criterion"], Isosurfaces=[0.2 * high])

view = GetActiveView() or CreateView("RenderView")
view.ViewSize = [900, 700]
shown = Show(vortices, view)
ColorBy(shown, ("POINTS", "velocity", "Magnitude"))
shown.RescaleTransferFunctionToDataRange()
GetColorTransferFunction("velocity").ApplyPreset("Viridis (matplotlib)", True)
shown.Specular = 0.3
shown.SpecularPower = 40
ResetCamera(view)
view.GetActiveCamera().Azimuth(35)
view.GetActiveCamera().Elevation(20)
view.GetActiveCamera().Dolly(1.25)
before = os.path.splitext(picture)
SaveScreenshot(before[0] + "-without" + before[1], view, ImageResolution=view.ViewSize)

import vtkibl

view = vtkibl.light(hdri, view, EnvironmentIntensity=0.8, ShowEnvironment=1, EnvironmentBlur=0.4)
SaveScreenshot(picture, view, ImageResolution=[900, 700])
print(f"{vortices.GetDataInformation().GetNumberOfCells()} triangles: {picture}, and without light {before[0]}-without{before[1]}")
