#!/usr/bin/env bash
# build.sh [CMAKE ARGUMENT…]: set up ParaView in build/paraview and build the plugin in build/paraview-plugin.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
paraview-plugin/unpack-paraview.sh build/paraview
mapfile -t libraries <build/paraview/libraries
cmake/install-dependencies.sh "${libraries[@]}" libqt5svg5 python3-numpy openmpi-bin xvfb
cmake -S paraview-plugin -B build/paraview-plugin -G Ninja --log-level=WARNING -Wno-deprecated -DCMAKE_BUILD_TYPE=Release \
  "-DCMAKE_CXX_FLAGS=-Wall -Wextra" "-DCMAKE_PREFIX_PATH=$PWD/build/paraview/usr" "$@"
cmake --build build/paraview-plugin
