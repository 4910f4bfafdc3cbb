#!/usr/bin/env bash
# run.sh PROGRAM ARGUMENT…: build the plugin and run one of ParaView's programs with it: paraview, pvpython, pvbatch, pvserver.
#   paraview-plugin/run.sh paraview
#   paraview-plugin/run.sh pvpython paraview-plugin/demo.py flow.png
# Without a display it gets one of its own, that nobody sees.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")
"$here/build.sh" >&2
export PYTHONPATH="$root/build/paraview/usr/lib/python3/dist-packages"
export PV_PLUGIN_PATH="$root/build/paraview-plugin/lib/paraview-5.11/plugins/IBL"
export VTKIBL_PLUGIN="$PV_PLUGIN_PATH/IBL.so"
program=$1
shift
[ "$program" != paraview ] || set -- --plugins=IBL "$@"
if [ -z "${DISPLAY:-}" ]; then
  exec "$here/tests/with-display.sh" "$root/build/paraview/usr/bin/$program" "$@"
fi
exec "$root/build/paraview/usr/bin/$program" "$@"
