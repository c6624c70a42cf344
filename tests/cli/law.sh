#!/usr/bin/env bash
# law.sh PROGRAM: passes rendered apart and merged, resumed, or on other threads are the render in one go, to the bit.
source "$(dirname "$0")/lib.sh"
render() { run 0 render scene.pbrt --quiet "$@"; }
develop() { run 0 merge "$1" -o "$2" --float; }

render --passes 0:8 -o whole.film.exr -o whole.pfm
develop whole.film.exr whole.exr
# Four threads, one thread: the same files.
render --passes 0:8 --threads 1 -o one.film.exr -o one.pfm
render --passes 0:8 --threads 5 -o five.film.exr -o five.pfm
same whole.film.exr one.film.exr
same whole.film.exr five.film.exr
same whole.pfm one.pfm
same whole.pfm five.pfm

# Halves, merged in either order.
render --passes 0:4 -o a.film.exr
render --passes 4:8 -o b.film.exr
run 0 merge a.film.exr b.film.exr -o ab.exr -o ab.film.exr --float
prints "$PWD/ab.exr"
says "passes 0:8"
run 0 merge b.film.exr a.film.exr -o ba.exr --float
same whole.exr ab.exr
same whole.exr ba.exr
run 0 compare whole.exr ab.exr
prints "RMSE            0"

# Gone on with, from a film or a checkpoint: even the sums are the same.
render --passes 0:8 --resume a.film.exr -o resumed.film.exr
same whole.film.exr resumed.film.exr
render --spp 3 --checkpoint c.film.exr -o three.exr
exists c.film.exr
render --spp 8 --resume c.film.exr --checkpoint c.film.exr -o resumed2.film.exr
same whole.film.exr resumed2.film.exr
# Nothing left to do is good, too.
render --spp 8 --resume c.film.exr -o resumed3.film.exr
same whole.film.exr resumed3.film.exr
# The newest generation damaged: refused, and the one before it is offered by name. It survives being gone on from.
render --spp 4 --resume c.film.exr --checkpoint c.film.exr -o four.pfm
render --spp 5 --resume c.film.exr --checkpoint c.film.exr -o five.pfm
printf garbage >c.film.exr
run 2 render scene.pbrt --quiet --spp 8 --resume c.film.exr -o bad.exr
says "--resume c.film.exr.previous"
absent bad.exr
cp c.film.exr.previous before.film.exr
render --spp 8 --resume c.film.exr.previous --checkpoint c.film.exr -o resumed4.film.exr
same whole.film.exr resumed4.film.exr
same before.film.exr c.film.exr.previous
render --spp 8 --resume c.film.exr -o resumed5.film.exr
same whole.film.exr resumed5.film.exr

# What does not belong together is refused, and nothing is written.
run 2 merge a.film.exr a.film.exr -o bad.exr
says a.film.exr
sed 's/radius" 1/radius" 1.1/' scene.pbrt >other.pbrt
run 0 render other.pbrt --quiet --passes 4:8 -o other.film.exr
run 2 merge a.film.exr other.film.exr -o bad.exr
says other.film.exr
run 2 render scene.pbrt --quiet --resume other.film.exr -o bad.exr
says --resume
render --passes 4:8 --seed 1 -o seed.film.exr
run 2 merge a.film.exr seed.film.exr -o bad.exr
says "--seed is 0 in one and 1 in the other"
render --passes 4:8 --set maxdepth=1 -o depth.film.exr
run 2 merge a.film.exr depth.film.exr -o bad.exr
says "--set maxdepth is 5 in one and 1 in the other"
for different in "--size 16x12" "--color rgb" --aovs; do
    render --passes 4:8 $different -o other2.film.exr
    run 2 merge a.film.exr other2.film.exr -o bad.exr
    says "${different%% *} is"
    run 2 render scene.pbrt --quiet --resume other2.film.exr -o bad.exr
    says "--resume other2.film.exr"
    says "${different%% *} is"
done
run 2 merge a.film.exr whole.exr -o bad.exr
says whole.exr
head -c 2000 b.film.exr >short.film.exr
run 2 merge a.film.exr short.film.exr -o bad.exr
says short.film.exr
run 4 merge a.film.exr b.film.exr -o nowhere/bad.exr
absent bad.exr

# A crop window holds the same pixels as the whole picture: rows 6 to 17, columns 8 to 27, of 3 floats each; PFM files
# begin at the bottom.
render --passes 0:3 -o all.pfm
render --passes 0:3 --crop 8,6,28,18 -o crop.pfm
tail -c $((32 * 24 * 12)) all.pfm >all.raw
tail -c $((20 * 12 * 12)) crop.pfm >crop.raw
for row in {17..6}; do
    tail -c +$((((23 - row) * 32 + 8) * 12 + 1)) all.raw | head -c $((20 * 12))
done >cut.raw
same crop.raw cut.raw
# Its film goes with films of the same window only, and the refusal says so.
render --passes 3:5 --crop 8,6,28,18 -o crop.film.exr
run 2 merge a.film.exr crop.film.exr -o bad.exr
says "--crop"

# A lone pass is the same in a long render.
render --passes 3:4 -o p.pfm
render --passes 3:4 --spp 100000 -o q.pfm
same p.pfm q.pfm
for integrator in path direct whitted; do
    render --passes 0:2 --integrator $integrator -o t.film.exr
    render --passes 0:2 --integrator $integrator --threads 7 -o u.film.exr
    same t.film.exr u.film.exr
done
finish
