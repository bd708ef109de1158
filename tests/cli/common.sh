# Sourced by the tests of this folder: makes the folder $out anew, if it is one of an earlier run, and says what is expected.
[ ! -e "$out" ] || [ -e "$out/.made_by_a_test" ] || { echo "FAILED: $out is no folder of an earlier run"; exit 2; }
rm -rf "$out"
mkdir -p "$out"
touch "$out/.made_by_a_test"
fail() { echo "FAILED: $*"; exit 1; }
expect() { # CODE WORDS COMMAND...
    local wanted=$1 words=$2 got=0
    shift 2
    "$@" > "$out/log" 2>&1 || got=$?
    [ "$got" = "$wanted" ] || { cat "$out/log"; fail "exit $got, not $wanted: $*"; }
    grep -q -- "$words" "$out/log" || { cat "$out/log"; fail "no '$words': $*"; }
}
