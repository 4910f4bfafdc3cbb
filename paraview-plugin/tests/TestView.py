# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
from support import *

load_plugin()
white = write_constant("white.pfm", 1)
bright = write_constant("bright.pfm", 3)
half = write_half("half.pfm")
sphere = Sphere(ThetaResolution=128, PhiResolution=128)
color = (0.8, 0.4, 0.2)
expected = numpy.array(color) * 255
center = (slice(80, 120), slice(80, 120))

# In a white room of radiance 1 a matt surface shows its own colour; under NormalizeExposure in one of any radiance, and
# without, of radiance 3, 3^(1/2.2) of it. 1.5: rounding to 8 bits of what is good to 1e-3.
# Mutants: the light kit left on; NormalizeExposure or LightNonPBR not passed on; VTK's own environment light beside ours.
view = make_view()
shown = show(sphere, view, color)
view.EnvironmentFile = white
check_near(picture(view)[center], expected, 1.5, "white room")
view.EnvironmentFile = bright
check_near(picture(view)[center], expected, 1.5, "brighter room, normalized")
view.NormalizeExposure = 0
check_near(picture(view)[center], numpy.minimum(expected * 3 ** (1 / 2.2), 255), 1.5, "brighter room as it is")
view.EnvironmentIntensity = 1 / 3
check_near(picture(view)[center], expected, 1.5, "dimmed to 1")
view.EnvironmentIntensity = 1
view.NormalizeExposure = 1

# The same beside what else ParaView can do to the picture, each for itself. A plane has nothing to occlude it, a surface of
# opacity 1/2, far side behind near side, over black shows 3/4; Clamp at exposure 1 changes nothing. Mutants: a pass that is not called below another.
for name, value, factor, where in (
    ("UseFXAA", 1, 1, view),
    ("UseAmbientOcclusion", 1, 1, view),
    ("UseToneMapping", 1, 1, view),
    ("Opacity", 0.5, 0.75, shown),
    ("Interpolation", "Flat", 1, shown),
):
    view.ToneMappingType = 0
    old = getattr(where, name)
    setattr(where, name, value)
    middle = numpy.median(picture(view)[center], axis=(0, 1))
    check_near(middle, expected * factor, 2, name, value)
    setattr(where, name, old)

# A volume is drawn as without the pass, and a surface beside it lit as without the volume. 1: they share a float buffer.
# Mutant: volumes that are marked for the pass, which VTK takes for depth peeling.
volume = Show(Wavelet(WholeExtent=[-5, 5] * 3), view, "UniformGridRepresentation")
volume.Representation = "Volume"
volume.Scale = [0.02] * 3
volume.Position = [0.55, 0.55, 0]
ColorBy(volume, ("POINTS", "RTData"))
HideScalarBarIfNotNeeded(volume.LookupTable, view)
beside = picture(view)
check_near(beside[center], expected, 1.5, "beside a volume")
view.LightByEnvironment = 0
check(beside[:30, 170:].max() > 50, "a volume")
check_near(beside[:30, 170:], picture(view)[:30, 170:], 1, "a volume beside a lit surface")
view.LightByEnvironment = 1
Delete(volume)

# White metal gives all light back; PBR surfaces are shown with the power 1/2.2.
shown.Interpolation = "PBR"
shown.Metallic = 1
shown.Roughness = 0.6
shown.AmbientColor = shown.DiffuseColor = [1, 1, 1]
view.EnvironmentIntensity = 0.5
check_near(picture(view)[center], 255 * 0.5 ** (1 / 2.2), 1.5, "metal in a white room of 1/2")
view.EnvironmentIntensity = 1
shown.AmbientColor = shown.DiffuseColor = color
shown.Interpolation = "Gouraud"

# Radiance 1 from the half space around d alone gives a white matt surface of normal n the irradiance pi (1 + n.d) / 2.
# Turned by 180 degrees, d = +x becomes -x; 90 degrees, counterclockwise from above, take it to -z, behind the sphere. With the
# environment's up along z, +x stays +x. 4: at the dark end the power 1/2.2 makes 4/255 of 1e-4 of irradiance.
# Mutants: the sign of the rotation; degrees as radians; Up not passed on.
column, row = numpy.meshgrid(numpy.arange(200) - 99.5, 99.5 - numpy.arange(200))
n = numpy.stack([column, row, numpy.zeros_like(row)], axis=-1) * 1.4 / 200 / 0.5
n[..., 2] = numpy.sqrt(numpy.maximum(1 - n[..., 0] ** 2 - n[..., 1] ** 2, 0))
inside = n[..., 2] > 0.5
view.EnvironmentFile = half
view.NormalizeExposure = 0
shown.AmbientColor = shown.DiffuseColor = [1, 1, 1]


