#!/usr/bin/env bash
# signals.sh PROGRAM: the first SIGINT or SIGTERM writes what there is and ends with exit code 5 within 2 s, resumable to the
# same bits; the second one ends at once; a time limit ends with a picture.
source "$(dirname "$0")/lib.sh"
endless=(render scene.pbrt --size 320x240 --spp 1000000)
limit=2000
[[ -z ${NEPHROID_SLOW:-} ]] || limit=20000 # sanitizers

now() { echo $((${EPOCHREALTIME/./} / 1000)); }
# Bash starts background jobs with SIGINT ignored; `env` puts it back.
start() {
    : >err
    env --default-signal=INT,TERM "$program" "$@" >out 2>err </dev/null &
    pid=$!
    # Rendering has begun when there is a word of progress.
    for _ in {1..200}; do
        grep -q '"progress"\|rendering' err && break
        sleep 0.05
    done
    sleep 0.4
}
for signal in INT TERM; do
    start "${endless[@]}" -o s.exr -o s.film.exr --checkpoint c.film.exr
    t=$(now)
    kill -$signal $pid
    wait $pid
    code=$?
    took=$(($(now) - t))
    [[ $code == 5 ]] || fail "SIG$signal: exit code $code"
    ((took < limit)) || fail "SIG$signal: took $took ms"
    exists s.exr
    exists s.film.exr
    exists c.film.exr
    says interrupted
    says "--resume c.film.exr"
    passes=$(sed -n 's/.*interrupted after \([0-9]*\) passes.*/\1/p' err)
    [[ $passes =~ ^[0-9]+$ ]] || fail "no number of passes"
    # It goes on to the same bits.
    more=$((passes + 3))
    run 0 render scene.pbrt --size 320x240 --spp $more --resume c.film.exr -o resumed.film.exr --quiet
    run 0 render scene.pbrt --size 320x240 --spp $more -o whole.film.exr --quiet
    same resumed.film.exr whole.film.exr
    rm -f ./*.exr c.film.exr*
done
only scene.pbrt

# A second signal does not wait: here while the output is a pipe that nobody reads. Two at once do as well.
start "${endless[@]}" -o s.exr
t=$(now)
kill -INT $pid
kill -INT $pid
wait $pid
code=$?
took=$(($(now) - t))
[[ $code == 5 ]] || fail "two signals: exit code $code"
((took < limit)) || fail "two signals: took $took ms"
rm -f s.exr .s.exr* s.exr*

# A time limit is an end like any other.
t=$(now)
run 0 render scene.pbrt --time 0.5s -o t.exr --quiet
took=$(($(now) - t))
((took >= 500 && took < 2500 + limit)) || fail "--time 0.5s took $took ms"
exists t.exr
rm t.exr
only scene.pbrt
finish
