# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
# A metal mirror on the ground, z = 0, beside a red box whose near side is x = 1, in a white room of radiance 1/2. Seen along
# (1, 0, -1), a mirror's point x reflects along (1, 0, 1): it meets the box's side at z = 1 - x where x > 0, the room
# elsewhere. The probe takes what it sees to be on the scene's bounds, x = 1.1 and z = 1: for x in [0.3, 0.7] still the box,
# for x in [-0.7, -0.3] the room.
from support import *

load_plugin()
red = (0.8, 0.1, 0.1)
dim = 0.5 ** (1 / 2.2)
view = make_view()
view.CameraPosition = [-5, 0, 5]
view.CameraParallelScale = 1
view.EnvironmentFile = write_constant("white.pfm", 1)
view.EnvironmentIntensity = 0.5
with messages() as log:
    view.ProbeMode = "Dynamic"
    picture(view)
    view.ProbeMode = "Off"
check(not log, "no word about a scene with nothing in it", *log)
plane = Plane(Origin=[-1, -1, 0], Point1=[1, -1, 0], Point2=[-1, 1, 0])
mirror = show(plane, view, Interpolation="PBR", Metallic=1, Roughness=0)
box = Box(XLength=0.1, YLength=2, ZLength=1, Center=[1.05, 0, 0.5])
wall = show(box, view, red)


def of_mirror(picture_, low, high):
    """What its points from x = low to high show, around y = 0. On the screen they are at x/sqrt(2)."""
    left, right = (int(round(100 + 100 * x / 2**0.5)) for x in (low, high))
    return picture_[80:120, left:right]


def towards_box(picture_):
    return of_mirror(picture_, 0.3, 0.7)


def faces():
    """How many were captured so far."""
    view.UpdatePropertyInformation()
    counts = [int(line.split()[2]) for line in str(view.EnvironmentStatistics).splitlines() if line.startswith("probe faces")]
    return sum(counts)


# Without the probe the mirror shows the room alone; with it the box's colour where that stands. 2: 8 bits, and half floats
# of what decodes and encodes a colour. Mutants: a probe that is not in the pass; one of another box or place.
white = 255 * dim
before = picture(view)
check_near(towards_box(before), white, 2, "no probe: the room")
check(faces() == 0, "and nothing captured")
view.ProbeMode = "Dynamic"
lit = picture(view)
expected = white * numpy.array(red)
check_near(towards_box(lit), expected, 2, "the box in the mirror")
check_near(of_mirror(lit, -0.7, -0.3), white, 2, "and the room beside it")
check_near(picture(view), lit, 0, "a view at rest")
captured = faces()
picture(view)
check(faces() == captured > 0, captured, "faces captured, none of them at rest")

# Dynamic follows colours. Static keeps them until it is asked, and follows data. Mutants: Static as OnChange; no capture for
# new data, or for new bounds alone; a command that does nothing.
blue = (0.1, 0.1, 0.8)
wall.AmbientColor = wall.DiffuseColor = blue
check_near(towards_box(picture(view)), white * numpy.array(blue), 2, "dynamic: a new colour")
view.ProbeMode = "Static"
picture(view)
wall.AmbientColor = wall.DiffuseColor = red
check_near(towards_box(picture(view)), white * numpy.array(blue), 2, "static: the old colour")
captured = faces()
view.SMProxy.InvokeCommand("CaptureProbe")
check_near(towards_box(picture(view)), expected, 2, "static, asked for: the new colour")
check(faces() == captured + 6, "in six faces")
picture(view)
check(faces() == captured + 6, "and no more")
box.ZLength = 0.02
box.Center = [1.05, 0, 0.01]
view.ProbeFitsData = 0
view.ProbeBounds = [-1, 1.1, -1, 1, 0, 1]
view.ProbePosition = [0.05, 0, 0.5]
check_near(of_mirror(picture(view), 0.3, 0.7), white, 2, "static, a box that is flat now: the room")
captured = faces()
box.ZLength = 1
box.Center = [1.05, 0, 0.5]
check_near(picture(view), lit, 0, "static, the data as it was, in bounds given by number")
check(faces() == captured + 6, "captured for it")
wall.Visibility = 0
check_near(towards_box(picture(view)), white, 2, "static, the box hidden")
wall.Visibility = 1
check_near(picture(view), lit, 0, "and shown")
wall.Position = [0, 0, 5]
check_near(towards_box(picture(view)), white, 2, "static, the box elsewhere")
wall.Position = [0, 0, 0]
check_near(picture(view), lit, 0, "and back")
plane.XResolution = 2
captured = faces()
picture(view)
check(faces() == captured + 6, "static, new data of the same bounds")

