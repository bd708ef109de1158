#!/usr/bin/env bash
# Every preset of CMakePresets.json configures, from nothing; none is built.
# Usage: presets.sh FOLDER (for the configured trees, made anew)
set -uo pipefail
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$(dirname "$0")/../.."
mapfile -t presets < <(cmake --list-presets | sed -n 's/^ *"\([^"]*\)".*/\1/p')
bad=0 configured=0
for preset in "${presets[@]}"; do
    if [ "$preset" = fuzz ] && ! command -v clang++ >/dev/null; then
        echo "the preset fuzz is skipped: it needs clang++ of the Debian package clang"
        continue
    fi
    rm -rf "${folder:?}/$preset"
    if cmake --preset "$preset" -B "$folder/$preset" >"$folder/$preset.log" 2>&1; then
        configured=$((configured + 1))
    else
        grep -A 12 'CMake Error' "$folder/$preset.log" || tail -20 "$folder/$preset.log"
        echo "the preset $preset does not configure: cmake --preset $preset"
        bad=1
    fi
    rm -rf "${folder:?}/$preset"
done
[ ${#presets[@]} -ge 5 ] || { echo "only ${#presets[@]} presets were found in CMakePresets.json"; bad=1; }
[ $bad -eq 0 ] && echo "$configured of ${#presets[@]} presets configure"
exit $bad
