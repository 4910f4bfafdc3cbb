# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
# The same pictures from 1, 2 and 4 ranks of pvbatch. Each rank has a piece of the sphere, and light of its own making.
import subprocess
import sys

from support import *

hdri = "/usr/share/blender/datafiles/studiolights/world/interior.exr"


def draw():
    """Pictures by name."""
    load_plugin()
    pictures = {}
    view = make_view(size=(300, 300))
    view.EnvironmentFile = hdri
    sphere = Sphere(ThetaResolution=64, PhiResolution=64)
    shown = show(sphere, view, (0.8, 0.4, 0.2))
    pictures["surface"] = picture(view)
    view.EnvironmentRotation = 90
    shown.Interpolation = "PBR"
    shown.Metallic = 1
    shown.Roughness = 0.2
    pictures["metal, turned"] = picture(view)
    view.ShowEnvironment = 1
    view.EnvironmentBlur = 0.2
    pictures["environment shown"] = picture(view)
    shown.Opacity = 0.4
    pictures["glass"] = picture(view)
    view.EnvironmentFile = os.path.abspath("missing.exr")
    pictures["glass, after a missing file"] = picture(view)
    shown.Opacity = 1
    pictures["without a probe"] = picture(view)
    view.ProbeMode = "Dynamic"
    pictures["with a probe"] = picture(view)
    picture(view)
    return pictures


if len(sys.argv) > 1:
    numpy.savez(sys.argv[1], **draw())
else:
    results = {}
    for ranks in (1, 2, 4):
        name = f"{ranks}.npz"
        run = subprocess.run(
            mpirun(ranks) + [program("pvbatch"), __file__, name], env=mpi_environment(), capture_output=True, text=True)
        check(run.returncode == 0, ranks, "ranks", run.stdout[-1000:] + run.stderr[-3000:] if run.returncode else "")
        # Who tries to read says so: nobody else did. Mutant: each rank reads for itself.
        said = run.stderr.count("missing.exr")
        check(said == 1, "one process reads the file, and says that it is missing:", said)
        results[ranks] = dict(numpy.load(name))
        # A rank that draws a piece has no probe, and one says so. Mutants: probes that see a piece of the scene each;
        # a word of each rank, with each frame, or of one process alone.
        said = run.stderr.count("ProbeMode is without effect")
        check(said == (ranks > 1), "a word about the probe:", said)
        difference = abs(results[ranks].pop("with a probe") - results[ranks]["without a probe"]).max()
        check((difference > 0) == (ranks == 1), "a probe changes the picture by", difference)
    serial = results[1]
    check_near(serial["glass"], serial["glass, after a missing file"], 0, "a missing file changes nothing")
    check(abs(serial["surface"] - serial["metal, turned"]).max() > 50, "pictures that differ")
    # 2, and 0.2 in the mean: 8 bits a rank, blended. Mutants: no background in a composited picture, or each rank's own;
    # antialiasing before the background; ranks without the file.
    for ranks in (2, 4):
        for name, expected in serial.items():
            difference = abs(results[ranks][name] - expected)
            check(difference.max() <= 2 and difference.mean() <= 0.2, f"{ranks} ranks, {name}: differs by "
                f"{difference.max():.0f} at most, {difference.mean():.4f} in the mean")
