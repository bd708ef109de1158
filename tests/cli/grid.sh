#!/usr/bin/env bash
# usage: grid.sh SPIA FOLDER ASSETS - the grid and the patches on the command line
set -euo pipefail
spia=$1 out=$2 parts=$3/parts
. "$(dirname "$0")/common.sh"
run() { # CODE WORDS ARGUMENT...
    local code=$1 words=$2
    shift 2
    expect "$code" "$words" "$spia" run "$@" --formats csv,iges --out "$out/result"
}
channel=$parts/lipped-channel.obj
run 0 "50 % of the lines by bends, evened out, 0 folded" "$channel" --to-bends 0.5 --even-cells --json "$out/a.json"
grep -q '"to_bends": 0.5' "$out/a.json" || fail "the report does not tell the share"
grep -q '"evened": true' "$out/a.json" || fail "the report does not tell that cells were evened out"
run 0 "Coons patch, 0 folded" "$parts/dome.obj" --patches one --json "$out/a.json"
# Nothing asked for: patches where one would be ill-shaped, one where it is good, the plain surface where the grid is given.
run 0 "5 patches, because one patch over the whole blank is not good enough: the sharpest corner has a scaled Jacobian of 0.0" "$parts/dome.obj"
run 0 "^          one patch over the whole blank" "$parts/fender.obj" --json "$out/a.json"
run 0 "least scaled Jacobian" "$parts/dome.obj" --grid 20x20 --json "$out/a.json"
grep -q "\"choice\"" "$out/a.json" && fail "the grid was asked for"
grep -q '"to_bends": 0.0' "$out/a.json" || fail "lines went to bends unasked"
run 2 "--to-bends: nan is not a number" "$channel" --to-bends nan
# Nothing that was asked for is passed over where the surface has no use for it.
for asked in "--grid 20x20" "--grid-method harmonic" "--to-bends 0.5" "--even-cells" "--ends natural" \
             "--fit-parameters corrected" "--fill-holes"; do
    run 2 "^spia: ${asked%% *} is for one patch; take --patches one, or leave it out" "$channel" --patches auto $asked
done
run 2 "^spia: --corners is for one patch; take --patches one, give corners in the file of --patches, or leave it out" \
    "$channel" --patches auto --corners 0,1,2,3
for asked in "--fit-parameters corrected" "--max-control-points 100"; do
    run 2 "^spia: ${asked%% *} is for a surface within a tolerance; give --tolerance, or leave it out" "$channel" --patches one $asked
done
for asked in "--smooth-joins" "--patch-edges 60"; do
    run 2 "^spia: ${asked%% *} is for several patches; ask for them with --patches auto, or leave it out" "$channel" $asked
done
run 2 "^spia: several patches have one degree along u and v; give --degree one number" "$channel" --patches auto --degree 3,2
# A file may ask for smooth joins alone; what asks for nothing is refused.
echo '{"smooth_joins": true}' > "$out/smooth.json"
run 0 "^joins     angle up to" "$parts/perforated-channel.obj" --patches "$out/smooth.json" --tolerance 0.5
echo '{"smooth_joins": false}' > "$out/smooth.json"
run 2 'must have cuts, corners, edge_deg or "smooth_joins": true' "$channel" --patches "$out/smooth.json"
# A sheet of 100 x 60 mm, folded up at x = 50.
awk 'BEGIN { for (j = 0; j <= 6; ++j) for (i = 0; i <= 10; ++i) print "v", i < 5 ? 10 * i : 50, 10 * j, i < 5 ? 0 : 10 * i - 50
             for (j = 0; j < 6; ++j) for (i = 1; i <= 10; ++i) print "f", 11 * j + i, 11 * j + i + 1, 11 * j + i + 12, 11 * j + i + 11 }' > "$out/fold.obj"
run 0 "^blank     100 x 60 mm, 6000 mm2, " "$out/fold.obj"
run 0 "^forming   thinning 0 %, equivalent strain up to 0.000" "$out/fold.obj"
run 0 "patches end on 1 sharp edge" "$out/fold.obj" --patches auto --json "$out/a.json"
grep -q '"edges": 1' "$out/a.json" || fail "the report does not tell the edge"
run 0 "1 patch with" "$out/fold.obj" --patches auto --patch-edges 91 --json "$out/a.json"
grep -q '"edges": 0' "$out/a.json" || fail "the report tells an edge on which no patch ends"
echo '{"edge_deg": 91}' > "$out/edges.json"
run 0 "1 patch with" "$out/fold.obj" --patches "$out/edges.json"
run 0 "patches end on 1 sharp edge" "$out/fold.obj" --patches "$out/edges.json" --patch-edges 60
run 2 "nan is not a number" "$out/fold.obj" --patches auto --patch-edges nan
echo '{"edge_deg": 0}' > "$out/edges.json"
run 2 "edge_deg.* must be an angle in degrees, from 1 to 180" "$out/fold.obj" --patches "$out/edges.json"
echo '{"edge_deg": 45}' > "$out/edges.json"
run 0 "patches end on 1 sharp edge" "$out/fold.obj" --patches "$out/edges.json"
echo '{"cuts": [[5, 71]]}' > "$out/cut.json"
run 2 "is not for layouts with cuts or corners" "$out/fold.obj" --patches "$out/cut.json" --patch-edges 60
echo '{"cuts": [[5, 71]], "edge_deg": 45}' > "$out/cut.json"
run 2 "cannot be with cuts or corners" "$out/fold.obj" --patches "$out/cut.json"
echo "grid: all as it should be"
# A flat U, whose one patch cuts its corners: said, and with --strict no success. Asked for a tolerance there is a verdict of its own.
awk 'BEGIN { for (j = 0; j <= 4; ++j) for (i = 0; i <= 6; ++i) print "v", 10 * i, 10 * j, 0
             for (j = 0; j < 4; ++j) for (i = 1; i <= 6; ++i) if (j < 1 || i < 3 || i > 4) print "f", 7 * j + i, 7 * j + i + 1, 7 * j + i + 8, 7 * j + i + 7 }' > "$out/u.obj"
run 0 "WARNING .*usual tolerance of 0.1 mm" "$out/u.obj" --patches one
run 1 "WARNING .*usual tolerance of 0.1 mm" "$out/u.obj" --patches one --strict
run 0 "3 patches, because" "$out/u.obj" --strict
