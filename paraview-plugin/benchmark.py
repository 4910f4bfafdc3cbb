# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the plugin costs: frames of a million triangles against the same view without it, and the time to first light.

    paraview-plugin/run.sh pvpython paraview-plugin/benchmark.py

Frames are measured by turns, in wall time and in processor time of all threads, which tells the ratio on a busy machine, too.
"""
import os
import statistics
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "tests"))
from support import *


def seconds(frame):
    """Wall and processor time."""
    begin = time.perf_counter(), time.process_time()
    frame()
    return time.perf_counter() - begin[0], time.process_time() - begin[1]


def spread(times):
    times = sorted(1000 * one for one in times)
    return f"{statistics.median(times):.0f} ({times[1]:.0f} ... {times[-2]:.0f}) ms"


load_plugin()
wavelet = Wavelet(WholeExtent=[-65, 65] * 3)
contour = Contour(Input=wavelet, ContourBy=["POINTS", "RTData"], Isosurfaces=[100, 130, 157, 180, 210, 240])
contour.UpdatePipeline()
view = make_view(size=(1024, 768))
shown = Show(contour, view)
ColorBy(shown, ("POINTS", "RTData"))
view.EnvironmentFile = "/usr/share/blender/datafiles/studiolights/world/interior.exr"
Render(view)
ResetCamera(view)
print(f"{contour.GetDataInformation().GetNumberOfCells()} triangles, 1024 x 768, {os.cpu_count()} cores")
camera = view.GetActiveCamera()
for interpolation in ("Gouraud", "PBR"):
    shown.Interpolation = interpolation
    times = {"without": [], "with": []}
    for turn in range(14):  # by turns, the first four to warm up
        for name in times:
            view.LightByEnvironment = name == "with"
            view.UseLight = name == "without"  # ParaView's light kit, five lights
            camera.Azimuth(7)
            Render(view)
            camera.Azimuth(7)
            took = seconds(lambda: Render(view))
            if turn >= 4:
                times[name].append(took)
    for clock, what in enumerate(("wall", "processor")):
        with_, without = ([one[clock] for one in times[name]] for name in ("with", "without"))
        print(f"{interpolation}, {what}: {spread(with_)} a frame, {spread(without)} with the light kit instead, ratio "
            f"{statistics.median(with_) / statistics.median(without):.2f}")

# A sky with a sun, 4096 x 2048, that the cache does not know: read, baked and on the screen.
rows, columns = numpy.mgrid[0:2048, 0:4096]
sky = numpy.stack([0.3 + 0.2 * numpy.sin(columns / 50) * numpy.cos(rows / 70), 0.4 + rows / 8192, 1 - rows / 4096], axis=-1)
sky[500:520, 1000:1020] = 5000
write_panorama("sky.pfm", sky)
os.system("oiiotool sky.pfm -d half --compression zip -o sky.exr")
view = make_view(size=(1024, 768))
show(Sphere(), view, Interpolation="PBR", Metallic=0.5, Roughness=0.3)
Render(view)
times = []
for turn in range(7):
    os.system(f"oiiotool sky.exr --mulc {1 + turn / 10} -d half --compression zip -o sky{turn}.exr")
    view.EnvironmentFile = os.path.abspath(f"sky{turn}.exr")
    times.append(seconds(lambda: Render(view)))
    os.remove(f"sky{turn}.exr")
print("4096 x 2048 EXR, half, zip, from the file name to the picture:", spread([wall for wall, _ in times]))
os._exit(0)
