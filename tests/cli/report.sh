#!/usr/bin/env bash
# usage: report.sh SPIA FOLDER ASSETS - the HTML report of a run
set -euo pipefail
spia=$1 out=$2 parts=$3/parts
. "$(dirname "$0")/common.sh"
check() { python3 "$(dirname "$0")/check_report.py" "$spia" "$@" || fail "the report is not as it should be"; }
run() { # CODE WORDS ARGUMENT...
    local code=$1 words=$2
    shift 2
    expect "$code" "$words" "$spia" run "$@" --formats csv --out "$out/result"
}
run 0 "^wrote     .*dome.html" "$parts/dome.obj" --patches one --report "$out/dome.html" --json "$out/dome.json"
check "$out/dome.html" "$out/dome.json" mm "NURBS surface with its control net"
run 0 "^wrote     .*inch.html" "$parts/dome.obj" --report "$out/inch.html" --json "$out/inch.json" --export-unit inch
check "$out/inch.html" "$out/inch.json" inch "Lengths in inch"
grep -q "5 patches, because one patch over the whole blank is not good enough: " "$out/inch.html" || fail "what was chosen is not told"
grep -q "whose facets are up to 0.00589 in off it" "$out/inch.html" || fail "what deviations are measured from is not told"
# A flat U, whose one patch cuts its corners: the report says so, also where the run does not count as a success.
awk 'BEGIN { for (j = 0; j <= 4; ++j) for (i = 0; i <= 6; ++i) print "v", 10 * i, 10 * j, 0
             for (j = 0; j < 4; ++j) for (i = 1; i <= 6; ++i) if (j < 1 || i < 3 || i > 4) print "f", 7 * j + i, 7 * j + i + 1, 7 * j + i + 8, 7 * j + i + 7 }' > "$out/u.obj"
run 1 "^wrote     .*u.html" "$out/u.obj" --strict --patches one --report "$out/u.html" --json "$out/u.json"
check "$out/u.html" "$out/u.json" mm "<b>Caution:</b> .*usual tolerance of 0.1 mm"
# A stage without a result after the blank.
echo '{"schema": "spia.deformation/1", "moves": [{"at": [999, 0], "by": [0, 0, 1]}]}' > "$out/far.json"
run 2 "^wrote     .*far.html" "$parts/dome.obj" --deform "$out/far.json" --report "$out/far.html" --json "$out/result.json"
check "$out/far.html" "$out/result.json" mm "<b>Caution:</b> The stage fit has no result: "
# No blank, no report.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' > "$out/closed.obj"
run 2 "^report    not written: there is no blank" "$out/closed.obj" --seam none --report "$out/closed.html"
[ ! -e "$out/closed.html" ] || fail "a report of a part without a blank"
# What keeps the report from being written is told before the work.
run 4 "none/r.html" "$parts/dome.obj" --report "$out/none/r.html"
! grep -q "^blank" "$out/log" || fail "the part was solved for a report that cannot be written"
run 4 "is wanted for two files" "$parts/dome.obj" --report "$out/r" --json "$out/r"
run 4 "is the part itself" "$out/u.obj" --report "$out/u.obj"
echo "report: all as it should be"
