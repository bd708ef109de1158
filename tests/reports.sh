# Sourced by tests/sanitize.sh and tests/tsan.sh: runs tests of a preset so that no report of a
# sanitizer is lost, whichever process it was in: viewers write their errors to files, and what is
# driven by hand is killed in the end. Usage: run_and_collect PRESET [ARGUMENTS of ctest...]

# Crashes of the CAD kernel on damaged files are no faults of ours: they are in copies of the
# process that are there for that.
of_the_cad_kernel() {
    grep -q 'ERROR: AddressSanitizer: ' "$1" &&
        awk '/^ *#[0-9]+ / && !/libsanitizer|lib(asan|ubsan|c)\.so/ { first = $0; exit }
             END { exit first !~ /\/libTK[A-Za-z0-9]*\.so/ }' "$1"
}

run_and_collect() {
    local preset=$1 status=0 bad=0 kernel=0 report
    local log=build/$preset/ctest.log reports=$PWD/build/$preset/reports
    shift
    rm -rf "$reports"
    mkdir -p "$reports"
    touch "$reports/begun"
    # Each process leaves what it reports in a file of its own there; the undefined-behaviour
    # sanitizer beside that of addresses does not, but writes to where errors go, which is kept.
    export ASAN_OPTIONS=$ASAN_OPTIONS:log_path=$reports/report TSAN_OPTIONS=$TSAN_OPTIONS:log_path=$reports/report
    ctest --preset "$preset" --no-tests=error --no-label-summary -j "$(nproc)" "$@" | tee "$log" || status=$?
    find "build/$preset" -newer "$reports/begun" \( -name errors.txt -o -name log -o -name LastTest.log \) \
        -exec grep -ahA 8 ': runtime error: ' {} + >"$reports/report.undefined" || true
    for report in "$reports"/report.*; do
        [ -s "$report" ] || continue
        if of_the_cad_kernel "$report"; then
            kernel=$((kernel + 1))
        else
            bad=$((bad + 1))
            [ $bad -gt 5 ] || { printf '\n%s\n' "$report"; grep -v '^=*$' "$report" | head -25; }
        fi
    done
    [ $kernel -eq 0 ] || echo "OpenCASCADE crashed in $kernel copies of the process; reading went on without them"
    if [ $status -ne 0 ] || [ $bad -ne 0 ]; then
        [ $bad -eq 0 ] || printf '\n%d files with reports of a sanitizer are in %s\n' $bad "$reports"
        # ctest's summary once more where nobody has to look for it.
        sed -n '/^[0-9]*% tests passed/,$p' "$log"
        exit 1
    fi
}
