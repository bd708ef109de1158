#!/usr/bin/env bash
# usage: grid.sh SPIA FOLDER ASSETS - the grid and the patches on the command line
set -euo pipefail
spia=$1 out=$2 parts=$3/parts
. "$(dirname "$0")/common.sh"
run() { # CODE WORDS ARGUMENT...
    local code=$1 words=$2
    shift 2
    expect "$code" "$words" "$spia" run "$@" --formats csv --out "$out/result"
}
channel=$parts/lipped-channel.obj
run 0 "50 % of the lines by bends, evened out, 0 folded" "$channel" --to-bends 0.5 --even-cells --json "$out/a.json"
grep -q '"to_bends": 0.5' "$out/a.json" || fail "the report does not tell the share"
grep -q '"evened": true' "$out/a.json" || fail "the report does not tell that cells were evened out"
run 0 "Coons patch, 0 folded" "$parts/dome.obj" --json "$out/a.json"
grep -q '"to_bends": 0.0' "$out/a.json" || fail "lines went to bends unasked"
run 2 "--to-bends is a share of the lines, from 0 to 0.9" "$channel" --to-bends nan
run 2 "are for the grid of one patch" "$channel" --patches auto --to-bends 0.5
run 2 "are for the grid of one patch" "$channel" --patches auto --even-cells
run 2 "--smooth-joins is for patches" "$channel" --smooth-joins
# A file may ask for smooth joins alone; what asks for nothing is refused.
echo '{"smooth_joins": true}' > "$out/smooth.json"
run 0 "^joins     angle up to" "$parts/perforated-channel.obj" --patches "$out/smooth.json" --tolerance 0.5
echo '{"smooth_joins": false}' > "$out/smooth.json"
run 2 'must have cuts, corners or "smooth_joins": true' "$channel" --patches "$out/smooth.json"
echo "grid: all as it should be"
