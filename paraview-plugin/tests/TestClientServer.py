# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
# The same pictures from a client of pvserver, drawn here or there, as without a server. The server has one rank, then two.
import contextlib
import subprocess
import sys

from support import *

hdri = "/usr/share/blender/datafiles/studiolights/world/interior.exr"


@contextlib.contextmanager
def connected(ranks):
    command = (mpirun(ranks) if ranks > 1 else []) + [program("pvserver"), "--hostname=localhost", "--server-port=0"]
    server = subprocess.Popen(command, env=mpi_environment(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        for line in server.stdout:
            if "Accepting connection" in line:
                break
        Connect("localhost", int(line.rsplit(":", 1)[1]))
        yield
    finally:
        server.terminate()


def draw(remote=False, without_probe=False):
    """Pictures by name. Where several ranks draw, there is no probe: the client says so, once."""
    pictures = {}
    view = make_view(size=(300, 300))
    shown = show(Sphere(ThetaResolution=64, PhiResolution=64), view, (0.8, 0.4, 0.2))
    view.RemoteRenderThreshold = 0 if remote else 1e9
    view.EnvironmentFile = hdri
    Render(view)
    make_plain(view, (300, 300))  # the first Render() moves the camera where there is a server
    pictures["surface"] = picture(view)
    view.ShowEnvironment = 1
    view.EnvironmentRotation = 90
    shown.Opacity = 0.4
    pictures["glass, environment shown"] = picture(view)
    with messages() as log:
        view.EnvironmentFile = os.path.abspath("missing.exr")
        pictures["after a missing file"] = picture(view)
    check(sum("missing.exr" in line for line in log) == 1, "the client says that the file is missing")
    shown.Opacity = 1
    pictures["without a probe"] = picture(view)
    with messages() as log:
        view.ProbeMode = "Dynamic"
        pictures["with a probe"] = picture(view)
        picture(view)
    said = sum("ProbeMode is without effect" in line for line in log)
    check(said == without_probe, "a word about the probe:", said)
    if without_probe:
        check_near(pictures.pop("with a probe"), pictures["without a probe"], 0, "a probe")
    there = bool(view.GetClientSideObject().GetUseDistributedRenderingForRender())
    check(there == remote, "drawn where it was asked for")
    Delete(view)
    return pictures


if len(sys.argv) > 1:
    ranks = int(sys.argv[1])
    serial = dict(numpy.load("serial.npz"))
    with connected(ranks):
        # Mutant: a client that sends the file to a server without the plugin, which takes it for the next command.
        LoadPlugin(os.environ["VTKIBL_PLUGIN"], remote=False, ns=globals())
        with messages() as log:
            try:
                make_view()
            except RuntimeError:
                pass
        check(any("IBLRenderView" in line for line in log), "a word when the server lacks the plugin")
        plain = make_view("RenderView")
        show(Sphere(), plain)
        check(picture(plain).max() > 100, "and a usable session")
        Delete(plain)

        LoadPlugin(os.environ["VTKIBL_PLUGIN"], remote=True, ns=globals())
        for remote in (False, True):
            for name, picture_ in draw(remote, remote and ranks > 1).items():
                difference = abs(picture_ - serial[name])
                check(difference.max() <= 2 and difference.mean() <= 0.2, f"{ranks} ranks, drawn {'there' if remote else 'here'}, "
                    f"{name}: differs by {difference.max():.0f} at most, {difference.mean():.4f} in the mean")
    os._exit(0)  # the server is gone
load_plugin()
pictures = draw()
check(abs(pictures["with a probe"] - pictures["without a probe"]).max() > 10, "a probe that is seen")
numpy.savez("serial.npz", **pictures)
for ranks in (1, 2):
    subprocess.run([program("pvpython"), __file__, str(ranks)], check=True)
