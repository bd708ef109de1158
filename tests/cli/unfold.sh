#!/usr/bin/env bash
# usage: unfold.sh SPIA SOURCE_DIR FOLDER - `spia unfold` from the proposal to its script and back
set -euo pipefail
spia=$1 part=$2/assets/parts/lipped-channel.obj out=$3
[ ! -e "$out" ] || [ -e "$out/.made_by_a_test" ] || { echo "FAILED: $out is no folder of an earlier run"; exit 2; }
rm -rf "$out"
fail() { echo "FAILED: $*"; exit 1; }
expect_exit() { # CODE COMMAND...
    local wanted=$1 got=0
    shift
    "$@" > "$out.log" 2>&1 || got=$?
    [ "$got" = "$wanted" ] || { cat "$out.log"; fail "exit $got, not $wanted: $*"; }
}
mkdir -p "$out"
touch "$out/.made_by_a_test"
expect_exit 0 "$spia" unfold "$part" --auto --out "$out/auto" --json "$out/auto.json" --strict
for step in 1 2 3 4 5; do [ -s "$out/auto/lipped-channel-step$step.vtu" ] || fail "no state of step $step"; done
[ ! -e "$out/auto/lipped-channel-step6.vtu" ] || fail "a sixth step"
grep -q LWPOLYLINE "$out/auto/lipped-channel-blank.dxf" || fail "no outline"
[ "$(grep -cE '^BEND_(UP|DOWN)$' "$out/auto/lipped-channel-blank.dxf")" = 13 ] || fail "not a line and a text for each of six bends, and their layer"
[ "$(grep -c '^BEND_ZONE$' "$out/auto/lipped-channel-blank.dxf")" = 13 ] || fail "not two lines where each of six bends begins and ends, and their layer"
for file in step1-trim step3-trim blank; do
    for ending in dxf iges step; do [ -s "$out/auto/lipped-channel-$file.$ending" ] || fail "no $file.$ending"; done
done
echo '{"lines": [{"name": "slot", "closed": true, "points": [[40, 30], [150, 30], [150, 110], [40, 110]]}, {"name": "off", "points": [[50, 50], [-900, 3]]}]}' > "$out/slot.json"
expect_exit 1 "$spia" unfold "$part" --auto --out "$out/lines" --formats dxf --to-part "$out/slot.json" --strict
grep -q '"off" leaves the blank at -900, 3' "$out.log" || fail "what leaves the blank is not named"
[ ! -e "$out/lines/lipped-channel-step1.vtu" ] || fail "a format that was not asked for"
expect_exit 0 "$spia" unfold "$part" --auto --out "$out/lines" --to-blank "$out/lines/lipped-channel-slot-on-part.dxf" --strict
python3 - "$out/lines/lipped-channel-lipped-channel-slot-on-part-on-blank.json" <<'END' || fail "the slot does not come back"
import json, sys
line, = json.load(open(sys.argv[1]))["lines"]
at = line["points"]
assert line["closed"] and line["name"] == "slot"
assert all(min(abs(x - 40), abs(x - 150), abs(y - 30), abs(y - 110)) < 1e-9 for x, y, z in at)
assert abs(sum(((a[0] - b[0])**2 + (a[1] - b[1])**2)**.5 for a, b in zip(at, at[1:] + at[:1])) - 380) < 1e-9
END
expect_exit 2 "$spia" unfold "$part" --auto --to-part "$out/slot.json"
grep -q '"flipped_triangles": 0' "$out/auto.json" || fail "the report has no blank"
expect_exit 0 "$spia" unfold "$part" --script "$out/auto/lipped-channel-script.json" --out "$out/again" --threads 1 --strict
cmp "$out/auto/lipped-channel-step5.vtu" "$out/again/lipped-channel-step5.vtu" || fail "the script gives other bits"
python3 - "$out/auto/lipped-channel-script.json" "$out/edited.json" <<'END'
import json, sys
script = json.load(open(sys.argv[1]))
script["steps"][3]["options"] = {"tolerance": 1e-7}
json.dump(script, open(sys.argv[2], "w"))
END
expect_exit 2 "$spia" unfold "$part" --script "$out/edited.json" --redo auto
expect_exit 2 "$spia" unfold "$part" --script "$out/edited.json" --out "$out/auto" --redo 5
grep -q "only 3 states of the earlier run hold, for step 4 has changed" "$out.log" || fail "what does not hold is not told"
expect_exit 0 "$spia" unfold "$part" --script "$out/edited.json" --out "$out/auto" --redo auto --strict
grep -q "kept      3 states" "$out.log" || fail "not three states are kept"
expect_exit 0 "$spia" unfold "$part" --script "$out/edited.json" --out "$out/again" --redo 2 --strict
grep -q "kept      1 state " "$out.log" || fail "not the first state alone is kept"
cmp "$out/auto/lipped-channel-step5.vtu" "$out/again/lipped-channel-step5.vtu" || fail "redone steps give other bits"
expect_exit 2 "$spia" unfold "$part" --script "$out/edited.json" --out "$out/nowhere" --redo auto
grep -q "nowhere/lipped-channel-states.cbor: is not there; run the steps into this folder first" "$out.log" || { cat "$out.log"; fail "a folder without states is not told"; }
# broken off at the second of three steps: the first one is not lost
fender=$2/assets/parts/fender.obj
for signal in SIGINT SIGTERM; do
    rm -rf "$out/broken"
    expect_exit 130 python3 "$2/tests/cli/on_terminal.py" "region 2, region 3 onto" $signal "$spia" unfold "$fender" --auto --out "$out/broken"
    grep -q "cancelled after 1 of 3 steps; to go on from their states: --script $out/broken/fender-script.json --out $out/broken --redo auto" "$out.log" ||
        { cat "$out.log"; fail "a cancelled run does not say what it leaves"; }
