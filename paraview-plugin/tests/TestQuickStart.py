# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
# vtkibl.light() shows what the view showed, lit. In a white room of radiance 1 a matt surface shows its own colour. Mutants:
# representations, their properties or the camera not copied; the light kit copied; the old view left in its place.
from support import *

load_plugin()
import vtkibl

plain = make_view("RenderView")
layout = CreateLayout()
AssignViewToLayout(plain, layout)
SetActiveView(plain)
color = (0.8, 0.4, 0.2)
show(Sphere(ThetaResolution=64, PhiResolution=64, Center=[0.3, 0, 0]), plain, color)
show(Cone(), plain).Visibility = 0
covered = picture(plain).max(axis=2) > 0

with messages() as log:
    view = vtkibl.light(write_constant("white.pfm", 1), EnvironmentIntensity=0.5)
check(not log, "nothing to complain about", *log)
check(view.GetXMLName() == "IBLRenderView" and GetActiveView() == view and GetViews() == [view], "one view, the lit one")
check(layout.GetViewLocation(view.SMProxy) == 0, "in the old one's place")
view.ViewSize = [200, 200]
lit = picture(view)
inside = covered & numpy.roll(covered, 4, 0) & numpy.roll(covered, -4, 0) & numpy.roll(covered, 4, 1) & numpy.roll(covered, -4, 1)
check(inside.sum() > 5000, "a sphere")
check_near(lit[inside], 255 * numpy.array(color) * 0.5 ** (1 / 2.2), 1.5, "its own colour, dimmed")
check_near(lit[~covered], 0, 0, "and nothing else")
check(vtkibl.light() == view and view.EnvironmentFile == "", "the same view again, with the studio")
