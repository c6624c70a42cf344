#!/usr/bin/env bash
# signals.sh PROGRAM: the first SIGINT, SIGTERM or SIGHUP writes what there is and ends with exit code 5 within 2 s, resumable to the
# same bits; the second one ends at once; a time limit ends with a picture.
source "$(dirname "$0")/lib.sh"
endless=(render scene.pbrt --size 320x240 --spp 1000000)
limit=20000 # ms; for what hangs
processor_limit=2000
[[ -z ${NEPHROID_SLOW:-} ]] || processor_limit=20000 # sanitizers

now() { echo $((${EPOCHREALTIME/./} / 1000)); }
# Bash starts background jobs with SIGINT ignored; `env` puts it back.
start() {
    : >err
    env --default-signal=INT,TERM,HUP "$program" "$@" >out 2>err </dev/null &
    pid=$!
    # Rendering has begun when there is a word of progress.
    for _ in {1..200}; do
        grep -q '"progress"\|rendering' err && break
        sleep 0.05
    done
    sleep "${settle:-0.4}"
}
for signal in INT TERM HUP; do
    # The first checkpoint says that there is a pass to write.
    settle=0 start "${endless[@]}" -o s.exr -o s.film.exr --checkpoint c.film.exr --checkpoint-every 0.01
    await c.film.exr
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

# With a checkpoint at 1920x1080, too; from a film, so that there is a pass however slow the machine is. The two seconds are
# those of a machine that has nothing else to do: what counts here is the processor's time after the signal.
children() { # sets ended_ms, of those that ended: the second line of `times` (not in a subshell) is "0m1.234s 0m0.123s"
    times >times.out
    ended_ms=$(awk 'NR == 2 { split($1, u, /[ms]/); split($2, s, /[ms]/); print int(1000 * (60 * (u[1] + s[1]) + u[2] + s[2])) }' times.out)
}
running() { awk '{ print 10 * ($14 + $15) }' "/proc/$pid/stat"; } # ms; ticks are 1/100 s
run 0 render scene.pbrt --size 1920x1080 --passes 0:1 -o f.film.exr --quiet
start render scene.pbrt --size 1920x1080 --spp 1000000 -o s.exr --resume f.film.exr --checkpoint c.film.exr
children
before=$((ended_ms + $(running)))
kill -INT $pid
wait $pid
code=$?
children
took=$((ended_ms - before))
[[ $code == 5 ]] || fail "1920x1080: exit code $code"
((took < processor_limit)) || fail "1920x1080: took $took ms of the processor"
((took > 0)) || fail "1920x1080: took $took ms, which cannot be"
exists s.exr
exists c.film.exr
echo "1920x1080: took $took ms of the processor"
rm -f s.exr f.film.exr c.film.exr* times.out

# Before the first pass is done there is nothing to write, and what was there stays.
echo old >s.exr
settle=0 start render scene.pbrt --size 1600x1200 --spp 1000000 -o s.exr --checkpoint c.film.exr
kill -INT $pid
wait $pid
code=$?
[[ $code == 5 ]] || fail "no pass: exit code $code"
says "nothing was written"
[[ $(cat s.exr) == old ]] || fail "a picture of no pass replaced a picture"
absent c.film.exr
rm s.exr

# While the scene is read there is nothing to write either.
{
    cat scene.pbrt
    yes 'Shape "sphere"' | head -n 300000
} >many.pbrt
for signal in INT TERM HUP; do
    : >err
    env --default-signal=INT,TERM,HUP "$program" render many.pbrt -o s.exr >out 2>err </dev/null &
    pid=$!
    sleep 0.3
    kill -$signal $pid
    wait $pid
    code=$?
    [[ $code == 5 ]] || fail "SIG$signal while reading: exit code $code"
    says "nothing was written"
    absent s.exr
done
rm many.pbrt

# Who has asked for no hangup (nohup) gets none.
(
    trap '' HUP
    "$program" render scene.pbrt --time 2s -o s.exr --quiet >out 2>err &
    pid=$!
    sleep 0.5
    kill -HUP $pid
    wait $pid
    echo $? >code
)
[[ $(cat code) == 0 ]] || fail "an ignored SIGHUP: exit code $(cat code)"
rm s.exr code

# However short the time, there is a pass to show.
run 0 render scene.pbrt --time 0.0000001s -o t.exr
! grep -q "100%  0" err || fail "no pass, and 100%"
run 0 compare t.exr t.exr
! grep -q "against 0 " out || fail "the picture is black"
rm t.exr

# A time limit is an end like any other.
t=$(now)
run 0 render scene.pbrt --time 0.5s -o t.exr --quiet
took=$(($(now) - t))
((took >= 500 && took < 2500 + limit)) || fail "--time 0.5s took $took ms"
exists t.exr
rm t.exr
only scene.pbrt
finish
