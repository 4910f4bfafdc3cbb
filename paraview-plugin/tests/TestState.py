# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
# What ParaView writes of a view brings it back: a state file, a state in Python, and a trace. Without arguments this makes all
# three, then runs itself on each in a process of its own, as a user does who comes back on another day. 0: it is the same
# program with the same numbers. Mutants: a property without a name, default or command; one whose Python name is another.
import subprocess
import sys

from support import *

kinds = ("state.pvsm", "state.py", "trace.py")
probe = {"ProbeMode": "Static", "ProbeFitsData": 0, "ProbeBounds": [-1.5, 1, -1, 1.5, -1, 1], "ProbePosition": [0.7, 0.1, 0.7],
    "ProbeBounces": 1, "ProbeFaceSize": 64}


def set_up(view, half):
    view.EnvironmentFile = half
    view.EnvironmentRotation = 30
    view.EnvironmentIntensity = 0.7
    view.EnvironmentUp = [0, 0, 1]
    view.ShowEnvironment = 1
    view.EnvironmentBlur = 0.4
    for name, value in probe.items():
        setattr(view, name, value)


if len(sys.argv) == 1:
    from paraview import smstate, smtrace

    load_plugin()
    half = write_half("half.pfm")
    smtrace.start_trace()
    view = CreateView("IBLRenderView")
    shown = Show(Sphere(ThetaResolution=64, PhiResolution=64), view)
    panels = [smtrace.PropertiesModified(one) for one in (view, shown)]  # as the GUI's panels have their changes traced
    set_up(make_plain(view), half)
    make_matt(shown, (0.8, 0.4, 0.2))
    for panel in panels:
        panel.finalize()
    Render(view)
    text = smtrace.stop_trace()
    with open("trace.py", "w") as file:
        file.write(text)
    SaveState("state.pvsm")
    with open("state.py", "w") as file:
        file.write(smstate.get_state())
    numpy.save("expected.npy", picture(view))
    for kind in kinds:
        subprocess.run([program("pvpython"), __file__, kind], check=True)
    with messages() as log:
        subprocess.run([program("pvpython"), __file__, "without plugin"], check=True)
    check(any("Could not create" in line and "IBLRenderView" in line for line in log), "a word without the plugin")
elif sys.argv[1] == "without plugin":
    LoadState("state.pvsm")
    check_near(picture(make_view("RenderView")), 0, 0, "a usable view without the plugin")
else:
    kind = sys.argv[1]
    load_plugin()
    if kind.endswith(".py"):
        exec(open(kind).read())
    else:
        LoadState(kind)
    view = next(one for one in GetViews() if one.GetXMLName() == "IBLRenderView")
    view.ViewSize = [200, 200]  # which a trace leaves out
    check_near(picture(view), numpy.load("expected.npy"), 0, kind)
    for name, value in probe.items():
        found = getattr(view, name)
        check((list(found) if isinstance(value, list) else found) == value, kind, name, found)
