#!/usr/bin/env bash
# program.sh PEERS NEPHROID: the program with renderers that are scripts. One that renders the scene is measured, and exit code 0; one
# that renders it half as bright, fails, leaves no picture, or is not there, is said to have, and is exit code 1 (but for the last).
set -euo pipefail
peers=$1 nephroid=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0
fail() {
    echo "FAILED: $*"
    bad=1
}

# As pbrt-v4 is called: --nthreads N --seed S --outfile out.exr scene.pbrt
script() { # script NAME COMMAND…
    printf '#!/bin/sh\n%s\n' "$2" >"$work/$1"
    chmod +x "$work/$1"
}
script same "exec '$nephroid' render \"\$7\" --quiet --threads \"\$2\" --seed \"\$4\" -o \"\$6\""
script half "exec '$nephroid' render \"\$7\" --quiet --threads \"\$2\" --seed \"\$4\" --set iso=50 -o \"\$6\""
script broken 'echo "out of colours"; exit 3'
script lazy 'exit 0'

run() { # run NAME OPTIONS…: into $work/NAME
    local name=$1
    shift
    "$peers" --scenes cornell --renderers nephroid,pbrt --size 40x40 --seconds 0.1 --repetitions 2 --threads 1 "$@" "$work/$name.page" \
        >"$work/$name.out" 2>"$work/$name.err"
}
wrong() { # wrong NAME WORDS: exit code 1, and what it says at the end
    local code=0
    run "$1" --pbrt "$work/$1" || code=$?
    ((code == 1)) || fail "$1: exit code $code"
    tail -n 2 "$work/$1.err" | grep -qF "$2" || fail "$1: does not say: $2"
    [[ -s $work/$1.page/peers.md ]] || fail "$1: no page"
}

run same --pbrt "$work/same" --keep "$work/kept" || fail "a renderer that does: exit code $?"
grep -q '^| cornell | pbrt-v4 |.*| agrees |' "$work/same.page/peers.md" || fail "its mean is not ours"
[[ -s $work/kept/cornell/pbrt/out.exr && -s $work/kept/cornell/nephroid/scene.pbrt ]] || fail "--keep keeps nothing"
wrong half "cornell: the mean of pbrt-v4 is not ours"
wrong broken "cornell: pbrt-v4 failed"
grep -q "out of colours" "$work/broken.err" || fail "its last words are not passed on"
wrong lazy "cornell: pbrt-v4 failed"
run missing --pbrt "$work/missing" || fail "a renderer that is not there is left out, not an error"
grep -q "pbrt is left out: there is no program" "$work/missing.err" || fail "what is left out is not said"
for option in "--scenes cornel" "--renderers pbrd" "--threads 0" "--seconds -1" "--size 40" "--size 40x40x40"; do
    # shellcheck disable=SC2086
    ! "$peers" $option "$work/none" >/dev/null 2>"$work/none.err" || fail "$option is taken"
    [[ ! -e $work/none ]] || fail "$option leaves a page"
done
{ "$peers" --scenes cornel "$work/none" 2>&1 || true; } | grep -q "cornel: .*there are cornell," || fail "names are not listed"
{ "$peers" --scenes cornell --renderers pbrd "$work/none" 2>&1 || true; } | grep -q -- "--renderers pbrd:" || fail "the folder is taken for a name"
"$peers" --help | grep -q "exit code" || fail "--help does not teach exit codes"
exit "$bad"
