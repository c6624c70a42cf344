#!/usr/bin/env bash
# streams.sh PROGRAM: what becomes of the words on stderr never matters; results on stdout that are lost end with exit code 4.
source "$(dirname "$0")/lib.sh"
code() { [[ $1 == "$2" ]] || fail "$3: exit code $1 instead of $2"; }
render=(render scene.pbrt -o a.exr --spp 4)

"$program" "${render[@]}" >out 2>/dev/full
code $? 0 "stderr on a full disk"
exists a.exr
rm a.exr
"$program" "${render[@]}" >out 2>&-
code $? 0 "stderr closed"
[[ $(head -c 4 a.exr | od -An -tx1 | tr -d ' \n') == 762f3101 ]] || fail "words went into the picture"
rm a.exr
"$program" "${render[@]}" --time 1s 2>&1 >out | head -c 1 >/dev/null
code "${PIPESTATUS[0]}" 0 "stderr on a pipe that nobody reads"
exists a.exr
"$program" "${render[@]}" --log json 2>&1 >out | head -c 1 >/dev/null
code "${PIPESTATUS[0]}" 0 "the log on a pipe that nobody reads"

for arguments in "--help" "--version" "info scene.pbrt" "info scene.pbrt --json" "compare a.exr a.exr" \
    "compare a.exr a.exr --json" "render scene.pbrt -o b.exr --quiet"; do
    # shellcheck disable=SC2086
    "$program" $arguments >/dev/full 2>err
    code $? 4 "$arguments, stdout on a full disk"
    says "standard output"
    # shellcheck disable=SC2086
    "$program" $arguments >&- 2>err
    code $? 4 "$arguments, stdout closed"
done
exists b.exr # lost was its name only
run 0 render scene.pbrt -o a.film.exr --quiet
"$program" merge a.film.exr -o c.exr >/dev/full 2>err
code $? 4 "merge, stdout on a full disk"
exists c.exr

# Bytes that are no UTF-8 do not end what is JSON.
cp scene.pbrt $'caf\xe9.pbrt'
run 0 info $'caf\xe9.pbrt' --json
prints '"notes"'
run 0 render $'caf\xe9.pbrt' -o a.exr --log json
rm a.exr b.exr c.exr a.film.exr $'caf\xe9.pbrt'
only scene.pbrt
finish
