#!/usr/bin/env bash
# The viewer under a virtual screen with software OpenGL: run_viewer.sh VIEWER FOLDER ARGUMENTS...; checks that it leaves with 0 (1 if EXPECTED_EXIT says so) and,
# where a picture was asked for, that the picture has more than one colour to show.
set -euo pipefail
viewer=$1 scratch=$2
shift 2
mkdir -p "$scratch"
export XDG_CONFIG_HOME="$scratch/config" XDG_STATE_HOME="$scratch/state" LIBGL_ALWAYS_SOFTWARE=1
# Parts begin with one patch, whose grid and corners most scripts are about.
mkdir -p "$XDG_CONFIG_HOME/spia"
[ -e "$XDG_CONFIG_HOME/spia/preferences.json" ] ||
    echo '{"schema": "spia-preferences/1", "one_patch": true}' >"$XDG_CONFIG_HOME/spia/preferences.json"
cd "$(dirname "$0")/../.."
rm -f "$scratch/code"
# xvfb-run's own exit code is another one where it cannot clean up behind itself.
xvfb-run -a -s "-screen 0 3840x2160x24 -noreset" sh -c '"$@"; echo $? >"$0"' "$scratch/code" \
    "$viewer" --report "$scratch/report.json" --screenshot "$scratch/window.png" --exit "$@" || true
code=$(cat "$scratch/code")
[ "$code" -eq "${EXPECTED_EXIT:-0}" ] || { echo "exit code $code"; exit 1; }
[ -s "$scratch/report.json" ] || { echo "no report"; exit 1; }
size=$(stat -c %s "$scratch/window.png")
[ "$size" -gt 15000 ] || { echo "the picture of $size bytes is empty"; exit 1; }
