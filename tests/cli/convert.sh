#!/usr/bin/env bash
# convert.sh PROGRAM SOURCE_DIR: what is written is read as the same scene, and renders to the same bits.
source "$(dirname "$0")/lib.sh"
scenes=$2/scenes

hashes() { grep -E '"(scene|settings)_hash"' out; }
# round_trip SCENE: both hashes are the same.
round_trip() {
    run 0 info "$1" --json
    hashes >before
    run 0 convert "$1" copy.pbrt --quiet
    prints "$PWD/copy.pbrt"
    run 0 info copy.pbrt --json
    hashes >after
    [[ $(wc -l <before) == 2 ]] || fail "$1: info tells no hashes"
    cmp -s before after || fail "$1: the copy is another scene"
}
while IFS= read -r scene; do
    round_trip "$scene"
    run 0 convert "$scene" portable.pbrt --portable
    run 0 info portable.pbrt
    prints "notes       none"
done < <(find "$scenes" -name '*.pbrt' ! -path '*/include/*' | LC_ALL=C sort)
round_trip "$scenes/meshes/cup-lip.ply"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0.3\nf 1 2 3\n' >corner.obj
round_trip corner.obj
# A copy of a copy, and none over itself.
run 0 convert corner.obj first.pbrt
round_trip first.pbrt
run 2 convert copy.pbrt copy.pbrt
says "is the scene copy.pbrt as well, which would be overwritten"

for name in cornell-box cornell-mirror-boxes cornell-spheres; do
    run 0 convert "$scenes/$name.pbrt" $name.pbrt --quiet
    for integrator in path photonmap; do
        run 0 render "$scenes/$name.pbrt" --quiet --integrator $integrator --size 48x48 --spp 3 -o a.film.exr
        run 0 render $name.pbrt --quiet --integrator $integrator --size 48x48 --spp 3 -o b.film.exr
        same a.film.exr b.film.exr
    done
done

# Settings of the command line are written down.
run 0 convert scene.pbrt set.pbrt --integrator sppm --spp 9 --size 20x10 --crop 1,2,11,9 --set radius=0.25 --seed 5 --color rgb
run 0 render set.pbrt --quiet --spp 2 -o a.film.exr
run 0 render scene.pbrt --quiet --integrator sppm --spp 2 --size 20x10 --crop 1,2,11,9 --set radius=0.25 --seed 5 --color rgb -o b.film.exr
same a.film.exr b.film.exr
grep -q '"integer pixelsamples" 9' set.pbrt || fail "--spp is not written"

# Replacements are said with their places.
cat >ours.pbrt <<'SCENE'
Integrator "whitted"
WorldBegin
Material "plastic"
Shape "box"
SCENE
run 0 convert ours.pbrt theirs.pbrt --portable
says 'ours.pbrt:1: "whitted" is replaced by "path"'
says 'ours.pbrt:3: "plastic" is replaced by "coateddiffuse"'
says 'ours.pbrt:4: "box" is replaced by six bilinear patches'

# What is refused leaves nothing behind.
run 2 convert scene.pbrt out.exr
says "choose such a name"
run 4 convert nothing.pbrt out.pbrt
run 4 convert scene.pbrt nowhere/out.pbrt
run 2 convert scene.pbrt out.pbrt --set radius=-1
cp scene.pbrt part.pbrt
echo 'WorldBegin Include "shape.pbrt"' >whole.pbrt
echo 'Shape "sphere"' >shape.pbrt
run 2 convert whole.pbrt shape.pbrt
says "would be overwritten"
[[ $(<shape.pbrt) == 'Shape "sphere"' ]] || fail "a part of the scene was written over"
echo 'WorldBegin Material "dielectric" "float eta" 5000 Shape "sphere"' >broken.pbrt
run 2 convert broken.pbrt out.pbrt
says "broken.pbrt:1: the index of refraction"
absent out.pbrt
absent out_files
run 0 convert --help
prints "--portable"
finish
