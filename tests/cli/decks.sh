#!/usr/bin/env bash
# usage: decks.sh SPIA FOLDER - parts of a solver deck on the command line
set -euo pipefail
spia=$1 out=$2
. "$(dirname "$0")/common.sh"
deck="$out/two parts.inp"
{
    echo "*NODE"
    for part in 0 1; do for i in 0 1 2 3; do for j in 0 1 2 3; do
        echo "$((100 * part + 4 * i + j + 1)), $((500 * part + 20 * i)), $((20 * j)), $((i * i))"
    done; done; done
    for part in 0 1; do
        echo "*ELEMENT, TYPE=S4R, ELSET=$([ $part = 0 ] && echo Lid || echo Base)"
        for i in 0 1 2; do for j in 0 1 2; do
            n=$((100 * part + 4 * i + j + 1))
            echo "$((100 * part + 3 * i + j + 1)), $n, $((n + 4)), $((n + 5)), $((n + 1))"
        done; done
    done
    printf '*SHELL SECTION, ELSET=Lid, MATERIAL=DC04\n0.8, 5\n*SHELL SECTION, ELSET=Base, MATERIAL=DC01\n1.5\n'
    printf '*ELSET, ELSET=Row, GENERATE\n1, 3, 1\n'
} > "$deck"
expect 2 "part  *Base  *9 shells, thickness 1.5, DC01" "$spia" info "$deck"
grep -q "element set  *Row" "$out/log" || fail "no sets"
expect 0 "can be unfolded" "$spia" info "$deck" --part Lid --json "$out/info.json"
grep -q '"thickness_mm": 0.8' "$out/info.json" || fail "no thickness in the JSON"
expect 2 "choose by id or name (--part):" "$spia" run "$deck" --out "$out/run"
expect 2 "there is no part 'Roof'" "$spia" run --part Roof "$deck" --out "$out/run"
expect 0 "0.8 mm thick as in the deck" "$spia" run --part lid "$deck" --out "$out/run" --formats csv --json "$out/run.json"
grep -q '"sheet_thickness_mm": 0.8' "$out/run.json" || fail "the sheet is not 0.8 mm thick"
expect 0 "20.32 mm thick as in the deck" "$spia" run --part lid --unit inch "$deck" --out "$out/run" --formats csv
expect 0 "2 mm thick as requested, not 0.8 mm" "$spia" run --part Row "$deck" --thickness 2 --out "$out/run" --formats csv
expect 0 "two parts-dynain.k" "$spia" run --part Lid "$deck" --out "$out/back" --json "$out/back.json" \
    --formats dynain,nastran,mapping,blank-k,blank-bdf,blank-inp,blank-msh
for file in -dynain.k -thickness.bdf -strains.csv -elements.csv -nodes.csv -blank.k -blank.bdf -blank.inp -blank.msh; do
    [ -s "$out/back/two parts$file" ] || fail "no $file"
    grep -q "two parts$file" "$out/back.json" || fail "the report does not name $file"
done
for file in -dynain.k -blank.k -blank.bdf -blank.inp -blank.msh; do
    expect 0 "9 shells" "$spia" info "$out/back/two parts$file"
done
expect 0 "0.8 mm thick as in the deck" "$spia" run "$out/back/two parts-blank.inp" --out "$out/again" --formats csv
[ "$(head -1 "$out/back/two parts-elements.csv")" = "element,part,thickness,thinning,plastic_strain,strain_major,strain_minor" ] || fail "the head of the table"
[ "$(cut -d, -f1 "$out/back/two parts-elements.csv" | tr '\n' ' ')" = "element 1 2 3 4 5 6 7 8 9 " ] || fail "the ids of the elements"
expect 0 "two parts-blank.msh" "$spia" unfold --part Base "$deck" --auto --out "$out/steps" --formats blank-msh
grep -q "^101 3 2 2 2 101 105 106 102$" "$out/steps/two parts-blank.msh" || fail "the first quad of the blank"
expect 0 "two parts-blank.dxf" "$spia" unfold --part Base "$deck" --auto --out "$out/steps" --formats dxf
[ ! -e "$out/steps/two parts-blank.msh" ] || fail "the mesh of an earlier blank is left"
expect 2 "one file" "$spia" unfold --part Base "$deck" --auto --out "$out/steps" --formats blank-k --surface --surface-formats blank-k
expect 2 "dynain" "$spia" unfold --part Base "$deck" --auto --out "$out/steps" --formats dynain
expect 2 "several parts\|separate pieces" "$spia" compare --part Lid,Base "$deck" --methods lscm
expect 0 "1.5 mm thick as in the deck" "$spia" compare --part Base "$deck" --methods lscm
expect 0 "0.8 mm thick as in the deck" "$spia" unfold --part Lid "$deck" --auto
expect 2 "from solver decks and CAD files only" "$spia" info --part 1 "$(dirname "$0")/../../assets/parts/dome.obj"
expect 0 "remeshed from 18 to" "$spia" info --remesh --remesh-size 8 --part Lid "$deck"
expect 2 "requires --remesh" "$spia" info --remesh-size 8 --part Lid "$deck"
expect 2 "the size of remeshing is 0.001 mm" "$spia" run --remesh --remesh-size 0.001 --part Lid --out "$out/r" "$deck"
expect 0 "remeshed from" "$spia" unfold --remesh --auto "$(dirname "$0")/../../assets/parts/lipped-channel.obj"
expect 0 "9 triangles have\|18 triangles have" "$spia" info --min-angle 50 --part Lid "$deck"
expect 1 "WARNING .*18 triangles have edges whose lengths differ by more than 1.2 times, the most" \
    "$spia" run --max-edge-ratio 1.2 --part Lid --out "$out/t" --formats csv --strict "$deck"
expect 0 "can be unfolded" "$spia" info --min-angle 30 --max-edge-ratio 2 --part Lid "$deck"
! grep -q "triangles have" "$out/log" || fail "targets that are met"
expect 2 "between 0 and 60" "$spia" info --min-angle 60 --part Lid "$deck"
expect 2 "the word after '--part' is empty" "$spia" info "$deck" --part ""
expect 2 "'--part=' needs a value" "$spia" info "$deck" --part=
sed 's/^\*NODE$/*INCLUDE, INPUT=lost.inp\n&/' "$deck" > "$out/lost.inp.deck.inp"
expect 1 "WARNING .*lost.inp is not there" "$spia" run "$out/lost.inp.deck.inp" --part Lid --out "$out/l" --formats csv --strict
expect 0 "WARNING .*lost.inp is not there" "$spia" run "$out/lost.inp.deck.inp" --part Lid --out "$out/l" --formats csv
echo "decks: all as expected"
