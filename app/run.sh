#!/usr/bin/env bash
# Unfolds a part: bash app/run.sh [PART] [OPTIONS of `spia run`]. Without a part it takes the sample part.
# Installs and builds what is missing first.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
bash "$here/app/setup.sh" release spia
part=$here/assets/parts/inner-panel.obj
if [ $# -gt 0 ] && [ "${1#-}" = "$1" ]; then
    part=$1
    shift
fi
exec "$here/build/release/bin/spia" run "$part" "$@"
