#!/usr/bin/env bash
# Installs what is missing, builds and runs all tests; arguments go to ctest (e.g. -R Flatten, -L unit).
set -euo pipefail
cd "$(dirname "$0")/.."
SPIA_PACKAGES=tests/packages.txt bash app/setup.sh release
exec ctest --preset release -j "$(nproc)" "$@"
