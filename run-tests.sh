#!/usr/bin/env bash
# run-tests.sh [PRESET] [CTEST ARGUMENT…]: set up, build and pass all tests. PRESET: release (default), debug, sanitize.
# run-tests.sh --stress [RUNS]: the stress suite's long form, an hour or two; see tests/stress/run-long.sh.
# run-tests.sh --paraview [CTEST ARGUMENT…]: the same for the ParaView plugin alone; the first time it fetches ParaView, 83 MB.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
if [ "${1:-}" = --stress ]; then
  exec tests/stress/run-long.sh "${@:2}"
fi
if [ "${1:-}" = --paraview ]; then
  paraview-plugin/build.sh -DVTKIBL_BUILD_TESTING=ON
  exec ctest --test-dir build/paraview-plugin --output-on-failure --no-tests=error "${@:2}"
fi
preset=release
case ${1:-} in release | debug | sanitize) preset=$1; shift ;; esac
cmake/install-dependencies.sh
cmake --preset "$preset" -DVTKIBL_BUILD_TESTING=ON --log-level=WARNING
cmake --build --preset "$preset"
exec ctest --preset "$preset" "$@"
