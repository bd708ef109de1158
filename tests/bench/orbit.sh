#!/usr/bin/env bash
# How a fine part is looked at without a graphics card: orbit.sh VIEWER PART [ARGUMENTS...]; prints the seconds from the start to the first
# settled picture, and the frames while the part is turned by the mouse, milliseconds. The screen is 1920 x 1080, OpenGL in software.
set -euo pipefail
viewer=$1 part=$2
shift 2
scratch=$(mktemp -d)
trap 'kill "${pids[@]}" 2>/dev/null || true; rm -rf "$scratch"' EXIT
export XDG_CONFIG_HOME="$scratch/config" XDG_STATE_HOME="$scratch/state" LIBGL_ALWAYS_SOFTWARE=1
number=$((90 + RANDOM % 900))
pids=()
Xvfb ":$number" -screen 0 1920x1080x24 >/dev/null 2>&1 &
pids+=($!)
export DISPLAY=":$number"
until xdotool getdisplaygeometry >/dev/null 2>&1; do sleep 0.1; done
report=$scratch/report.json
begin=$(date +%s.%N)
"$viewer" "$part" --width 1920 --height 1080 --report "$report" --follow "$@" >/dev/null 2>&1 &
pids+=($!)
look() { python3 -c '
import json, sys
try: report = json.load(open(sys.argv[1]))
except (OSError, ValueError): sys.exit(1)
sys.exit(0 if eval(sys.argv[2], {"r": report}) else 1)' "$report" "$1"; }
until look '(r.get("part") or {}).get("triangles", 0) > 0 and not (r.get("job") or {}).get("running")'; do sleep 0.1; done
printf 'first picture %.1f s\n' "$(echo "$(date +%s.%N) - $begin" | bc)"
sleep 2
read -r x y <<<"$(python3 -c '
import json, sys
view = json.load(open(sys.argv[1]))["window"]["views"]["part"]
print(int(view["at"][0] + view["size"][0] / 2), int(view["at"][1] + view["size"][1] / 2))' "$report")"
moves=()
for k in $(seq 1 120); do moves+=(mousemove $((x + 2 * k % 160 - 80)) $((y + k % 60 - 30)) sleep 0.03); done
xdotool mousemove "$x" "$y" sleep 0.5 mousedown 3 "${moves[@]}" mouseup 3
sleep 3
until look 'r["frames_while_turning"].get("frames", r["frames_while_turning"].get("count", 0)) > 0'; do sleep 0.2; done
python3 -c 'import json, sys; r = json.load(open(sys.argv[1])); print("turning", r["frames_while_turning"]); print("all", r["frames"])' "$report"
