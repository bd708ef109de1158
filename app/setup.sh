#!/usr/bin/env bash
# Installs the packages of app/packages.txt that are missing, configures and builds a preset.
# Usage: bash app/setup.sh PRESET [TARGET...]; a second call does only what has changed. SPIA_PACKAGES names one more list of packages.
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

install_missing
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
printf 'SPIA set-up: building (%s) ...\n' "$preset" >&2
cmake --build --preset "$preset" "${targets[@]}" >"$log" 2>&1 || {
    grep -m 5 -A 8 -E 'error|FAILED' "$log" >&2 || tail -20 "$log" >&2
    fail "building failed (see $log)"
}
