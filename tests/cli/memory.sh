#!/usr/bin/env bash
# memory.sh PROGRAM: what needs more memory than there is ends with exit code 3 before it begins, and says what to do.
source "$(dirname "$0")/lib.sh"
refused() {
    run 3 "$@"
    says memory
    ! grep -q rendering err || fail "$* was noticed after rendering had begun"
}
refused render scene.pbrt --size 8000x8000 --memory-limit 1G
says "--memory-limit"
says "--crop"
run 0 render scene.pbrt --size 8000x8000 --crop 0,0,9,9 --memory-limit 1G --quiet
if [[ -z ${NEPHROID_SLOW:-} ]]; then # sanitizers want terabytes of addresses
    (
        ulimit -v 4000000
        "$program" render scene.pbrt --size 16000x16000 --crop 0,0,9999,9999 >out 2>err
        echo $? >code
    )
    [[ $(cat code) == 3 ]] || fail "exit code $(cat code) under ulimit -v"
    says "not enough memory"
    rm code
fi
for value in x -1G 0 8X 1e99 G nan; do
    run 2 render scene.pbrt --memory-limit "$value"
    says "--memory-limit $value"
done
for value in 2000000000 2G 2GB 2GiB 2000M 0.5T; do run 0 render scene.pbrt --memory-limit $value --quiet; done

# Instances of instances: 10^8 of them in a few lines.
{
    echo 'WorldBegin'
    echo 'ObjectBegin "o0"' 'Shape "sphere"' 'ObjectEnd'
    for level in 1 2 3 4; do
        echo "ObjectBegin \"o$level\""
        for _ in {1..100}; do echo "ObjectInstance \"o$((level - 1))\""; done
        echo 'ObjectEnd'
    done
    echo 'ObjectInstance "o4"'
} >bomb.pbrt
refused render bomb.pbrt -o a.exr
refused info bomb.pbrt
# Subdivision: four triangles of each, ten times.
{
    echo 'WorldBegin'
    echo 'Shape "loopsubdiv" "integer levels" 10 "point3 P" [ 0 0 0 1 0 0 0 1 0 0 0 1 ]'
    echo '"integer indices" [ 0 2 1  0 1 3  0 3 2  1 2 3 ]'
} >fine.pbrt
refused render fine.pbrt -o a.exr --memory-limit 1G
# How many photons a path leaves is seen when the scene is there: many, between white walls.
{
    echo 'Integrator "photonmap" "integer indirectphotons" 1000000'
    echo 'Film "rgb" "integer xresolution" 16 "integer yresolution" 12' 'Camera "perspective"' 'WorldBegin'
    echo 'LightSource "point"' 'Material "diffuse" "rgb reflectance" [ 0.95 0.95 0.95 ]'
    echo 'Shape "sphere" "float radius" 2'
} >white.pbrt
refused render white.pbrt -o a.exr --memory-limit 1G
run 3 render white.pbrt -o a.exr --memory-limit 900T --set indirectphotons=2000000000
says "more than a map can hold"
rm white.pbrt
run 0 info scene.pbrt
prints "estimate"
run 0 info scene.pbrt --json
prints '"estimated_bytes"'
# Progressive passes leave nothing behind: the most memory of 20 passes and of 400 is the same, to a few MB.
if [[ -z ${NEPHROID_SLOW:-} && -x /usr/bin/time ]]; then
    peak() { # PASSES: in KiB
        /usr/bin/time -f %M -o peak "$program" render scene.pbrt --integrator sppm --set photonsperiteration=2000 --spp "$1" --size 16x12 --threads 1 --quiet -o a.exr >out 2>err || fail "sppm with $1 passes"
        tail -1 peak
    }
    few=$(peak 20) many=$(peak 400)
    echo "peak memory: $few KiB after 20 passes, $many KiB after 400"
    ((many < few + 4096 && few < many + 4096)) || fail "20 passes take $few KiB, 400 take $many KiB"
    rm -f peak a.exr
fi
absent a.exr
rm bomb.pbrt fine.pbrt named.exr
only scene.pbrt
finish
