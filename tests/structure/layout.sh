#!/usr/bin/env bash
# Every C++ file is laid out by .clang-format, as clang-format 14 of Debian 12 does it.
# Usage: layout.sh [--write] [FILE...]: lays them out with --write; without files all of the tree
set -uo pipefail
cd "$(dirname "$0")/../.."
mode=(--dry-run -Werror)
if [ "${1:-}" = --write ]; then
    mode=(-i)
    shift
fi
clang-format --version 2>/dev/null | grep -q 'version 14\.' || {
    echo "the layout is not checked: it needs clang-format 14 (Debian 12: apt-get install clang-format)"
    exit 0
}
files=("$@")
if [ $# -eq 0 ]; then
    mapfile -t files < <(find app engine tests -name '*.cpp' -o -name '*.h')
fi
if ! found=$(printf '%s\0' "${files[@]}" | xargs -0 -n 40 -P "$(nproc)" clang-format "${mode[@]}" 2>&1); then
    { grep -aE ': error: ' <<<"$found" || echo "$found"; } |
        sed -E 's/: error: .*/: not laid out by .clang-format/' | sort -u
    echo "to lay it out: bash tests/structure/layout.sh --write"
    exit 1
fi
echo "${#files[@]} files are laid out by .clang-format"
