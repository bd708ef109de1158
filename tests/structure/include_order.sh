#!/usr/bin/env bash
# A module includes only what stands before it in this list, a room of it likewise; heavy third-party headers stay where they belong.
set -uo pipefail
cd "$(dirname "$0")/../.."
order=(core options mesh remesh sparse forming compare limits unfold coons nurbs layout deform part exchange picture pipeline report)
bad=0
complain() {
    printf '%s\n' "$*"
    bad=1
}
allowed=()
for module in "${order[@]}"; do
    allowed+=("$module")
    [ -d "engine/$module" ] || continue
    pattern=$(IFS='|'; echo "${allowed[*]}")
    while IFS= read -r line; do
        complain "against the order ($module may include only: ${allowed[*]}): $line"
    done < <(grep -rnE '#include "(engine|app|tests)/' "engine/$module" | grep -vE "#include \"engine/($pattern)/")
done
# So do the rooms within a module.
rooms() {
    local module=$1 before=""
    shift
    for room in "$@"; do
        before+="${before:+|}$room"
        while IFS= read -r line; do
            complain "against the order of the rooms ($module/$room may include only: $before): $line"
        done < <(grep -rnE "#include \"engine/$module/[a-z]+/" "engine/$module/$room" |
            grep -vE "#include \"engine/$module/($before)/")
    done
}
rooms mesh doctor cut flat solid
rooms forming material process solver
rooms unfold target plan step
rooms pipeline files blank outputs shortcomings
rooms report text figures json html
while IFS= read -r line; do
    complain "only engine/exchange/cad and the lines as STEP and IGES know the CAD kernel: $line"
done < <(grep -rnE '#include <(Standard_|Geom_|TopoDS|BRep|IGES|STEP|Interface_|Message_|XSControl)' engine app |
    grep -vE '^engine/exchange/(cad/|lines/write_lines)')
while IFS= read -r line; do
    complain "only engine/exchange/mesh knows glTF: $line"
done < <(grep -rnE '#include <.*tiny_gltf' engine app | grep -v '^engine/exchange/mesh/')
while IFS= read -r line; do
    complain "only engine/sparse knows SuiteSparse: $line"
done < <(grep -rnE '#include <(cholmod|umfpack|SuiteSparse)' engine app tests | grep -vE '^(engine/sparse|tests/bench)/')
while IFS= read -r line; do
    complain "the engine has no window: $line"
done < <(grep -rnE '#include <(GLFW|imgui|glm|GL/)' engine)
while IFS= read -r line; do
    complain "only app/viewer/render and the window itself know OpenGL: $line"
done < <(grep -rnE '#include <(epoxy|GL)/' app | grep -vE '^app/viewer/(render/|window|gl_window)')
while IFS= read -r line; do
    complain "the viewer's model and views know neither ImGui nor a window: $line"
done < <(grep -rnE '#include <(imgui|GLFW|epoxy)' app/viewer/model app/viewer/views)
[ $bad -eq 0 ] && echo "the include order holds"
exit $bad
