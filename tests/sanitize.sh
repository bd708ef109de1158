#!/usr/bin/env bash
# Builds the preset "dev" and runs the whole suite under the address (with leaks) and
# undefined-behaviour sanitizers; arguments go to ctest (e.g. -R Flatten, -L unit). Fails on any
# report, also of the window and the command line.
set -euo pipefail
cd "$(dirname "$0")/.."
. tests/reports.sh
SPIA_PACKAGES=tests/packages.txt bash app/setup.sh dev
export ASAN_OPTIONS=halt_on_error=1:detect_leaks=1
export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 TSAN_OPTIONS=
run_and_collect dev "$@"
