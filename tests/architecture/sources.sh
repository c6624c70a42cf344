#!/usr/bin/env bash
# sources.sh SOURCE_DIR: what neither the compiler nor the linker sees. Comments do not count.
set -uo pipefail
cd "$1" || exit 1

bad=0
# refuse MESSAGE PATTERN FILE…: no file has a line of code that matches the extended regular expression
refuse() {
    local message=$1 pattern=$2 found
    shift 2
    (($#)) || return 0
    # Strings stay: an #include is one. Only // comments are cut off; the house has no other.
    found=$(awk -v pattern="$pattern" '{ line = $0; sub(/(^|[^:])\/\/.*/, "", line) } line ~ pattern { print FILENAME ":" FNR ": " $0 }' "$@")
    [[ -z $found ]] || { printf 'FAILED: %s\n%s\n' "$message" "$found" && bad=1; }
}
files() { find "$@" -name '*.cpp' -o -name '*.h' | LC_ALL=C sort; } # files DIR…

mapfile -t all < <(files src)
mapfile -t not_world < <(files src | grep -v '^src/world/')
mapfile -t not_apps < <(files src | grep -v '^src/apps/')
((${#all[@]} > 0)) || { echo "FAILED: no sources found" && exit 1; }

refuse 'an include by relative path goes around the order of the rooms' '#[ \t]*include[ \t]*["<][^">]*\.\.\/' "${all[@]}"
refuse 'only src/world names Embree' '#[ \t]*include.*embree|(^|[^A-Za-z0-9_])(rtc[A-Z]|RTC[A-Z])' "${not_world[@]}"
refuse 'only src/apps prints to a terminal' \
    'std::(cout|cerr|clog)|(^|[^A-Za-z0-9_])(printf|vprintf|puts|putchar|perror)[ \t]*\(|fprintf[ \t]*\([ \t]*std(out|err)|fmt::print[ \t]*\(' \
    "${not_apps[@]}"
refuse 'a library does not end the program' '(^|[^A-Za-z0-9_.>])(_?[eE]xit|quick_exit|abort|terminate)[ \t]*\(' "${not_apps[@]}"
refuse 'numbers come from sampling/hash.h, keyed, never from a generator with state' \
    'std::(mt19937|random_device|default_random_engine|minstd_rand)|(^|[^A-Za-z0-9_])(rand|srand|drand48)[ \t]*\(' "${all[@]}"

echo "${#all[@]} sources looked at"
exit "$bad"
