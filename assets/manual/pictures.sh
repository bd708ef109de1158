#!/usr/bin/env bash
# Draws the pictures of the manual anew with the viewer itself. Usage: pictures.sh SPIA_VIEWER; needs xvfb-run, and ImageMagick
# to make the files small.
set -euo pipefail
viewer=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$here/pictures"
cd "$here/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export XDG_CONFIG_HOME=$scratch XDG_STATE_HOME=$scratch LIBGL_ALWAYS_SOFTWARE=1
draw() { # NAME WIDTH HEIGHT ACTIONS
    printf '{"schema": "spia-script/1", "actions": [%s, {"do": "screenshot", "file": "%s"%s}]}' "$4" "$here/pictures/$1.png" "${5:-}" >"$scratch/$1.json"
    xvfb-run -a -s '-screen 0 1920x1200x24' "$viewer" --width "$2" --height "$3" --light --script "$scratch/$1.json"
    convert "$here/pictures/$1.png" +dither -colors 250 -define png:compression-level=9 PNG8:"$scratch/small.png"
    mv "$scratch/small.png" "$here/pictures/$1.png"
}
open() { printf '{"do": "open_part", "file": "assets/parts/%s"}' "$1"; }
run='{"do": "run_to", "stage": "fit"}, {"do": "wait"}, {"do": "dismiss_messages"}, {"do": "fit_view"}'
draw window 1280 720 "$(open inner-panel.obj), $run"
draw results 1000 560 "$(open square-cup.obj), $run, {\"do\": \"set_display\", \"field\": \"thinning\", \"per_face\": true}"
draw steps 1100 640 "$(open lipped-channel.obj), {\"do\": \"wait\"}, {\"do\": \"propose_steps\"}, {\"do\": \"wait\"}, {\"do\": \"run_steps\"}, {\"do\": \"wait\"}, {\"do\": \"set_view\", \"maximised\": \"part\"}, {\"do\": \"show_step\", \"position\": 4.5}, {\"do\": \"dismiss_messages\"}, {\"do\": \"fit_view\"}"
draw grid 1000 560 "$(open fender.obj), $run"
draw surface 1280 720 "$(open fender.obj), $run, {\"do\": \"set_view\", \"maximised\": \"surface\"}, {\"do\": \"fit_view\"}" ', "view": "surface", "width": 720, "height": 480'
