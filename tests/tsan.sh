#!/usr/bin/env bash
# Builds those programs of the preset "tsan" whose code has jobs, workers or parallel loops, and runs
# them under the thread sanitizer; arguments go to ctest (e.g. -R Job). Fails on any report.
set -euo pipefail
cd "$(dirname "$0")/.."
. tests/reports.sh
# Of the other modules only original_results.cpp of exchange has one; its loops are those of core.
modules=(core mesh remesh sparse forming unfold compare coons nurbs layout deform viewer)
SPIA_PACKAGES=tests/packages.txt bash app/setup.sh tsan "${modules[@]/#/test_}"
export TSAN_OPTIONS=suppressions=$PWD/tests/tsan.supp:second_deadlock_stack=1 ASAN_OPTIONS= UBSAN_OPTIONS=
run_and_collect tsan -L "^unit/($(IFS='|'; echo "${modules[*]}"))$" "$@"
