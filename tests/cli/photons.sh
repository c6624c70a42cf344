#!/usr/bin/env bash
# photons.sh PROGRAM PLY_ROWS: photons on the command line: colours, words, statistics, warnings, memory, and the files that show them.
ply_rows=$(realpath "$2")
source "$(dirname "$0")/lib.sh"
# A lamp over a floor with a glass ball on it, closed in by a box.
room >room.pbrt <<'SCENE'
AttributeBegin
AreaLightSource "diffuse" "rgb L" [ 1 2 3 ]
Translate -2 0.5 0
Shape "sphere" "float radius" 0.1
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.6 0.6 0.6 ]
SCENE
run 0 info room.pbrt
prints "notes       none"
json() { # FILE PATH: a number of a JSON file, by its keys
    awk -v want="$2" '{
        match($0, /^ */); depth = RLENGTH / 2; line = substr($0, RLENGTH + 1)
        if (line ~ /^"/) { key = line; sub(/^"/, "", key); sub(/".*/, "", key); stack[depth] = key; items[depth + 1] = 0 }
        else if (line ~ /^[{]/) stack[depth] = items[depth]++
        if (line ~ /^"[^"]*": [^{[]/) {
            path = stack[1]; for (i = 2; i <= depth; ++i) path = path "." stack[i]
            if (path == want) { sub(/^[^:]*: /, "", line); sub(/,$/, "", line); print line; found = 1 }
        }
    } END { exit !found }' "$1"
}
is() { [[ $1 == "$2" ]] || fail "$3: $1 instead of $2"; }
above() { (($1 > $2)) || fail "$3: $1, which is not above $2"; }

# Colours: photonmap's are rgb, and others' what the file says, unless they are chosen.
color() { # EXPECTED ARGUMENTS…
    local expected=$1
    shift
    run 0 render room.pbrt --spp 1 --size 8x6 --quiet -o c.film.exr "$@"
    grep -qa "$expected" <(strings -n 3 c.film.exr) || fail "$* is not in $expected"
}
color rgb --integrator photonmap --set indirectphotons=100
color spectral --integrator photonmap --set indirectphotons=100 --color spectral
color spectral --integrator sppm
color rgb --integrator sppm --color rgb
sed 's/^WorldBegin/Option "color" "spectral"\nWorldBegin/' room.pbrt >chosen.pbrt
run 0 render chosen.pbrt --spp 1 --size 8x6 --quiet -o c.film.exr --integrator photonmap --set indirectphotons=100
grep -qa spectral <(strings -n 3 c.film.exr) || fail 'an Option "color" was not heard'
rm chosen.pbrt c.film.exr

# Few spectral passes are spoken of, enough of them are not, nor are those that will be merged.
run 0 render room.pbrt --integrator sppm --spp 15 -o a.exr
says "warning: sppm in spectral colours has four wavelengths a pass, and 15 passes tint the picture"
for quiet in "--spp 16" "--spp 2 --color rgb" "--spp 2 --quiet" "--spp 2 -o b.film.exr"; do
    read -ra words <<<"$quiet"
    [[ $quiet == *-o* ]] || words+=(-o a.exr)
    run 0 render room.pbrt --integrator sppm "${words[@]}"
    ! grep -q "four wavelengths" err || fail "a warning with $quiet"
done
rm b.film.exr

