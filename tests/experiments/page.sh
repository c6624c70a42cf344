#!/usr/bin/env bash
# page.sh PROGRAM NAME DOCS [BYTES]: a quick run of an experiment writes a page that is whole, the same on every run, and has the
# sections of the one that is checked in (DOCS/NAME.md), whose pictures are all there as well; that has BYTES at most. A run that is
# killed leaves the page that was there.
set -euo pipefail
program=$1 name=$2 docs=$3 most=${4:-1500000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0
fail() {
    echo "FAILED: $*"
    bad=1
}
headings() { awk '/^```/ { code = !code } !code && /^#+ /' "$1"; } # not comments of pbrt text
pictures() { grep -oE '!\[[^]]*\]\([^)]*\)' "$1" | sed 's/.*](//; s/)$//' | LC_ALL=C sort; } # not links, which go elsewhere

whole() { # whole FOLDER: every picture that the page shows is there, and no other
    local page=$1/$name.md
    diff <(pictures "$page") <(cd "$1" && find "$name" -type f | LC_ALL=C sort) || fail "$page and its folder disagree on the pictures"
    local file
    for file in "$1/$name"/*; do
        case $file in
            *.png) [[ $(head -c 4 "$file" | tail -c 3) == PNG ]] || fail "$file is no PNG" ;;
            *.svg) [[ $(tail -n 1 "$file") == "</svg>" ]] || fail "$file does not end" ;;
            *) fail "$file is neither PNG nor SVG" ;;
        esac
    done
    # Coordinates of plots count as numbers too.
    ! grep -nwiE -- '-?(nan|inf)' "$page" "$1/$name"/*.svg || fail "numbers that are none"
}

"$program" --quick "$work/a"
[[ -s $work/a/$name.md ]] || { echo "FAILED: no page" && exit 1; }
cp -r "$work/a" "$work/b"
"$program" --quick "$work/b" 2>/dev/null &
killed=$!
for ((i = 0; i < 3000; i++)); do # until it has made something
    [[ -z $(ls -A "$work/b/$name.new" 2>/dev/null) ]] || break
    sleep 0.02
done
kill -KILL "$killed" 2>/dev/null || fail "the run was over before it could be killed"
wait "$killed" 2>/dev/null || true
[[ -d $work/b/$name.new ]] || fail "a run that was killed left nothing half done"
diff -r -x '*.new' "$work/a" "$work/b" || fail "a run that was killed spoils the page"
"$program" --quick "$work/b" 2>/dev/null
diff -r "$work/a" "$work/b" || fail "two runs differ"
whole "$work/a"
rows=$(grep -cE '^\|.*[0-9]' "$work/a/$name.md")
((rows >= 50)) || fail "only $rows rows of numbers"

whole "$docs"
diff <(headings "$docs/$name.md") <(headings "$work/a/$name.md") || fail "the page that is checked in is of another program: run ./dev experiment $name"
! grep -q '^\*\*A quick run' "$docs/$name.md" || fail "the page that is checked in is of a quick run"
size=$(cat "$docs/$name.md" "$docs/$name"/* | wc -c)
((size <= most)) || fail "the page and its pictures are $size bytes"

# What cannot be written is said.
! "$program" --quick /dev/null/nowhere 2>/dev/null || fail "a folder that cannot be made is no error"
! "$program" 2>/dev/null || fail "no folder is no error"
exit "$bad"