done
[ "$(ls "$out/broken" | tr '\n' ' ')" = "fender-script.json fender-states.cbor " ] || fail "a cancelled run leaves something else: $(ls "$out/broken")"
cp "$out/broken/fender-script.json" "$out/three.json" # the first plan; the run itself would end with another one
expect_exit 0 "$spia" unfold "$fender" --script "$out/three.json" --out "$out/whole"
expect_exit 0 "$spia" unfold "$fender" --script "$out/broken/fender-script.json" --out "$out/broken" --redo auto
grep -q "kept      1 state of an earlier run; step 2 was not done" "$out.log" || fail "the state of a cancelled run is not kept"
cmp "$out/whole/fender-step3.vtu" "$out/broken/fender-step3.vtu" || fail "a run that was broken off gives other bits"
expect_exit 130 python3 "$2/tests/cli/on_terminal.py" "region 2, region 3 onto" SIGINT "$spia" unfold "$fender" --script "$out/three.json" --out "$out/whole"
[ -s "$out/whole/fender-step3.vtu" ] || fail "a cancelled run that adds nothing removes what was there"
expect_exit 0 "$spia" unfold "$fender" --script "$out/three.json" --out "$out/whole" --redo auto
grep -q "kept      3 states" "$out.log" || fail "a cancelled run with fewer states takes the place of one with more"
expect_exit 130 python3 "$2/tests/cli/on_terminal.py" polish SIGINT "$spia" unfold "$fender" --auto --polish --out "$out/unpolished"
expect_exit 0 "$spia" unfold "$fender" --script "$out/unpolished/fender-script.json" --out "$out/unpolished" --redo auto
grep -q "kept      2 states" "$out.log" || fail "the polish was cancelled, and the states are gone"
# broken off by a step that has no result
python3 - "$out/three.json" "$out/far.json" <<'END'
import json, sys
script = json.load(open(sys.argv[1]))
script["steps"][1]["target"] = {"cylinder": {"origin": [1e5, 0, 0], "axis": [0, 0, 1], "radius": 1}}
json.dump(script, open(sys.argv[2], "w"))
END
expect_exit 3 "$spia" unfold "$fender" --script "$out/far.json" --out "$out/failed"
grep -q "step 2 .*the state of the step before it is kept: --redo auto" "$out.log" || { cat "$out.log"; fail "the failed step does not say what is kept"; }
expect_exit 0 "$spia" unfold "$fender" --script "$out/three.json" --out "$out/failed" --redo auto
grep -q "kept      1 state " "$out.log" || fail "the state before a failed step is not kept"
expect_exit 0 "$spia" unfold "$part" --auto --polish --out "$out/polished" --json "$out/polished.json" --strict
for file in blank.dxf polished.dxf polished.vtu; do [ -s "$out/polished/lipped-channel-$file" ] || fail "no $file"; done
grep -q "outline_distance_mm" "$out/polished.json" || fail "the two blanks are not compared"
grep -q "outlines up to" "$out.log" || fail "the summary does not compare the blanks"
expect_exit 0 "$spia" unfold "$part" --auto --surface --tolerance 0.5 --out "$out/surface" --json "$out/surface.json" --strict
for file in iges step glb vtu dxf json; do [ -s "$out/surface/lipped-channel.$file" ] || fail "no $file of the surface"; done
grep -aq blank_from "$out/surface/lipped-channel.vtu" || fail "the fields do not tell where the blank comes from"
grep -q '"lipped-channel.iges"\|/lipped-channel.iges"' "$out/surface.json" || fail "the report does not list the surface"
python3 - "$out/surface/lipped-channel.json" <<'END' || fail "the report of the surface does not tell of the steps"
import json, sys
report = json.load(open(sys.argv[1]))
assert report["source"]["from"] == "steps" and len(report["source"]["steps"]) == 5
assert report["grid"]["folded_cells"] == 0 and report["surface"]["deviation_p95_mm"] < 2 and not report["shortcomings"]
END
expect_exit 1 "$spia" unfold "$part" --auto --surface=polished --surface-formats step --out "$out/polished-surface" --strict
grep -q "usual tolerance" "$out.log" || fail "a surface that is off without a tolerance is not said"
expect_exit 2 "$spia" unfold "$part" --auto --tolerance 0.5
grep -q '"from": "steps, polished"' "$out/polished-surface/lipped-channel.json" || fail "the polished blank is not told"
[ ! -e "$out/polished-surface/lipped-channel.iges" ] || fail "a surface format that was not asked for"
expect_exit 2 "$spia" unfold "$part" --auto --surface=other
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
grep -q "is not flat" "$out.log" || fail "the shortcoming is not told"
# what names must not do
expect_exit 2 "$spia" unfold "$part" --auto --out "$out/named" --name ../esc
grep -q "\"../esc\" is not a file name" "$out.log" || fail "a name that leads out of the folder is not refused in words"
[ ! -e "$out/esc-blank.dxf" ] || fail "a name leads out of the folder"
expect_exit 2 "$spia" run "$part" --out "$out/named" --name 'a\b'
expect_exit 2 "$spia" run "$out/not-there.obj" --out "$out/named" --name a/b
grep -q "is not a file name" "$out.log" || fail "the name is refused after the part is read"
esc=$'\033'
echo '{"steps": [{"name": "a\u001b]0;owned\u0007\u009b2Jz\u00e9", "freed": {"regions": ["region 6", "bend 1"]}, "fixed": {"regions": ["region 4"]}}]}' > "$out/escapes.json"
expect_exit 0 "$spia" unfold "$part" --script "$out/escapes.json"
! grep -q "$esc\|$(printf '\302\233')" "$out.log" || fail "a name sends control characters to the terminal"
grep -qF 'a\x1b]0;owned\x07\xc2\x9b2Jzé' "$out.log" || { cat -v "$out.log"; fail "the name is not shown"; }
expect_exit 0 python3 "$2/tests/cli/on_terminal.py" none SIGINT "$spia" unfold "$part" --script "$out/escapes.json"
! grep -q "owned$(printf '\007')" "$out.log" || fail "the bar sends control characters to the terminal"
expect_exit 2 "$spia" unfold "$part$esc[2J"
expect_exit 4 "$spia" unfold "$part" --auto --out "$out/escapes.json/$esc[2J"
! grep -q "$esc" "$out.log" || fail "a message sends control characters to the terminal"
# what stands twice, or beyond all bounds
sed 's/"fixed"/"name": "b", "fixed"/' "$out/escapes.json" > "$out/double.json"
expect_exit 2 "$spia" unfold "$part" --script "$out/double.json"
grep -qF "$out/double.json: /steps/0/name is there twice" "$out.log" || { cat "$out.log"; fail "a member that is there twice is taken"; }
echo '{"lines": [{"points": [[0, 0], [1e400, 0]]}]}' > "$out/huge.json"
expect_exit 2 "$spia" unfold "$part" --auto --out "$out/named" --to-part "$out/huge.json"
grep -q "huge.json: .*1e400" "$out.log" || fail "a number beyond all bounds is not told with the file"
# what a shorter script leaves of a longer one, and what hides its faults
mkdir -p "$out/less"
cp "$out/auto/"*.json "$out/less/"
expect_exit 0 "$spia" unfold "$part" --script "$out/less/lipped-channel-script.json" --out "$out/less" --strict
expect_exit 1 "$spia" unfold "$part" --script "$out/one.json" --out "$out/less" --strict
[ ! -e "$out/less/lipped-channel-blank.dxf" ] || fail "the blank of an earlier run is left"
[ ! -e "$out/less/lipped-channel-step2.vtu" ] || fail "a state of an earlier run is left"
[ -s "$out/less/lipped-channel-script.json" ] || fail "a script is gone"
echo "// mine" >> "$out/less/lipped-channel-script.json"
expect_exit 0 "$spia" unfold "$part" --auto --out "$out/less" --strict
grep -q "// mine" "$out/less/lipped-channel-script.before.json" || fail "an edited script is gone"
echo "// mine again" >> "$out/less/lipped-channel-script.json"
expect_exit 0 "$spia" unfold "$part" --auto --out "$out/less"
grep -q "// mine$" "$out/less/lipped-channel-script.before.json" || fail "a second edited script takes the place of the first"
grep -q "// mine again" "$out/less/lipped-channel-script.before-2.json" || fail "a second edited script is gone"
expect_exit 4 "$spia" unfold "$part" --auto --out "$out/one.json"
expect_exit 2 "$spia" unfold "$part" --auto --out "$out/less" --surface --json "$out/less/lipped-channel.json"
# files of the surface in the place of the part or of --json are refused before the work
(cd "$out" && expect_exit 2 "$spia" unfold "$part" --auto --out . --surface --json lipped-channel.json)
(cd "$out" && expect_exit 4 "$spia" unfold "$part" --auto --out . --surface --json lipped-channel.iges)
! grep -q "step 1" "$out.log" || fail "the place of the report is looked at after the work"
expect_exit 3 "$spia" unfold "$part" --script "$out/one.json" --out "$out/less" --surface
expect_exit 2 "$spia" unfold "$part" --auto --thickness nan
echo '{"lines": [{"closed": true, "points": [[20, 20], [40, 20], [40, 20], [40, 40], [20, 20]]}]}' > "$out/twice.json"
expect_exit 0 "$spia" unfold "$part" --auto --out "$out/less" --to-part "$out/twice.json" --strict
"$spia" unfold "$2/assets/parts/square-cup.obj" --auto > "$out.log" 2>&1
grep -q "strained beyond" "$out.log" || fail "necking is not told"
echo "unfold: all as it should be"
