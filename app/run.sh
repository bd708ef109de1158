#!/usr/bin/env bash
# Opens a part in the viewer: bash app/run.sh [PART] [OPTIONS]. Without a part it takes the sample part. With no display, or with an option
# of the command line (--out, --json, ...), it runs the whole chain with `spia run` instead. Installs and builds what is missing first.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
part=
if [ $# -gt 0 ] && [ "${1#-}" = "$1" ]; then
    part=$1
    shift
fi
window=yes
for option in "$@"; do
    case $option in
        --unit | --unit=* | --run-all | --light | --script* | --report* | --follow | --screenshot* | --exit | --width* | --height* | mm | cm | m | inch) ;;
        --*) window=no ;;
    esac
done
if [ $window = yes ] && [ -z "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    window=no
    echo "There is no display: running the command line instead of the viewer." >&2
fi
if [ $window = yes ]; then
    bash "$here/app/setup.sh" release spia spia-viewer
    exec "$here/build/release/bin/spia-viewer" ${part:+"$part"} "$@"
fi
bash "$here/app/setup.sh" release spia
exec "$here/build/release/bin/spia" run "${part:-$here/assets/parts/inner-panel.obj}" "$@"
