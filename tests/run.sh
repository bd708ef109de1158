#!/usr/bin/env bash
# Installs what is missing, builds and runs all tests; arguments go to ctest (e.g. -R Flatten, -L unit).
set -euo pipefail
cd "$(dirname "$0")/.."
SPIA_PACKAGES=tests/packages.txt bash app/setup.sh release
log=build/release/ctest.log
status=0
ctest --preset release --no-label-summary -j "$(nproc)" "$@" | tee "$log" || status=$?
if [ $status -ne 0 ]; then
    # Why, once more where nobody has to look for it; the end is ctest's summary again.
    { grep -E -A 3 ': Failure$|^C\+\+ exception|\*\*\*' "$log" || true; } | tail -40
    sed -n '/^[0-9]*% tests passed/,$p' "$log"
fi
exit $status
