#!/usr/bin/env bash
# Every action that a menu, a button, a key or the mouse can push must be pushed so by a test of the window: what only scripts have done is
# not proved for hands. The tests of ui.* leave a list each. Those that no test pushes yet are named in not_by_hand.txt, which may only
# get shorter. Usage: pushed_by_hand.sh FOLDER (of these lists)
set -uo pipefail
lists=$1
cd "$(dirname "$0")/../.."
declare -A name_of
while read -r type name; do
    name_of[$type]=$name
done < <(tr -d '\n' <app/viewer/model/actions/script.cpp |
    grep -oE 'form<[A-Za-z]+>\(\s*"[a-z_]+"|form_of_inner\(\s*"[a-z_]+",\s*&[A-Za-z]+' |
    sed -E 's/form<([A-Za-z]+)>\(\s*"([a-z_]+)"/\1 \2/; s/form_of_inner\(\s*"([a-z_]+)",\s*&([A-Za-z]+)/\2 \1/')
[ ${#name_of[@]} -ge 50 ] || {
    echo "only ${#name_of[@]} actions were found in app/viewer/model/actions/script.cpp"
    exit 1
}
pushed=$(cat "$lists"/*.txt 2>/dev/null | sort -u)
known=$(grep -vE '^(#|$)' tests/structure/not_by_hand.txt)
missing=() pushable=0 bad=0
for type in "${!name_of[@]}"; do
    grep -rqE "\b$type\{|const $type [a-z]+\{" app/viewer/panels app/viewer/window.cpp || continue
    pushable=$((pushable + 1))
    grep -qx "${name_of[$type]}" <<<"$pushed" || missing+=("${name_of[$type]}")
done
while IFS= read -r name; do
    [ -z "$name" ] && continue
    echo "no test pushes this action through the window: $name"
    bad=1
done < <(printf '%s\n' "${missing[@]}" | sort | grep -vxF "$known")
while IFS= read -r name; do
    [ -z "$name" ] && continue
    echo "a test has pushed this action; take it out of tests/structure/not_by_hand.txt if it always does: $name"
done < <(grep -vxF "$(printf '%s\n' "${missing[@]}")" <<<"$known")
[ $bad -eq 0 ] && echo "$((pushable - ${#missing[@]})) of $pushable actions of the window are pushed through it by tests"
exit $bad
