#!/usr/bin/env bash
# usage: cad.sh SPIA SOURCE FOLDER - CAD files on the command line
set -euo pipefail
spia=$1 source=$2 out=$3
. "$(dirname "$0")/common.sh"
triangles() { grep -o '"triangles": [0-9]*' "$out/info.json" | grep -o '[0-9]*'; }
expect 0 "" "$spia" run "$source/assets/parts/dome.obj" --out "$out" --patches one --formats step --name dome
step="$out/dome.step"
expect 0 "holds  *body:0  *dome .*1 face, sheet body" "$spia" info "$step" --no-remesh --json "$out/info.json"
grep -q '"choice": "body:0"' "$out/info.json" || fail "no items in the JSON"
usual=$(triangles)
expect 0 "can be unfolded" "$spia" info "$step" --part dome --no-remesh --json "$out/info.json"
expect 2 "'roof' is not in the file.*" "$spia" info "$step" --part roof
expect 0 "within 0.5 mm of them" "$spia" info "$step" --deflection 0.5 --no-remesh --json "$out/info.json"
[ "$(triangles)" -lt "$usual" ] || fail "a larger deflection gave no fewer triangles"
expect 0 "can be unfolded" "$spia" info "$step" --angle 2 --no-remesh --json "$out/info.json"
[ "$(triangles)" -gt "$usual" ] || fail "a smaller angle gave no more triangles"
expect 0 "can be kept (--no-remesh)" "$spia" info "$step"
expect 2 "excludes" "$spia" info "$step" --remesh --no-remesh
: >"$out/empty.txt"
expect 2 "empty.txt: the file is empty" "$spia" run "$step" --k-factor "$out/empty.txt" --out "$out"
expect 0 "not sewn" "$spia" info "$step" --sewing 0 --skip-bad-faces
for wrong in "--sewing -1" "--sewing nan" "--sewing 1e9" "--deflection 0" "--deflection inf" "--deflection 1e-300" "--angle 0" "--angle 95" "--angle nan"; do
    expect 2 "sewing tolerance\|deflection\|angle" "$spia" info "$step" $wrong
done
expect 2 "are for CAD files" "$spia" run "$source/assets/parts/dome.obj" --out "$out" --deflection 1
expect 2 "are for CAD files" "$spia" unfold "$source/assets/parts/dome.obj" --auto --skip-bad-faces
expect 0 "dome-mfem-plastic_strain.gf" "$spia" run "$source/assets/parts/dome.obj" --out "$out/iga" --formats gismo,mfem,geopdes,iga-k --json "$out/iga.json"
for file in gismo.xml gismo-thickness.xml gismo-plastic_strain.xml mfem.mesh mfem-thickness.gf mfem-plastic_strain.gf geopdes.txt iga.k; do
    [ -s "$out/iga/dome-$file" ] || fail "no dome-$file"
    grep -q "dome-$file" "$out/iga.json" || fail "the report does not list dome-$file"
done
echo "CAD files on the command line are well"