# Samples of a pixel are shared out among the passes of photonmap; films of the same passes are of the same render.
run 0 render room.pbrt --integrator photonmap --set passes=2 --spp 6 --set indirectphotons=2000 --stats s.json -o a.exr -o a.film.exr
is "$(json s.json passes)" 2 passes
is "$(json s.json samples)" $((40 * 30 * 6)) samples
grep -qaz "samplesPerPixel" a.exr || fail "no samplesPerPixel"
run 0 render room.pbrt --integrator photonmap --set passes=4 --spp 12 --set indirectphotons=2000 --passes 2:4 -o b.film.exr
run 0 merge a.film.exr b.film.exr -o ab.film.exr -o ab.pfm
run 0 render room.pbrt --integrator photonmap --set passes=4 --spp 12 --set indirectphotons=2000 -o all.pfm
same ab.pfm all.pfm
run 2 merge a.film.exr ab.film.exr -o c.exr
run 0 render room.pbrt --integrator photonmap --set passes=2 --spp 6 --set indirectphotons=2001 -o c.film.exr
run 2 merge b.film.exr c.film.exr -o c.exr
says "--set indirectphotons is 2000 in one and 2001 in the other"
rm ./*.exr ./*.pfm

# Statistics: what was emitted is what was asked for, in each pass, and the lights add up.
run 0 render room.pbrt --integrator sppm --set photonsperiteration=1000 --set causticphotons=500 --spp 3 --color rgb --stats s.json -o a.exr
says "photons global"
is "$(json s.json photons.global.emitted)" 3000 "global paths"
is "$(json s.json photons.caustic.emitted)" 1500 "caustic paths"
above "$(json s.json photons.global.stored)" 1000 "photons stored"
above "$(json s.json photons.caustic.stored)" 0 "caustic photons stored"
above "$(json s.json photons.bytes)" 10000 "bytes of the maps"
for key in emitted stored; do
    one=$(json s.json photons.lights.0.global.$key) other=$(json s.json photons.lights.1.global.$key)
    is $((one + other)) "$(json s.json photons.global.$key)" "$key by light"
done
for key in shooting building; do json s.json photons.seconds.$key >/dev/null || fail "no seconds of $key"; done
run 0 render room.pbrt --integrator sppm --spp 1 --log json -o a.exr
tail -1 err >done.json
grep -q '"event":"done".*"photons":{.*"stored":[1-9]' done.json || fail "no photons in the log"
run 0 render room.pbrt --integrator path --spp 1 --stats s.json -o a.exr
! grep -q photons s.json || fail "the path tracer shot photons"
run 0 info room.pbrt --json
! grep -q '"photons": {' out || fail "info tells of photons of the path tracer"
sed 's/Integrator "path"/Integrator "sppm"/' room.pbrt >sppm.pbrt
run 0 info sppm.pbrt
prints "photonsperiteration automatic"
prints "for photons"
rm s.json done.json

# Nothing stored: the picture is there, and what is missing is said.
warned() {
    run 0 render "$@" -o a.exr --spp 16 --size 8x6
    says "warning: no photon was stored"
}
warned room.pbrt --integrator photonmap --set indirectphotons=0 --set causticphotons=0
{
    sed '/^WorldBegin/q' room.pbrt
    echo 'LightSource "point" "point3 from" [ 0 2 0 ]' 'Material "dielectric"' 'Shape "sphere" "float radius" 0.5'
} >glass.pbrt
warned glass.pbrt --integrator sppm
grep -v Light room.pbrt >dark.pbrt
run 0 render dark.pbrt --integrator sppm -o a.exr --spp 16 --size 8x6
says "warning: the scene has no lights; the picture will be black"
! grep -q "no photon was stored" err || fail "two warnings for one thing"
run 0 photons dark.pbrt -o p.ply
says "there are no photons: the scene has no lights"
grep -qa "element vertex 0$" p.ply || fail "photons in the dark"

# Too many for the memory that there is, before anything is rendered.
for paths in "--integrator sppm --set photonsperiteration=2147483647" "--integrator photonmap --set causticphotons=2147483647"; do
    read -ra words <<<"$paths"
    run 3 render room.pbrt "${words[@]}" -o a.exr --memory-limit 100G
    says "for photons"
    says "fewer photons a pass"
    ! grep -q rendering err || fail "$paths was noticed after rendering had begun"
done
run 3 photons room.pbrt -o p.ply --count 2147483647 --memory-limit 100G
run 3 photons room.pbrt -o p.ply --count 10000000 --memory-limit 3G
rm glass.pbrt dark.pbrt sppm.pbrt

# Photons as points.
run 0 photons room.pbrt -o p.ply --count 3000
prints "$PWD/p.ply"
says "global map: 3000 paths"
rows() { # FILE ELEMENT AWK: a program over the rows, whose names are variables' places: $(c["x"])
    "$ply_rows" "$1" "$2" >rows || fail "$1 is no PLY file of the size that its header says"
    awk 'function bad(why) { print FNR ": " why ": " $0; wrong = 1; exit }
         function near(a, b) { return (a - b) ^ 2 < 1e-6 }
         NR == 1 { for (i = 1; i <= NF; ++i) c[$i] = i; next }'"$3" rows >out || fail "$1: $(tail -3 out)"
    rm rows
}
# In a room of -3 … 3 (y from -0.5), or on the lamps' own surfaces. Light that arrives first has the power that the lamps send,
# pi L A (rgb red: 9 and 1), but for what falls on the ball.
rows p.ply vertex '
    { x = $(c["x"]); y = $(c["y"]); z = $(c["z"])
      nx = $(c["nx"]); ny = $(c["ny"]); nz = $(c["nz"]); dx = $(c["dx"]); dy = $(c["dy"]); dz = $(c["dz"])
      red = $(c["power_r"]); blue = $(c["power_b"]); map = $(c["map"]); light = $(c["light"]) }
    !near(nx^2 + ny^2 + nz^2, 1) || !near(dx^2 + dy^2 + dz^2, 1) { bad("no unit vector") }
    nx * dx + ny * dy + nz * dz < -1e-6 { bad("the normal is not on the side where the light came from") }
    (map != 0 && map != 1) || light < 0 || light > 1 || $(c["bounce"]) > 16 { bad("out of range") }
    map == 1 && $(c["bounce"]) < 1 { bad("a caustic photon that nothing threw") }
    !near(x^2, 9) && !near(z^2, 9) && !near(y, 3) && !near(y, -0.5) && !near(y, 2.9) && !near((x + 2)^2 + (y - 0.5)^2 + z^2, 0.01) { bad("a photon in the air") }
    red < 0 || $(c["power_g"]) < 0 || blue < 0 { bad("negative") }
    (red > blue) != ($(c["red"]) > $(c["blue"])) { bad("another hue") }
    { ++maps[map]; warm[light] += red > blue; ++lights[light] }
    map == 0 && $(c["bounce"]) == 0 { direct += red }
    END {
        if (wrong) exit 1
        sent = 3.14159265 * (9 * 3.14159265 * 0.25 + 4 * 3.14159265 * 0.01)
        print maps[0], maps[1], lights[0], lights[1], warm[0], warm[1], direct, sent
        exit !(maps[0] > 3000 && maps[1] > 50 && lights[0] > 50 && lights[1] > 50 &&
            (warm[0] == lights[0] && warm[1] == 0 || warm[1] == lights[1] && warm[0] == 0) &&
            direct > 0.85 * sent && direct < 1.001 * sent)
    }'
cp p.ply first.ply
run 0 photons room.pbrt -o p.ply --count 3000 --quiet
silent err
same p.ply first.ply
for other in "--pass 1" "--seed 2" "--map global" "--map caustic" "--integrator sppm --set causticphotons=10" "--color spectral"; do
    read -ra words <<<"$other"
    run 0 photons room.pbrt -o other.ply --count 3000 "${words[@]}"
    ! cmp -s other.ply first.ply || fail "$other changes nothing"
done
# Paths as edges: segments of the photons' paths, each from the lamp on.
run 0 photons room.pbrt -o l.ply --count 3000 --paths 50
run 0 photons room.pbrt -o q.ply -o m.ply --count 3000 --paths 50
same q.ply first.ply
same l.ply m.ply
rows l.ply edge '
    { a = $(c["vertex1"]); b = $(c["vertex2"]); color = $(c["red"]) " " $(c["green"]) " " $(c["blue"]) }
    b != a + 1 { bad("an edge between vertices that are not neighbours") }
    (color == "255 255 255") == (a in ends) { bad("the first segments are white, and no others") }
    { ends[b]; colors[color] }
    END { for (k in colors) ++n; print n " colours"; exit wrong || n != 3 }'
edges=$(grep -a "^element edge" l.ply) vertices=$(grep -a "^element vertex" l.ply)
is $((${vertices##* } - ${edges##* })) 100 "paths, of both maps"
# What cannot be meant.
run 2 photons room.pbrt
run 2 photons room.pbrt -o p.obj
says "-o p.obj"
run 2 photons room.pbrt -o p.ply -o q.ply
says "-o q.ply"
run 2 photons room.pbrt -o p.ply --map all
run 2 photons room.pbrt -o p.ply --count -1
says "--count"
run 2 photons room.pbrt -o p.ply --paths x
run 2 photons room.pbrt -o p.ply --pass -1
run 2 photons room.pbrt -o p.ply --integrator path
says "choose photonmap or sppm"
run 2 photons room.pbrt -o p.ply --set alpha=7
run 4 photons missing.pbrt -o p.ply
run 4 photons room.pbrt -o nowhere/p.ply
cp room.pbrt room.ply
run 2 photons room.ply -o room.ply
same room.pbrt room.ply
rm ./*.ply

# Drawn over pictures, whatever the integrator; never into films.
run 0 render room.pbrt -o plain.png -o plain.exr -o plain.film.exr --spp 1
run 0 render room.pbrt -o shown.png -o shown.exr -o shown.film.exr --spp 1 --show-photons=300
same plain.film.exr shown.film.exr
for file in png exr; do ! cmp -s plain.$file shown.$file || fail "nothing was drawn into shown.$file"; done
draws() { # more or fewer pixels than the picture before, by the error of what was drawn
    run 0 render room.pbrt -o shown.png --spp 1 "$@"
    "$program" compare shown.png plain.png --json >c.json 2>err || fail "compare"
    json c.json rmse
}
larger() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }' || fail "$3: $1 is not above $2"; }
few=$(draws --show-photons=50 --show-paths 0 --show-normals 0)
many=$(draws --show-photons=2000 --show-paths 0 --show-normals 0)
hidden=$(draws --show-photons=2000 --show-paths 0 --show-normals 0 --show-hidden)
larger "$few" 0 "few photons"
larger "$many" "$few" "many photons"
larger "$hidden" 0 "hidden photons"
[[ $hidden != "$many" ]] || fail "nothing is hidden behind the ball"
larger "$(draws --show-paths 30)" 0 paths
larger "$(draws --show-normals 30)" 0 normals
is "$(draws --show-paths 0)" 0.0 "no paths"
run 2 render room.pbrt --show-photons=x
run 2 render room.pbrt --show-photons=-5
run 2 render room.pbrt --show-paths -1
run 2 render room.pbrt --show-map everything
rm ./*.png ./*.exr c.json
only room.pbrt scene.pbrt
finish
