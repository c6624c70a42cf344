#!/usr/bin/env bash
# edges.sh FACTS SOURCE_DIR COMPILER: the rooms are linked in the order of docs/architecture.md, and the compiler enforces it.
#
# 1. What CMake links each room to is the list below, no more and no less.
# 2. The list has no cycle: each room names rooms above it only.
# 3. For every pair of rooms, a file of one line that includes a header of the second one is compiled with the include path
#    of the first one. It must compile where the order allows it, and otherwise fail because the header is not found.
set -euo pipefail
trap 'echo "FAILED: stopped at line $LINENO"' ERR
facts=$1 top=$2 compiler=$3

declare -A sees flags may
# shellcheck source=/dev/null
source "$facts"

# Ground floor first. A room sees what it names, and through that what those rooms show in their own headers.
order=(math spectrum sampling image scene read write model world film transport render apps)
may[math]=""
may[spectrum]="math"
may[sampling]="spectrum math"
may[image]="math"
may[scene]="sampling spectrum math"
may[read]="scene sampling spectrum math"
may[write]="scene image sampling spectrum math"
may[model]="scene image sampling spectrum math"
may[world]="model scene image sampling spectrum math"
may[film]="image math"
may[transport]="world film model scene sampling spectrum math"
may[render]="transport world film scene math"
may[apps]="render transport world film model scene read write image sampling spectrum math"

bad=0
fail() {
    echo "FAILED: $*"
    bad=1
}
sorted() { tr ' ' '\n' <<<"$*" | sort | xargs; }

declare -A reach # all that a room can see, itself included
for room in "${order[@]}"; do
    [[ $(sorted "${sees[$room]}") == "$(sorted "${may[$room]}")" ]] ||
        fail "CMakeLists.txt links $room to '${sees[$room]}', the house to '${may[$room]}'"
    all=$room
    for below in ${may[$room]}; do
        if [[ -z ${reach[$below]:-} ]]; then fail "$room names $below, which is not below it"; else all+=" ${reach[$below]}"; fi
    done
    reach[$room]=$(tr ' ' '\n' <<<"$all" | sort -u | xargs)
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
refused=0 allowed=0
for from in "${order[@]}"; do
    compiled=0
    for to in "${order[@]}"; do
        [[ $from != "$to" ]] || continue
        header=$(compgen -G "$top/src/$to/include/$to/*.h" | LC_ALL=C sort | head -n 1) || header="" # a room without headers has no such folder
        if [[ -z $header ]]; then
            # Only the programs may do without headers; nobody is above them.
            [[ $to == apps ]] || ! compgen -G "$top/src/$to/*.cpp" >/dev/null || fail "room $to has sources, but no header"
            continue
        fi
        include=$to/$(basename "$header")
        echo "#include \"$include\"" >"$work/try.cpp"
        if [[ " ${reach[$from]} " == *" $to "* ]]; then
            # One full compilation a room; the preprocessor alone shows for the others that they are found.
            how=-E
            ((compiled)) || how=-fsyntax-only
            compiled=1
            # shellcheck disable=SC2086
            if "$compiler" -std=c++20 ${flags[$from]} $how "$work/try.cpp" >/dev/null 2>"$work/log"; then
                allowed=$((allowed + 1))
            else
                fail "$from must be able to include $include: $(head -n 3 "$work/log")"
            fi
        else
            # shellcheck disable=SC2086
            if "$compiler" -std=c++20 ${flags[$from]} -fsyntax-only "$work/try.cpp" >/dev/null 2>"$work/log"; then
                fail "$from must not see $to, but $include compiles there"
            elif ! grep -qE "$include.*(No such file|file not found)" "$work/log"; then
                fail "$from cannot include $include, but for another reason: $(head -n 3 "$work/log")"
            else
                refused=$((refused + 1))
            fi
        fi
    done
done
echo "$refused back edges were refused by the compiler, $allowed edges of the house work"
((refused > 0 && allowed > 0)) || fail "nothing was tried"
exit "$bad"
