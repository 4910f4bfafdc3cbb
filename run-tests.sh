#!/usr/bin/env bash
# run-tests.sh [PRESET] [CTEST ARGUMENT…]: set up, build and pass all tests. PRESET: release (default), debug, sanitize.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
preset=release
case ${1:-} in release | debug | sanitize) preset=$1; shift ;; esac
cmake/install-dependencies.sh
cmake --preset "$preset" -DVTKIBL_BUILD_TESTING=ON --log-level=WARNING
cmake --build --preset "$preset"
exec ctest --preset "$preset" "$@"
