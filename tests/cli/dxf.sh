#!/usr/bin/env bash
# usage: dxf.sh SPIA FOLDER ROOT - the DXF files of blanks, as ezdxf reads them (tests/packages.txt)
set -euo pipefail
spia=$1 out=$2 parts=$3/assets/parts cases=$3/../shared/cases
. "$(dirname "$0")/common.sh"
python=
for candidate in /usr/bin/python3 python3; do
    "$candidate" -c 'import ezdxf' 2> /dev/null && { python=$candidate; break; }
done
[ -n "$python" ] || { echo "skipped: python3-ezdxf is not installed"; exit 77; }
audit() { "$python" "$(dirname "$0")/dxf_audit.py" "$@"; }
draw() { # NAME PART ARGUMENT... - by both commands, in all versions and curves
    local name=$1 part=$2
    shift 2
    for how in "r2000 arcs" "r2000 polylines" "r2000 splines" "r12 arcs" "r12 polylines"; do
        set -- $how
        expect 0 "wrote .*dxf" "$spia" unfold "$part" --auto --formats dxf --dxf-version "$1" --dxf-curves "$2" --name "$name-$1-$2" --out "$out"
        expect 0 "wrote .*dxf" "$spia" run "$part" --formats dxf --dxf-version "$1" --dxf-curves "$2" --name "$name-run-$1-$2" --out "$out"
        audit "$out/$name-$1-$2-blank.dxf" "$out/$name-run-$1-$2.dxf"
    done
}
draw channel "$parts/perforated-channel.obj"
[ "$(grep -cE '^(UP|DOWN) ' "$out/channel-run-r2000-arcs.dxf")" = 5 ] || fail "not a text for each of the channel's bends, whose triangles lie askew over them"
draw dome "$parts/dome.obj"
expect 0 "^surface " "$spia" run "$parts/dome.obj" --formats dxf --tolerance 0.1 --out "$out"
expect 0 "^surface " "$spia" run "$parts/dome.obj" --formats dxf --degree 2 --out "$out"
expect 0 "^surface " "$spia" run "$parts/dome.obj" --formats dxf,iges --out "$out"
expect 0 "wrote .*dxf" "$spia" run "$parts/dome.obj" --formats dxf --out "$out"
! grep -qE "^(surface|grid|analysis) |^WARNING" "$out/log" || fail "who wants the blank alone reads of a surface"
expect 2 "no splines" "$spia" run "$parts/dome.obj" --dxf-version r12 --dxf-curves splines --out "$out"
expect 2 "dxf-tolerance is a distance" "$spia" run "$parts/dome.obj" --dxf-tolerance nan --out "$out"
if [ -d "$cases" ]; then
    draw plate "$cases/11-plate.step"
    draw bracket "$cases/05-lbracket.step"
    draw mark "$cases/01-mark-0.2.step"
    grep -qx CIRCLE "$out/plate-run-r12-arcs.dxf" || fail "the hole of the plate is no circle"
    [ "$("$python" "$(dirname "$0")/dxf_marks.py" "$out/mark-run-r2000-arcs.dxf")" = "1 closed, 72.0000 mm2" ] || fail "not the mark of 12 x 6 mm"
    [ "$(grep -cE '^BEND_(UP|DOWN)$' "$out/bracket-run-r2000-arcs.dxf")" = 3 ] || fail "not one line and its text, and their layer"
else
    echo "without $cases"
fi
