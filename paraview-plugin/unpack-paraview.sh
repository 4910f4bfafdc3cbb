#!/usr/bin/env bash
# unpack-paraview.sh DIR: Debian's ParaView (programs, development files, Python) in a prefix of its own, beside libvtk9-dev.
# python3-paraview and python3-vtk9 exclude each other, and find_package(ParaView) wants all three packages; unpacked aside,
# dpkg's database knows nothing of them. 83 MB to fetch, 670 MB on disk; nothing is done when DIR is whole. Then:
# cmake -DCMAKE_PREFIX_PATH=DIR/usr, and PYTHONPATH=DIR/usr/lib/python3/dist-packages DIR/usr/bin/pvpython.
set -euo pipefail
mkdir -p "${1:?usage: unpack-paraview.sh DIR}"
prefix=$(cd "$1" && pwd)
[ ! -e "$prefix/libraries" ] || exit 0

echo "ParaView: fetching it for $prefix"
fetched=$(mktemp -d)
trap 'rm -rf "$fetched"' EXIT
chmod 755 "$fetched" # apt fetches as another user
cd "$fetched"
if ! { apt-get download paraview paraview-dev python3-paraview || {
  apt-get update && apt-get download paraview paraview-dev python3-paraview; }; } >log 2>&1; then
  tail -n 20 log >&2
  exit 1
fi
rm -rf "$prefix/usr"
for package in *.deb; do dpkg -x "$package" "$prefix"; done
# Newer suites name modules NAME.cpython-XY-….so where the CMake exports ask for NAME.so.
find "$prefix/usr/lib/python3" -name '*.cpython-*.so' | while read -r module; do
  ln -sf "$(basename "$module")" "${module%%.cpython*}.so"
done
# Debian's names of what the programs link.
dpkg-deb -f paraview_*.deb Depends | tr , '\n' | sed 's/^ *//;s/[ (|].*//' | grep ^lib >"$prefix/libraries"
