# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
# The real window, on an X server: paraview --plugins=IBL --script=this. A white room shows a matt surface's own colour in Qt's GL
# context, too, and beside it the plain render view is what it was. Mutants: a pass that relies on pvpython's window; state of
# the context left as ours.
from support import *

plain = GetActiveView()
layout = GetLayout()
check(plain.GetXMLName() == "RenderView", "ParaView starts with its own view")
color = (0.8, 0.4, 0.2)
sphere = Sphere(ThetaResolution=64, PhiResolution=64)
shown = make_matt(Show(sphere, plain), color)
make_plain(plain, (300, 300))
before = picture(plain, (300, 300))

layout.SplitHorizontal(0, 0.5)
view = CreateView("IBLRenderView")
AssignViewToLayout(view, layout, 2)
make_matt(Show(sphere, view), color)
make_plain(view, (300, 300))
view.EnvironmentFile = write_constant("white.pfm", 1)
lit = picture(view, (300, 300))
check_near(lit[120:180, 120:180], 255 * numpy.array(color), 1.5, "white room, in", view.GetRenderWindow().GetClassName())
check_near(picture(plain, (300, 300)), before, 0, "the plain view beside it")
Delete(view)
check_near(picture(plain, (300, 300)), before, 0, "and after it")
os._exit(0)
