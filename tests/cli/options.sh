#!/usr/bin/env bash
# options.sh PROGRAM: help, and every option with a value that it cannot mean: exit code 2 and a message that names it.
source "$(dirname "$0")/lib.sh"

run 0 --help
prints "render"
prints "Exit codes"
silent err
run 0 --version
prints nephroid
for command in render info merge compare photons; do
    run 0 $command --help
    prints "--help"
done
run 0 render --help
for option in --spp --time --integrator --set --size --crop --color --seed --threads --passes --checkpoint --resume --quiet --log maxdepth \
    --show-photons indirectphotons photonsperiteration lightpath; do
    prints "$option"
done
run 2
run 2 rendre scene.pbrt
says '"rendre" is no command; did you mean "render"?'
run 2 mrege
says '"merge"'
run 2 render
says scene
run 2 render scene.pbrt --bogus
says --bogus

# OPTION VALUE, and what else the message has to say.
bad() {
    local option=$1 value=$2
    run 2 render scene.pbrt "$option" "$value"
    says "$option"
    shift 2
    for word in "$@"; do says "$word"; done
    (($(wc -c <err) < 400)) || fail "a message of $(wc -c <err) bytes for $option $value"
    silent out
}
for value in 0 -1 x 1.5 99999999999; do bad --spp "$value" "whole number from 1 to 2147483647"; done
for value in 5x -1s 0 s nan inf 1e999 1e308h; do bad --time "$value"; done
bad --integrator foo path whitted direct photonmap sppm lightpath
bad --integrator smpp 'did you mean "sppm"'
for value in 10 0x10 -1x4 8x8x8 x8 8x axb; do bad --size "$value"; done
for value in 1,2,3 10,10,5,5 100,100,200,200 0,0,33,24 -1,0,5,5 a; do bad --crop "$value"; done
bad --color blue rgb spectral
for value in x -1 1.5; do bad --seed "$value"; done
for value in 0 2000 x -1; do bad --threads "$value"; done
for value in 5:5 7:5 5 a:b -1:4 1:2:3 :4 0:18446744073709551615 9223372036854775807:9223372036854775809; do bad --passes "$value"; done
for value in 0 -3 x nan; do bad --checkpoint-every "$value"; done
bad --log xml json
for value in x nan inf; do bad --exposure "$value"; done
for value in a.bmp a b.exr.txt; do bad -o "$value" .exr; done
bad --set foo=1 "did you mean"
bad --set maxdeth=1 'did you mean "maxdepth"'
bad --set samplr=sobol 'did you mean "sampler"'
bad --set maxdepth key=value
for value in maxdepth=x maxdepth=-3 maxdepth= segments=0 roulette=maybe alpha=0 alpha=2 alpha=nan samplelights=maybe mis=2 \
    hemisphere=flat sampler=halton xsamples=2 jitter=true filter=none filterradius=0 radius=-1 radius=x iso=0 iso=nan maxcomponentvalue=-1; do
    bad --set "$value" "--set ${value%%=*}"
done
run 2 render scene.pbrt --set sampler=stratified --set xsamples=0
says "--set xsamples"
run 2 render scene.pbrt --integrator direct --set alpha=0.5
says "--set alpha"
# Keys of photons, where they mean something and where they do not.
photon() { # INTEGRATOR KEY=VALUE
    run 2 render scene.pbrt --integrator "$1" --set "$2"
    says "--set ${2%%=*}:"
}
for value in causticphotons=-2 causticphotons=x causticphotons=3000000000 nused=-1 nused=1.5 radius=-1 radius=nan causticradius=-1 kernel=triangle \
    edgecorrection=maybe aim=2 visualize=photons maxphotondepth=-1 alpha=0 alpha=1.5 maxdepth=-1; do
    photon sppm $value
    photon photonmap $value
done
for value in indirectphotons=-1 finalgather=perhaps finalgathersamples=0 passes=0 maxdist=-1 maxspeculardepth=-1 photonsperiteration=5; do
    photon photonmap $value
done
for value in photonsperiteration=-2 indirectphotons=5 finalgather=true passes=2 lightpaths=5; do photon sppm $value; done
for value in lightpaths=0 lightpaths=-2 nused=5 alpha=0.5; do photon lightpath $value; done
for value in nused=5 causticphotons=5 kernel=box passes=2; do photon path $value; done

# A limit, missing files, and places that cannot be written: known before anything is rendered.
run 3 render scene.pbrt --size 100000x100000
run 4 render missing.pbrt
says missing.pbrt
run 4 info missing.pbrt
run 4 merge missing.film.exr -o a.exr
run 4 compare missing.exr missing.exr
run 4 render scene.pbrt --resume missing.film.exr
says missing.film.exr
mkdir folder.exr
before() {
    local option=$1 value=$2
    run 4 render scene.pbrt --spp 1000000 "$option" "$value"
    says "$option"
    ! grep -q rendering err || fail "$option $value was noticed after rendering had begun"
}
for option in -o --checkpoint --stats; do
    before $option nowhere/a.exr
    before $option folder.exr
    before $option /proc/a.exr
done
if ((EUID != 0)); then
    mkdir locked
    chmod a-w locked
    before -o locked/a.exr
fi
run 2 merge scene.pbrt -o a.exr
says scene.pbrt
run 2 merge
run 2 compare scene.pbrt scene.pbrt
run 2 render .
rmdir locked 2>/dev/null
rmdir folder.exr
only scene.pbrt
finish
