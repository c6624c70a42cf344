#!/usr/bin/env bash
# files.sh PROGRAM: nothing is overwritten that someone may want, nothing is lost that could be written, and what cannot be
# written is known before anything is rendered.
source "$(dirname "$0")/lib.sh"
render() { run 0 render scene.pbrt --quiet "$@"; }
endless=(render scene.pbrt --spp 1000000)

# The same file twice, whatever it is called.
mkdir folder
ln -s a.exr link.exr
cp scene.pbrt before.pbrt
twice() {
    run 2 "${endless[@]}" "$@"
    says "choose another name"
    ! grep -q rendering err || fail "$* was noticed after rendering had begun"
}
twice -o a.exr -o a.exr
twice -o a.exr -o folder/../a.exr
twice -o a.exr -o "$PWD/a.exr"
twice -o a.exr -o link.exr
twice -o a.exr --checkpoint a.exr
twice -o a.film.exr --checkpoint a.film.exr
twice -o b.png --stats b.png
twice --checkpoint c.film.exr --stats c.film.exr.previous
twice --stats scene.pbrt
twice --checkpoint scene.pbrt
same scene.pbrt before.pbrt
cp scene.pbrt including.pbrt
echo 'Include "more.pbrt"' >>including.pbrt
echo '# nothing' >more.pbrt
run 2 render including.pbrt --stats more.pbrt
says more.pbrt
render -o a.film.exr
run 2 merge a.film.exr -o a.film.exr -o a.film.exr
cp a.film.exr film.exr
run 2 merge film.exr -o film.exr
same a.film.exr film.exr
rm film.exr more.pbrt including.pbrt before.pbrt link.exr

# A checkpoint that is there is not overwritten, unless this render goes on from all of it: whoever forgets --resume loses nothing.
render --spp 4 --checkpoint c.film.exr -o a.exr
cp c.film.exr kept
guarded() {
    run 2 render "$@" --checkpoint c.film.exr -o b.exr
    says "--checkpoint c.film.exr"
    same c.film.exr kept
    absent b.exr
}
guarded scene.pbrt --spp 3
says "--resume c.film.exr"
guarded scene.pbrt --spp 8
guarded scene.pbrt --passes 2:9
guarded scene.pbrt --time 1s
guarded scene.pbrt --spp 8 --seed 1
says "--seed is 0 in one and 1 in the other"
guarded scene.pbrt --spp 8 --size 16x12
says "--size"
echo precious >c.film.exr
cp c.film.exr kept
guarded scene.pbrt --spp 8
says "delete it"
rm c.film.exr kept
# Its other generation alone is somebody's work, too.
render --spp 4 -o c.film.exr.film.exr
mv c.film.exr.film.exr c.film.exr.previous
run 2 render scene.pbrt --spp 2 --checkpoint c.film.exr -o b.exr
says "c.film.exr.previous"
render --spp 5 --resume c.film.exr.previous --checkpoint c.film.exr -o b.exr
render --spp 6 --resume c.film.exr --checkpoint c.film.exr -o b.exr
rm c.film.exr*

# Places that cannot be written.
mkfifo pipe.exr
before() {
    local code=$1 option=$2 value=$3
    run "$code" "${endless[@]}" "$option" "$value"
    says "$option"
    ! grep -q rendering err || fail "$option $value was noticed after rendering had begun"
}
for option in -o --checkpoint --stats; do before 4 $option pipe.exr; done
long=$(printf 'x%.0s' {1..240}).film.exr
before 4 --checkpoint "$long" # .previous does not fit
before 4 -o "$(printf 'x%.0s' {1..256}).exr"
run 0 render scene.pbrt --quiet -o "$long"
rm "$long" pipe.exr
run 3 render scene.pbrt --size 65501x1 -o wide.jpg
says 65500
run 3 render scene.pbrt --size 65537x1 -o wide.exr
says 65536
run 4 merge a.film.exr -o nowhere/a.exr
run 2 merge a.film.exr -o a.bmp
ln -s folder/real.exr dangling.exr
render -o dangling.exr
exists folder/real.exr
[[ -L dangling.exr ]] || fail "the link was replaced"
rm folder/real.exr dangling.exr
# The scene's own name is relative to where the program was started, folder and all.
sed 's/named.exr/folder\/named.exr/' scene.pbrt >inside.pbrt
run 0 render inside.pbrt --quiet
prints "$PWD/folder/named.exr"
exists folder/named.exr
rm folder/named.exr inside.pbrt

# A disk that is full for large files: what fits is written, each failure is said, and the exit code is 4.
(
    ulimit -f 8
    "$program" render scene.pbrt -o full.film.exr -o full.png --checkpoint full2.film.exr --checkpoint-every 0.001 \
        --spp 200 --quiet >out 2>err
    echo $? >code
)
[[ $(cat code) == 4 ]] || fail "exit code $(cat code) on a full disk"
exists full.png
prints full.png
absent full.film.exr
absent full2.film.exr
[[ $(grep -c "full.film.exr: cannot write" err) == 1 ]] || fail "the film's failure is not said once"
says "full2.film.exr.next: cannot write"
says "going on without a checkpoint"
(($(wc -l <err) <= 3)) || fail "more than a line for each failure"
rm full.png code
# A failed checkpoint does not cost the passes after it.
mkdir gone
"$program" render scene.pbrt --size 200x150 --time 5s -o g.film.exr --checkpoint gone/c.film.exr --checkpoint-every 0.05 \
    >out 2>err &
pid=$!
await gone/c.film.exr
until rm -rf gone 2>/dev/null; do :; done # a checkpoint may be written meanwhile
wait $pid
code=$?
[[ $code == 4 ]] || fail "exit code $code without a folder for the checkpoint"
exists g.film.exr
rm g.film.exr

# Killed while it writes: the next render of the same name uses up what was left.
for _ in {1..12}; do
    "$program" render scene.pbrt --size 400x300 --spp 1000 -o k.exr --checkpoint k.film.exr --checkpoint-every 0.001 \
        >out 2>err &
    pid=$!
    sleep 0.2$((RANDOM % 10))
    kill -KILL $pid
    wait $pid 2>/dev/null
    # Whenever that was, the checkpoint is whole.
    [[ ! -e k.film.exr ]] || run 0 merge k.film.exr -o m.png
    rm -f k.film.exr*
done
(($(find . -name '.nephroid*' | wc -l) <= 3)) || fail "litter: $(ls -A)"
run 0 render scene.pbrt --size 40x30 --quiet -o k.exr --checkpoint k.film.exr
run 0 render scene.pbrt --size 40x30 --quiet -o k.exr --resume k.film.exr --checkpoint k.film.exr --spp 3
[[ -z $(find . -name '.nephroid*') ]] || fail "litter: $(ls -A)"
rm k.* k.film.exr.previous m.png a.exr b.exr a.film.exr 2>/dev/null
rmdir folder
only scene.pbrt
finish
