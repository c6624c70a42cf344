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
done < <(find "$scenes" \( -name '*.pbrt' -o -name '*.ray' \) ! -path '*/include/*' | LC_ALL=C sort)
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

# More meshes than files may be open at once.
for ((i = 0; i < 80; i++)); do
    {
        printf 'v %d 0 0\nv 0 1 0\nv 0 0 1\n' $((i + 1))
        yes 'f 1 2 3' | head -201
    } >many-$i.obj
    echo "Shape \"plymesh\" \"string filename\" \"many-$i.obj\""
done >shapes.pbrt
echo 'WorldBegin Include "shapes.pbrt"' >many.pbrt
(
    ulimit -n 64
    failures=0
    run 0 convert many.pbrt many-copy.pbrt
    exit $failures
) || failures=$((failures + 1))
(($(find many-copy_files -name '*.ply' | wc -l) == 80)) || fail "not all meshes were written"
rm -f many-*.obj

# Through a link to a folder, ".." leads to where that folder lies; both folders have the picture, and they differ.
mkdir -p away/deep near
ln -s ../away/deep near/link
for folder in away near; do
    byte='>' && [[ $folder == near ]] && byte='='
    { printf 'PF\n2 1\n-1\n' && head -c 24 /dev/zero | tr '\0' $byte; } >$folder/p.pfm
done
cat >near/scene.pbrt <<'SCENE'
WorldBegin
LightSource "infinite" "string filename" "link/../p.pfm" "string mapping" "latlong"
LightSource "infinite" "string filename" "p.pfm" "string mapping" "latlong"
SCENE
run 0 info near/scene.pbrt --json
hashes >before
grep -q '"image_files": 2' out || fail "the picture behind the link is the one before it"
run 0 convert near/scene.pbrt near/link/../copy.pbrt
exists "$(<out)"
exists away/copy.pbrt
run 0 info near/link/../copy.pbrt --json
hashes >after
same before after

# What render refuses is refused: a picture that is not there.
echo 'WorldBegin LightSource "infinite" "string filename" "none.exr"' >lost.pbrt
run 4 info lost.pbrt
mv err refused
run 4 convert lost.pbrt lost-copy.pbrt
same err refused
absent lost-copy.pbrt

# A mesh without a face is left out, with its place.
printf 'SBT-raytracer 1.1\nsphere {}\ncone { height = 0 bottom_radius = 0 }\n' >flat.ray
round_trip flat.ray
run 0 convert flat.ray copy.pbrt
says 'flat.ray:3: a mesh without a face is left out'

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

cat >pane.ray <<'SCENE'
SBT-raytracer 1.1
square { material = { transmissive = (0.9, 0.5, 0.5); index = 1 } }
SCENE
run 0 convert pane.ray theirs.pbrt --portable --seed 5000000000
says 'pane.ray: colours are spectra'
says 'pane.ray: the seed is cut'
says 'pane.ray:2: "metallicroughness" is replaced by glass without its colour'

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
