#!/usr/bin/env bash
# usage: unfold.sh SPIA SOURCE_DIR FOLDER - `spia unfold` from the proposal to its script and back
set -euo pipefail
spia=$1 part=$2/assets/parts/lipped-channel.obj out=$3
rm -rf "$out"
fail() { echo "FAILED: $*"; exit 1; }
expect_exit() { # CODE COMMAND...
    local wanted=$1 got=0
    shift
    "$@" > "$out.log" 2>&1 || got=$?
    [ "$got" = "$wanted" ] || { cat "$out.log"; fail "exit $got, not $wanted: $*"; }
}
mkdir -p "$out"
expect_exit 0 "$spia" unfold "$part" --auto --out "$out/auto" --json "$out/auto.json" --strict
for step in 1 2 3 4 5; do [ -s "$out/auto/lipped-channel-step$step.vtu" ] || fail "no state of step $step"; done
[ ! -e "$out/auto/lipped-channel-step6.vtu" ] || fail "a sixth step"
grep -q LWPOLYLINE "$out/auto/lipped-channel-blank.dxf" || fail "no outline"
[ "$(grep -c '^BENDS' "$out/auto/lipped-channel-blank.dxf")" = 19 ] || fail "not three lines for each of six bends, and their layer"
grep -q '"flipped_triangles": 0' "$out/auto.json" || fail "the report has no blank"
expect_exit 0 "$spia" unfold "$part" --script "$out/auto/lipped-channel-script.json" --out "$out/again" --threads 1 --strict
cmp "$out/auto/lipped-channel-step5.vtu" "$out/again/lipped-channel-step5.vtu" || fail "the script gives other bits"
expect_exit 0 "$spia" unfold "$part" --auto --polish --out "$out/polished" --json "$out/polished.json" --strict
for file in blank.dxf polished.dxf polished.vtu; do [ -s "$out/polished/lipped-channel-$file" ] || fail "no $file"; done
grep -q "outline_distance_mm" "$out/polished.json" || fail "the two blanks are not compared"
grep -q "outlines up to" "$out.log" || fail "the summary does not compare the blanks"
expect_exit 2 "$spia" unfold "$part" --script "$out/renamed.json.not-there"
expect_exit 2 "$spia" unfold "$part"
expect_exit 2 "$spia" unfold "$part" --root 99 --auto
expect_exit 0 "$spia" unfold "$part" --root 2 --auto
grep -q "onto region 2" "$out.log" || fail "region 2 does not stay"
echo '{"steps": [{"freed": {"regions": ["region 4"]}, "fixed": {"regions": ["region 2"]}}]}' > "$out/torn.json"
expect_exit 2 "$spia" unfold "$part" --script "$out/torn.json"
grep -q "tear off face" "$out.log" || fail "the tear is not told"
echo '{"steps": [{"freed": {"regions": ["region 6", "bend 1"]}, "fixed": {"regions": ["region 4"]}}]}' > "$out/one.json"
expect_exit 1 "$spia" unfold "$part" --script "$out/one.json" --strict
grep -q "does not lie in a plane" "$out.log" || fail "the shortcoming is not told"
echo "unfold: all as it should be"