# What lies outside of the box sees the room; from inside of the red box, all is red. Mutants: bounds or position not passed on.
view.ProbeBounds = [-1, -0.2, -1, 1, 0, 1]
check_near(towards_box(picture(view)), white, 2, "outside of the probe's box")
view.ProbeBounds = [-1, 1.1, -1, 1, 0, 1]
view.ProbePosition = [1.05, 0, 0.5]
inside = of_mirror(picture(view), -0.7, -0.3)
check(inside[..., 1].max() < 0.5 * white, "looking from inside of the box, green is", inside[..., 1].max())
view.ProbeFitsData = 1
view.ProbeMode = "Dynamic"
check_near(picture(view), lit, 0, "fitted again")

# Axes are no data: with them far away and large the mirror stays. Mutant: all props count, or are captured.
view.CenterAxesVisibility = 1
view.CenterOfRotation = [40, 0, 0]
view.OrientationAxesVisibility = 1
view.AxesGrid.Visibility = 1
check_near(towards_box(picture(view)), towards_box(lit), 0, "axes among the data")
view.CenterAxesVisibility = view.OrientationAxesVisibility = view.AxesGrid.Visibility = 0

# Coarser data while somebody drags is no news. Mutants: a box fitted to it; a capture of it.
view.LODThreshold = view.LODResolution = 0
ball = Sphere(ThetaResolution=300, PhiResolution=300, Radius=0.1, Center=[-0.8, 0.8, 0.5])
show(ball, view)
for view.ProbeMode in ("Static", "Dynamic"):
    still = picture(view)
    captured = faces()
    view.SMProxy.InteractiveRender()
    check(bool(view.GetClientSideObject().GetUseLODForInteractiveRender()), "coarser data")
    check_near(picture(view), still, 0, view.ProbeMode, "after coarser data")
    check(faces() == captured, "nothing captured for it")
Delete(ball)

# A black box on the other side, x = -1. A bounce lights the red one by what the probe sees towards -x: the room less the black
# box's side, 2 x 1 at distance 1, of form factor F, 0.36074 by quadrature of cos^2 / (pi r^2), too;
# the mirror on the ground shows the room. The middle of the red side is what the mirror shows at x = 0.6. 1.5: 8 bits, the
# capture's texels of 0.7 degrees and the irradiance map's. Coarse faces show the box's edge elsewhere. Mutants: either not passed on.
black = Box(XLength=0.1, YLength=2, ZLength=1, Center=[-1.05, 0, 0.5])
show(black, view, (0, 0, 0))
middle = of_mirror(picture(view), 0.57, 0.63)[18:22]
check_near(middle, expected, 2, "no bounce: lit by the room alone")
view.ProbeBounces = 1
middle = of_mirror(picture(view), 0.57, 0.63)[18:22]
F = sum(a / (1 + a * a) ** 0.5 * numpy.arctan(b / (1 + a * a) ** 0.5) for a, b in ((1, 0.5), (0.5, 1))) * 2 / numpy.pi
check_near(middle, expected * (1 - F) ** (1 / 2.2), 1.5, "a bounce: less the black box's", round(F, 4))
Delete(black)
view.ProbeBounces = 0
view.ProbeFaceSize = 32
check(abs(picture(view) - lit).max() > 10, "coarse faces")
view.ProbeFaceSize = 128

# Off, all is as it was, bit by bit. Mutants: a probe left in the pass.
check_near(picture(view), lit, 0, "and fine again")
view.ProbeMode = "Off"
captured = faces()
check_near(picture(view), before, 0, "switched off")
check(faces() == captured, "and nothing captured")
