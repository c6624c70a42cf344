#!/usr/bin/env bash
# outputs.sh PROGRAM: what a render writes and says, and what info and compare say of it.
shared=$(realpath -m "${NEPHROID_SHARED:-$(dirname "$0")/../../../shared}")
source "$(dirname "$0")/lib.sh"

# Every kind of picture; stdout carries their paths and nothing else.
kinds=(a.exr a.png a.jpg a.jpeg a.pfm a.hdr a.film.exr)
args=()
for k in "${kinds[@]}"; do args+=(-o "$k"); done
run 0 render scene.pbrt "${args[@]}"
for k in "${kinds[@]}"; do exists "$k"; done
cmp -s out <(for k in "${kinds[@]}"; do echo "$PWD/$k"; done) || fail "stdout: $(cat out)"
only scene.pbrt "${kinds[@]}"
signature() { [[ $(head -c "$2" "$1" | od -An -tx1 | tr -d ' \n') == "$3" ]] || fail "$1 is no such file"; }
signature a.exr 4 762f3101
signature a.film.exr 4 762f3101
signature a.png 8 89504e470d0a1a0a
signature a.jpg 3 ffd8ff
signature a.pfm 2 5046
signature a.hdr 2 233f
says "approximated or ignored"
says "rays"
rm "${kinds[@]}"

# Without -o the scene's own name, in the folder where the program was started.
run 0 render scene.pbrt
prints "$PWD/named.exr"
only scene.pbrt named.exr
rm named.exr

# A file that was there is replaced whole, through symbolic links too.
echo old >b.png
ln -s b.png link.png
run 0 render scene.pbrt -o link.png --quiet
silent err
[[ -L link.png ]] || fail "the link was replaced"
signature b.png 4 89504e47
rm b.png link.png

# --quiet says nothing; --log json says JSON, line by line, and ends with the statistics.
run 0 render scene.pbrt -o a.exr --quiet
silent err
run 0 render scene.pbrt -o a.exr --quiet --stats stats.json
grep -q '"samples": 1536' stats.json || fail "stats.json: $(cat stats.json)"
rm stats.json
run 0 render scene.pbrt -o a.exr --log json --spp 20
# Objects on a line each: balanced braces outside strings, and keys that are strings.
awk '
    { line = $0; gsub(/\\./, "", line); gsub(/"[^"]*"/, "s", line)
      n = gsub(/\{/, "{", line); m = gsub(/\}/, "}", line)
      if (line !~ /^\{.*\}$/ || n != m) { print "no JSON: " $0; bad = 1 }
      gsub(/s:(s|-?[0-9.]+(e[-+]?[0-9]+)?|true|false|null)/, "p", line)
      while (gsub(/s:\{p?(,p)*\}/, "p", line)) ;
      if (line !~ /^\{p(,p)*\}$/) { print "no JSON: " $0; bad = 1 } }
    END { exit bad || NR == 0 }' err >awk.out || fail "$(cat awk.out)"
rm awk.out
grep -q '"event":"progress"' err || fail "no progress in the log"
tail -1 err | grep -q '"event":"done"' || fail "the log does not end with what was done"
grep -q '"event":"notes","count":1' err || fail "the log does not count the notes"

# Notes with their place.
run 0 info scene.pbrt
prints "scene.pbrt:12"
prints '"height"'
run 0 info scene.pbrt --json
prints '"notes"'
prints "scene.pbrt:12"

# Pictures that are equal, and pictures that are not.
run 0 render scene.pbrt -o b.exr --quiet
run 0 render scene.pbrt -o a.exr --quiet
run 0 compare a.exr b.exr
prints "RMSE            0"
silent err
run 0 compare a.exr b.exr --json
prints '"rmse": 0.0'
run 0 render scene.pbrt -o b.exr --quiet --seed 5
run 0 compare a.exr b.exr
! grep -q "RMSE            0$" out || fail "different pictures compare as equal"
run 0 render scene.pbrt -o c.exr --quiet --size 8x8
run 2 compare a.exr c.exr
says "same size"
# Films compare like the pictures in them, and Welch's test needs no certain spelling.
run 0 render scene.pbrt -o a.film.exr -o a.EXR --quiet --spp 8
run 0 render scene.pbrt -o b.film.exr --quiet --spp 8 --seed 5
for pair in "a.exr b.exr" "a.film.exr b.film.exr" "a.EXR b.film.exr"; do
    # shellcheck disable=SC2086
    run 0 compare $pair
    prints Welch
done
# Parts of a picture that lie elsewhere are not the same part.
run 0 render scene.pbrt -o b.exr --quiet --crop 0,0,8,8
run 0 render scene.pbrt -o c.exr --quiet --crop 8,0,16,8
run 2 compare b.exr c.exr
says "different parts"
run 0 compare b.exr b.exr
# Pixels that are no numbers are counted.
{
    printf 'PF\n2 1\n-1.0\n'
    for _ in 1 2 3; do printf '\0\0\x80\x3f'; done
    for _ in 1 2 3; do printf '\0\0\xc0\x7f'; done
} >nan.pfm
run 0 compare nan.pfm nan.pfm
prints "1 pixel of nan.pfm"
run 0 compare nan.pfm nan.pfm --json
prints '"not_finite_a": 1'
rm a.exr b.exr c.exr a.film.exr b.film.exr a.EXR nan.pfm

# Pictures of luminance and subsampled chroma compare, too. There is none in the repository.
yc=$shared/data/exr-conformance/Chromaticities/Rec709_YC.exr
if [[ -e $yc ]]; then
    run 0 compare "$yc" "$yc"
    prints "RMSE            0"
else
    echo "no luminance-chroma picture in $shared: not looked at"
fi

# Halves end at 65504. What is brighter is written as floats, and that is said.
sed 's/\[ 9 9 9 \]/[ 9e6 9e6 9e6 ]/' scene.pbrt >bright.pbrt
run 0 render bright.pbrt -o a.exr -o a.pfm --quiet
says "65504"
run 0 compare a.exr a.pfm
prints "RMSE            0"
run 0 render bright.pbrt -o a.exr --float --quiet
silent err
rm a.exr a.pfm bright.pbrt

# No lights: black, and said. Samples that overflow: dropped, counted, exit code 6, and the picture is there.
grep -v LightSource scene.pbrt >dark.pbrt
run 0 render dark.pbrt -o d.exr
says "no lights"
run 0 compare d.exr d.exr
prints "against 0"
{
    printf 'PF\n2 2\n-1.0\n'
    for _ in {1..12}; do printf '\xe6\xb1\x61\x7f'; done # 3e38
} >sun.pfm
sed 's/"infinite"/"infinite" "string filename" "sun.pfm"/' scene.pbrt >bright.pbrt
run 6 render bright.pbrt -o e.exr
says DROPPED
exists e.exr
# Also quietly, and in everything that is made of it.
run 6 render bright.pbrt -o e.film.exr --quiet
says "tainted"
run 6 render bright.pbrt --resume e.film.exr -o e.exr --quiet
says "tainted"
run 6 merge e.film.exr -o e.exr
says "tainted"
rm e.film.exr
# Light beyond all floats is refused with its place.
sed 's/"rgb I" \[ 9 9 9 \]/"rgb I" [ 1e38 1e38 1e38 ] "float scale" 1e30/' scene.pbrt >bright.pbrt
run 2 render bright.pbrt -o f.exr
says "bright.pbrt:6"
absent f.exr
rm d.exr e.exr dark.pbrt bright.pbrt sun.pfm
only scene.pbrt
finish
