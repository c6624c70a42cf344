#!/usr/bin/env bash
# replay.sh PROGRAM: one sample's path on the command line: printed, drawn, and the same as what a render of that pass has there.
source "$(dirname "$0")/lib.sh"
# A lamp over a floor with a glass ball and a mirror on it, closed in by a box.
room >room.pbrt <<'SCENE'
MakeNamedMaterial "wall" "string type" "diffuse" "rgb reflectance" [ 0.6 0.6 0.6 ]
NamedMaterial "wall"
SCENE

# Words: the vertices with their places in the file, and nothing is rendered.
run 0 render room.pbrt --replay 5,20,18 --color rgb
prints "pass 5, pixel 20,18 of 40x30: path, seed 0, rgb"
prints "x0  0 1 -2.9  the camera"
prints "x1 "
prints "sphere, room.pbrt:20; dielectric, room.pbrt:19"
prints 'box, room.pbrt:17; diffuse "wall", room.pbrt:13'
prints "specular transmission"
prints "asks for the light at"
prints "the film adds "
silent err
only room.pbrt scene.pbrt
cp out first
run 0 render room.pbrt --replay 5,20,18 --color rgb --spp 100 --threads 2
same out first
run 0 render room.pbrt --replay 6,20,18 --color rgb
! cmp -s out first || fail "another pass has the same path"
run 0 render room.pbrt --replay 5,20,18 --color spectral
prints " nm"
run 0 render room.pbrt --replay 9223372036854775807,0,0
for integrator in direct whitted; do
    run 0 render room.pbrt --replay 5,20,18 --integrator $integrator
    prints ": $integrator,"
done

# The same as a render of that pass: what the film adds divided by its weight is the picture, in float.
value() { # FILE: the three numbers of "value"
    awk '/^  "value": \[/ { on = 1; next } on && /\]/ { exit } on { gsub(/[ ,]/, ""); print }' "$1"
}
for color in rgb spectral; do
    for integrator in path direct whitted; do
        lit=0
        for pixel in 3,4 20,18 33,25 19,0; do
            x=${pixel%,*} y=${pixel#*,}
            run 0 render room.pbrt --replay 5,$pixel --color $color --integrator $integrator -o p.json
            run 0 render room.pbrt --passes 5:6 --color $color --integrator $integrator --crop "$x,$y,$((x + 1)),$((y + 1))" -o p.pfm
            paste <(tail -c 12 p.pfm | od -An -v -t f4 -w4) <(value p.json) |
                awk '{ n++; d = $1 - $2; if (d * d > 1e-10 * $2 * $2) exit 1; if ($2 > 0) lit = 1 } END { if (n != 3) exit 1; exit lit ? 10 : 0 }'
            case $? in
                10) lit=$((lit + 1)) ;;
                0) ;;
                *) fail "$color $integrator $pixel: the picture has $(tail -c 12 p.pfm | od -An -t f4), the path $(value p.json | xargs)" ;;
            esac
        done
        ((lit > 1)) || fail "$color $integrator: nothing but black paths were compared"
    done
done
rm p.pfm p.json first

# Files: the drawing, programs' form, and pictures, which are rendered and drawn over; films are not.
run 0 render room.pbrt --replay 5,20,18 -o path.svg -o path.json
prints "$PWD/path.svg"
prints "$PWD/path.json"
grep -q "^<svg " path.svg && grep -q "^</svg>" path.svg || fail "path.svg is no drawing"
for word in ">x1<" ">x2<" "from the side" "from above" stroke-dasharray "β "; do grep -qF -- "$word" path.svg || fail "path.svg has no $word"; done
! grep -qi "nan\|inf" path.svg || fail "path.svg has places that are not numbers"
grep -q '"name": "x1"' path.json || fail "path.json has no vertices"
cp path.svg first.svg
run 0 render room.pbrt --replay 5,20,18 -o path.svg
same path.svg first.svg
run 0 render room.pbrt --spp 1 -o plain.png -o plain.film.exr
run 0 render room.pbrt --spp 1 --replay 5,20,18 -o shown.png -o shown.film.exr -o path.svg
prints "$PWD/shown.png"
prints "the film adds"
same path.svg first.svg
same plain.film.exr shown.film.exr
! cmp -s plain.png shown.png || fail "nothing was drawn over the picture"
rm ./*.png ./*.svg ./*.json ./*.exr

# What cannot be meant, and what to do.
bad() { # EXPECTED ARGUMENTS…
    local expected=$1
    shift
    run 2 render room.pbrt "$@"
    says "$expected"
    silent out
}
bad "--replay 5: expected 3 numbers with ',' between them" --replay 5
bad "--replay 5,1: expected 3" --replay 5,1
bad "--replay a,1,1: expected 3" --replay a,1,1
bad "--replay -1,1,1: expected 3" --replay=-1,1,1
bad "passes end at 2^63" --replay 9223372036854775808,1,1
bad "the picture has 40x30 pixels; give pass,x,y with x from 0 to 39 and y from 0 to 29" --replay 0,40,0
bad "x from 0 to 39" --replay 0,0,30
bad "x from 0 to 39" --replay 0,0,99999999999
bad "x from 0 to 9" --replay 0,20,2 --size 10x10
for integrator in photonmap sppm lightpath; do
    bad "what $integrator shows comes from many light paths" --replay 0,1,1 --integrator $integrator
    says "add --integrator path, direct or whitted"
done
bad "leave --checkpoint out" --replay 0,1,1 --checkpoint c.film.exr
bad "leave --passes out" --replay 0,1,1 --passes 0:1
bad "leave the other out" --replay 0,1,1 --show-photons -o a.png
bad "is -o p.svg as well" --replay 0,1,1 -o p.svg -o p.svg
bad 'cannot write ".svg" files; use .exr, .png, .jpg, .pfm, .hdr or .film.exr' -o p.svg
bad 'cannot write ".txt" files; use .exr, .png, .jpg, .pfm, .hdr, .film.exr, .svg or .json' --replay 0,1,1 -o p.txt
run 4 render room.pbrt --replay 0,1,1 -o nowhere/p.svg
run 4 render missing.pbrt --replay 0,1,1
run 0 render --help
prints "--replay"
run 0 --help
prints "--replay 7,120,80"

# A sample that is no number is dropped from the picture (exit code 6); so ends its replay, which shows what added it.
{
    printf 'PF\n2 2\n-1.0\n'
    for _ in {1..12}; do printf '\xe6\xb1\x61\x7f'; done # 3e38
} >sun.pfm
sed 's/"infinite"/"infinite" "string filename" "sun.pfm"/' scene.pbrt >bright.pbrt
run 6 render bright.pbrt --passes 0:1 --crop 1,1,2,2 -o b.exr
run 6 render bright.pbrt --replay 0,1,1
prints "meets the infinite light, bright.pbrt:7: weight 1, adds "
prints "nan"
rm b.exr bright.pbrt sun.pfm
only room.pbrt scene.pbrt
finish
