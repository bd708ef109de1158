#!/usr/bin/env bash
# Installs the packages of app/packages.txt that are missing, configures and builds a preset.
# Usage: bash app/setup.sh PRESET [TARGET...]; a second call does only what has changed.
#        bash app/setup.sh packages: only installs. SPIA_PACKAGES names one more list of packages.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift

fail() {
    printf 'SPIA set-up: %s\n' "$*" >&2
    exit 1
}

install_missing() {
    command -v dpkg-query >/dev/null || fail "this script installs Debian packages; on another system install the \
equivalents of app/packages.txt by hand, then run: cmake --preset $preset && cmake --build --preset $preset"
    local wanted missing=() package
    mapfile -t wanted < <(grep -hvE '^\s*(#|$)' app/packages.txt ${SPIA_PACKAGES:+"$SPIA_PACKAGES"})
    for package in "${wanted[@]}"; do
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return
    printf 'SPIA set-up: installing %s\n' "${missing[*]}" >&2
    local root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || fail "packages are missing and there is no sudo; as root run: \
apt-get install ${missing[*]}"
        root=(sudo)
    fi
    "${root[@]}" apt-get update -qq || fail "apt-get update failed; check the network and /etc/apt/sources.list"
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2 ||
        fail "apt-get could not install ${missing[*]}; SPIA is made for Debian 12"
}

# Copies a build's output to the log and shows how far it is: on a terminal in one line, else in a
# line for every tenth of the steps, or every 30 seconds where these take longer.
show_progress() {
    local line done_steps all_steps share shown=-1 shown_at=$SECONDS
    while IFS= read -r line || [ -n "$line" ]; do
        printf '%s\n' "$line"
        [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\  && $line != *'] Re-'* ]] || continue # Re-running CMake is no step
        done_steps=${BASH_REMATCH[1]} all_steps=${BASH_REMATCH[2]}
        share=$((100 * done_steps / all_steps))
        if [ -t 2 ]; then
            printf '\r\033[KSPIA set-up: building (%s) [%d/%d] %d %%' "$preset" "$done_steps" "$all_steps" $share >&2
        elif [ $((share / 10)) -gt $((shown / 10)) ] || [ $((SECONDS - shown_at)) -ge 30 ]; then
            printf 'SPIA set-up: [%d/%d] %d %%\n' "$done_steps" "$all_steps" $share >&2
            shown=$share shown_at=$SECONDS
        fi
    done >"$log"
    if [ -t 2 ]; then printf '\n' >&2; fi
}

install_missing
[ "$preset" != packages ] || exit 0
log=build/$preset/configure.log
mkdir -p "build/$preset"
if [ ! -f "build/$preset/build.ninja" ]; then
    cmake --preset "$preset" >"$log" 2>&1 || {
        tail -20 "$log" >&2
        fail "configuring failed (see $log); if a compiler or folder has changed, remove build/$preset and try again"
    }
fi
targets=()
[ $# -gt 0 ] && targets=(--target "$@")
log=build/$preset/build.log
printf 'SPIA set-up: building (%s) ...' "$preset" >&2
[ -t 2 ] || printf '\n' >&2
NINJA_STATUS='[%f/%t] ' cmake --build --preset "$preset" "${targets[@]}" 2>&1 | show_progress || {
    grep -m 5 -A 8 -E 'error|FAILED' "$log" >&2 || tail -20 "$log" >&2
    fail "building failed (see $log)"
}
