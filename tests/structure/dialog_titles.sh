#!/usr/bin/env bash
# ImGui knows a dialog by its title, and two of one title close each other: each has a title of its own, written where it begins,
# and comes through the queue of dialogs. Usage: dialog_titles.sh [FOLDER of the panels]
set -uo pipefail
cd "$(dirname "$0")/../.."
panels=${1:-app/viewer/panels}
bad=0
complain() {
    printf '%s\n' "$*"
    bad=1
}
calls=$(grep -rnE 'begin_(dialog|modal)\(' "$panels" --include=*.cpp | grep -vE '/dialog_parts.cpp:')
titles=()
while IFS= read -r call; do
    file=${call%%:*}
    if [[ $call =~ begin_(dialog|modal)\(frame,\ \"([^\"]+)\" ]]; then
        titles+=("${BASH_REMATCH[2]##*###}")
    elif mapfile -t ids < <(grep -oE '"###[^"]+"' "$file") && [ ${#ids[@]} -eq 1 ]; then # its words change, its id does not
        id=${ids[0]//\"/}
        titles+=("${id#\#\#\#}")
    else
        complain "the title of this dialog is not written where it begins: $call"
    fi
done <<<"$calls"
while IFS= read -r title; do
    complain "two dialogs have the title \"$title\""
done < <(printf '%s\n' "${titles[@]}" | sort | uniq -d)
while IFS= read -r line; do
    complain "dialogs open through the queue (begin_dialog, begin_modal), or two open at once: $line"
done < <(grep -rnE 'BeginPopupModal' "$panels" --include=*.cpp | grep -vE '/dialog_parts.cpp:')
[ "${#titles[@]}" -ge 2 ] || complain "no dialogs were found in $panels"
[ $bad -eq 0 ] && echo "all ${#titles[@]} dialogs have titles of their own"
exit $bad
