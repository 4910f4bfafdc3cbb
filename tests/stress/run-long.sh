#!/usr/bin/env bash
# run-long.sh [RUNS]: the long form of the stress suite: its tests with a hundred times the inputs, then RUNS (1,000,000)
# executions of each fuzzer, under AddressSanitizer and UndefinedBehaviorSanitizer. Build trees: build/release, build/fuzz.
# What a fuzzer finds is a file in build/fuzz/found: mend it, and put the file into tests/stress/corpus.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
runs=${1:-1000000}

VTKIBL_STRESS=100 ./run-tests.sh release -R '^stress/' --timeout 7200

cmake/install-dependencies.sh clang
cmake --preset fuzz --log-level=WARNING
cmake --build --preset fuzz
cd build/fuzz
mkdir -p found grown/pictures grown/lights
bin/vtkIBLFuzzSeeds seeds
# OpenImageIO loses a message of 31 bytes when a PNG ends early, and says so of each: no leaks are counted for pictures.
fuzz() {
  "bin/$1" -runs="$runs" -max_len=8192 -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=256 -artifact_prefix=found/ \
    "grown/$2" "seeds/$2" "../../tests/stress/corpus/$2"
}
ASAN_OPTIONS=detect_leaks=0 fuzz FuzzImageReader pictures
fuzz FuzzStoredLight lights
