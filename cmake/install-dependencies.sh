#!/usr/bin/env bash
# install-dependencies.sh [PACKAGE…]: Debian packages that vtkIBL builds and tests with, and PACKAGE… beside them.
# Installs what is missing; says one line when nothing is.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libvtk9-dev libopenimageio-dev libopenexr-dev libglm-dev libkissfft-dev libxxhash-dev  # the module
  libegl-dev libegl-mesa0 libgl1-mesa-dri                    # OpenGL without an X server
  libcli11-dev nlohmann-json3-dev                            # examples, tool
  libgtest-dev glslang-tools openimageio-tools openexr       # tests
  libbenchmark-dev libfilament-tools                         # benchmarks, and a peer beside us
  blender-data                                               # eight CC0 HDRIs
  "$@"
)

if ! command -v dpkg-query >/dev/null; then
  echo "This is not Debian (no dpkg-query). Install by hand what these packages hold, then use cmake --preset release: ${packages[*]}" >&2
  exit 1
fi
missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} = 0 ]; then
  echo "Dependencies: all ${#packages[@]} packages are installed."
  exit 0
fi
if [ "$(id -u)" != 0 ]; then
  echo "Missing packages: ${missing[*]}. Run this as root once, or: sudo apt-get install ${missing[*]}" >&2
  exit 1
fi
echo "Dependencies: installing ${missing[*]}"
log=$(mktemp)
if ! { apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "apt-get failed; the whole log is $log" >&2
  exit 1
fi
rm -f "$log"
