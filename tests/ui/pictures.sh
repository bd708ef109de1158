#!/usr/bin/env bash
# Pictures of the whole window against tests/ui/pictures: pictures.sh VIEWER COMPARE FOLDER [renew].
# To renew the references, then look at them:
#   bash tests/ui/pictures.sh build/release/bin/{spia-viewer,compare_pictures} /tmp/pictures renew
set -euo pipefail
viewer=$(realpath "$1") compare=$(realpath "$2") scratch=$3 renew=${4:-}
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$scratch"
cd "$scratch"
export XDG_CONFIG_HOME="$PWD/config" XDG_STATE_HOME="$PWD/state" LIBGL_ALWAYS_SOFTWARE=1
ln -sfn "$here/../../assets" assets
# Measured, of the pixels: 0 to 0.03 % from run to run and with any number of threads of the renderer (the seconds of the
# solver are shown); another field 8 %, a missing legend 1.9 %, other labels 0.6 %.
limit=0.003
failed=0
for size in 1366x768 800x600; do
    rm -f dark.png light.png
    xvfb-run -a -s "-screen 0 1600x1000x24" "$viewer" --script "$here/scripts/pictures.json" \
        --width "${size%x*}" --height "${size#*x}"
    for theme in dark light; do
        mv "$theme.png" "$size-$theme.png"
        if [ "$renew" = renew ]; then
            "$compare" "$size-$theme.png" "$here/pictures/$size-$theme.png"
        else
            "$compare" "$size-$theme.png" "$here/pictures/$size-$theme.png" "$size-$theme-difference.png" $limit || failed=1
        fi
    done
done
exit $failed