def check_half(direction, *what):
    lit = 255 * ((1 + n[inside] @ direction) / 2) ** (1 / 2.2)
    check_near(picture(view)[inside], lit[:, None], 4, *what)


for degrees, direction in ((0, [1, 0, 0]), (180, [-1, 0, 0]), (90, [0, 0, -1]), (-90, [0, 0, 1])):
    view.EnvironmentRotation = degrees
    check_half(direction, "light from the half space, turned by", degrees)
view.EnvironmentRotation = 0
view.EnvironmentUp = [0, 0, 1]
check_half([1, 0, 0], "light from the half space, its up along z")
view.EnvironmentUp = [0, 1, 0]

# ParaView's own skybox lights the scene as the file does, by our pass and only by it. 1: 8 bits, twice rounded.
# Mutants: UseImageBasedLighting left on; the texture not taken.
gray = numpy.zeros((64, 128, 3), numpy.uint8)
gray[:, 32:96] = 200
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

image = vtkImageData()
image.SetDimensions(128, 64, 1)
image.GetPointData().SetScalars(numpy_to_vtk(gray.reshape(-1, 3), deep=True))
writer = vtkPNGWriter()
writer.SetFileName("gray.png")
writer.SetInputData(image)
writer.Write()
shown.Interpolation = "PBR"  # which VTK's own environment would light, too
view.EnvironmentFile = os.path.abspath("gray.png")
of_file = picture(view)
view.EnvironmentFile = ""
view.BackgroundColorMode = "Skybox"
view.BackgroundTexture = CreateTexture(os.path.abspath("gray.png"))
view.UseEnvironmentLighting = 1
check_near(picture(view)[center], of_file[center], 1, "ParaView's skybox")
view.UseEnvironmentLighting = 0
view.BackgroundColorMode = "Single Color"
studio = picture(view)
shown.Interpolation = "Gouraud"
check(abs(studio[center] - of_file[center]).max() > 20 and studio[center].mean() > 100, "the studio, without either")

# The environment behind the scene.
view.EnvironmentFile = white
view.ShowEnvironment = 1
check_near(picture(view)[5, 5], 255, 1, "environment shown")
view.ShowEnvironment = 0
check_near(picture(view)[5, 5], 0, 0, "and hidden")

# A view at rest makes nothing, whatever is turned, dimmed or hidden: the counts stay. Mutant: Modified() with each frame.
view.EnvironmentFile = half
picture(view)


def counts():
    view.UpdatePropertyInformation()
    return [line.split(" in ")[0] for line in str(view.EnvironmentStatistics).splitlines()]


before = counts()
check(len(before) >= 3, "statistics:", "; ".join(before))
for step in range(4):
    view.EnvironmentRotation = 10 * step
    view.EnvironmentIntensity = 1 + step / 10
    shown.Visibility = step % 2
    picture(view)
check(counts() == before, "nothing made again")
shown.Visibility = 1
view.EnvironmentRotation = 0
view.EnvironmentIntensity = 1

# What can't be read: a word in the log, once, and the picture stays. Mutants: an error that leaves the view dark.
good = picture(view)
for name in (os.path.abspath("missing.exr"), os.path.abspath("white.txt")):
    with open("white.txt", "w") as file:
        file.write("no picture\n")
    with messages() as log:
        view.EnvironmentFile = name
        bad = picture(view)
        picture(view)
    check_near(bad, good, 0, "picture after", os.path.basename(name))
    said = [line for line in log if name in line]
    check(len(said) == 1, "said once:", *said or log)
view.EnvironmentFile = white
shown.AmbientColor = shown.DiffuseColor = color
check_near(picture(view)[center], expected, 1.5, "usable afterwards")

# Off, it is ParaView's render view, bit by bit. Mutant: lights or background changed for good.
view.LightByEnvironment = 0
view.UseLight = 1
view.CameraViewUp = [0, 1, 0]
plain = make_view("RenderView")
show(sphere, plain, color)
check_near(picture(view), picture(plain), 0, "switched off")
