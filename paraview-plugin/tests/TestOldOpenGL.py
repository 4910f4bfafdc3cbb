# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
# Where there is no OpenGL 4.5 (Mesa is told to have 3.3), a word says so, not one a frame, and the view is ParaView's own.
# Mutants: an error with each frame; a view that stays black.
from support import *

load_plugin()
view = make_view()
show(Sphere(), view, (0.8, 0.4, 0.2))
view.ShowEnvironment = 1
with messages() as log:
    first = picture(view)
check(any("OpenGL 4.5" in line and "is needed" in line for line in log), "it says what is needed")
with messages() as log:
    check_near(picture(view), first, 0, "the next frame")
check(not log, "and says nothing again", *log)
view.LightByEnvironment = 0
own = picture(view)
check(own.max() > 100, "something to see")
check_near(first, own, 0, "ParaView's own picture")
