#!/usr/bin/env bash
# The checks of .clang-tidy on the C++ files that have changed: since the branch left its upstream
# or origin/main, else since the commit before; with what is not committed yet.
# Usage: tidy.sh [FILE...]. SPIA_TIDY_FILES=N looks at more than the 16 files that changed most, which
# take two to three minutes on two cores.
set -uo pipefail
cd "$(dirname "$0")/../.."
clang-tidy --version 2>/dev/null | grep -q 'version 14\.' || {
    echo "nothing is tidied: it needs clang-tidy 14 (Debian 12: apt-get install clang-tidy)"
    exit 0
}

base() {
    local upstream fork
    for upstream in '@{upstream}' origin/HEAD origin/main; do
        fork=$(git merge-base HEAD "$upstream" 2>/dev/null) || continue
        [ "$fork" = "$(git rev-parse HEAD)" ] || { echo "$fork"; return; }
    done
    git rev-parse --verify --quiet HEAD~1
}

changed_files() { # those with most new lines first
    local since=$1
    {
        git diff --numstat --find-renames --diff-filter=d "$since" -- '*.cpp' '*.h' |
            sed -E 's/\{.* => (.*)\}/\1/; s/\t[^\t]* => /\t/; s,//,/,'
        git ls-files --others --exclude-standard -- '*.cpp' '*.h' | sed 's/^/1\t0\t/'
    } | awk -F '\t' '$1 > 0' | sort -k 1,1rn -k 3 | cut -f 3
}

most=${SPIA_TIDY_FILES:-16}
if [ $# -gt 0 ]; then
    files=("$@")
else
    since=$(base) || { echo "nothing is tidied: git knows no commit before this one"; exit 0; }
    mapfile -t files < <(changed_files "$since")
    [ ${#files[@]} -gt 0 ] || { echo "no C++ file has changed: nothing is to be tidied"; exit 0; }
    if [ ${#files[@]} -gt "$most" ]; then
        echo "of ${#files[@]} changed files the $most with most new lines are looked at"
        files=("${files[@]:0:most}")
    fi
fi

# How each file is compiled, without GCC's precompiled headers, which clang cannot read.
logs=build/tidy/logs
rm -rf "$logs"
mkdir -p "$logs"
cmake --preset tidy >build/tidy/configure.log 2>&1 || {
    tail -20 build/tidy/configure.log
    echo "configuring failed: cmake --preset tidy"
    exit 1
}
tidy() { # a header by itself, too: compiled as the source whose name is nearest
    local log=$logs/${1//\//,}
    clang-tidy -p build/tidy --quiet "$1" >"$log" 2>"$log.errors" && return
    if [ -s "$log" ]; then cat "$log"; else echo "$1: clang-tidy failed"; cat "$log.errors"; fi
    return 1
}
export -f tidy
export logs
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" bash -c 'tidy "$1"' tidy || {
    echo "what .clang-tidy asks is to be mended, or excused by a NOLINT(check) with the reason beside it"
    exit 1
}
echo "${#files[@]} files are tidy"
