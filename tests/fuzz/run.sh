#!/usr/bin/env bash
# Searches the readers of files for crashes with libFuzzer under the address and undefined-behaviour sanitizers:
#   bash tests/fuzz/run.sh [EXECUTIONS] [FORMAT...]      default: 1000000 of every format
# What breaks a reader is left in build/fuzz/found; once mended, it belongs into tests/fuzz/found.
set -euo pipefail
cd "$(dirname "$0")/../.."
command -v clang++ >/dev/null || { echo "libFuzzer comes with clang: apt-get install clang" >&2; exit 1; }
executions=${1:-1000000}
shift || true
formats=("$@")
[ ${#formats[@]} -gt 0 ] || formats=(obj off ply stl gltf k bdf inp msh rad dxf csv lines.json steps.json deformation.json patches.json step igs brep)
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target spia-fuzz spia-fuzz-seeds | tail -1
mkdir -p build/fuzz/found
failed=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for format in "${formats[@]}"; do
    folder=build/fuzz/corpus/$format
    ASAN_OPTIONS=detect_leaks=0 build/fuzz/bin/spia-fuzz-seeds "$format" "$folder"
    export ASAN_OPTIONS=detect_leaks=0
    log=$folder/log
    case $format in # CAD files are longer, are read in copies that bound their own memory, and may keep OpenCASCADE busy
    step | igs | brep)
        bounds=(-max_len=8192 -timeout=60 -rss_limit_mb=0)
        # Names in a report would take longer than a thousand files, for each crash of OpenCASCADE.
        ASAN_OPTIONS=$ASAN_OPTIONS:allocator_may_return_null=1:symbolize=0:malloc_context_size=1:quarantine_size_mb=8
        mkdir -p "$folder/ended"
        ;;
    *) bounds=(-max_len=4096 -timeout=20 -rss_limit_mb=2048) ;;
    esac
    SPIA_FUZZ_FORMAT=$format UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 SPIA_FUZZ_ENDED=$folder/ended TMPDIR=$scratch \
        build/fuzz/bin/spia-fuzz -runs="$executions" "${bounds[@]}" -seed=1 -print_final_stats=1 \
        -dict="$folder/words.dict" -artifact_prefix="build/fuzz/found/" "$folder/corpus" >"$log" 2>&1 && code=0 || code=$?
    echo "$format: $(grep -a -m1 number_of_executed_units "$log" | grep -o '[0-9]*$') executions, exit code $code"
    { grep -a '^files: [0-9]*, accepted' "$log" || true; } | tail -1
    [ "$code" -eq 0 ] && continue
    failed=1
    # The last ones: those of OpenCASCADE's crashes stand before.
    { grep -a -E 'ERROR|runtime error|what\(\)|SUMMARY|in the reader at|as users do:|proves nothing' "$log" || true; } | tail -8
    for found in $(grep -a -o 'Test unit written to .*' "$log" | sed 's/.* //'); do # again, with names
        SPIA_FUZZ_FORMAT=$format UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 TMPDIR=$scratch \
            ASAN_OPTIONS=${ASAN_OPTIONS/symbolize=0/symbolize=1} build/fuzz/bin/spia-fuzz "${bounds[@]}" "$found" 2>&1 |
            grep -a -A12 -E 'ERROR|runtime error|what\(\)|in the reader at|as users do:' | tail -40 || true
    done
done
exit $failed
