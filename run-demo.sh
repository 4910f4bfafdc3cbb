#!/usr/bin/env bash
# run-demo.sh [MESH] [HDRI] [OUT.png]: set up, build, and light a surface with an HDRI.
# MESH: .vtp .vtu .vti .stl .ply .obj; default: an isosurface of a simulation-like field. HDRI: any image OpenImageIO reads.
set -euo pipefail
called_from=$PWD
absolute() { case $1 in /*) echo "$1" ;; *) echo "$called_from/$1" ;; esac; }
mesh=${1:-}
hdri=${2:-/usr/share/blender/datafiles/studiolights/world/interior.exr}
picture=${3:-vtkIBL-demo.png}
arguments=(--environment "$(absolute "$hdri")" --output "$(absolute "$picture")")
[ -z "$mesh" ] || arguments=("$(absolute "$mesh")" "${arguments[@]}")

cd "$(dirname "${BASH_SOURCE[0]}")"
cmake/install-dependencies.sh
cmake --preset release --log-level=WARNING
cmake --build --preset release --target SciVis
exec build/release/bin/SciVis "${arguments[@]}"
