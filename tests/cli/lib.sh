# What the scripts of the command line share: source it with PROGRAM as $1. Works in a folder of its own, which is removed.
set -u
program=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
    echo "FAILED (line ${BASH_LINENO[1]}): $*"
    [[ ! -s err ]] || sed 's/^/    /' err | head -12
    failures=$((failures + 1))
}
# run CODE ARGUMENTS…: the program must exit with CODE; its output is in the files out and err.
run() {
    local expected=$1 code
    shift
    "$program" "$@" >out 2>err </dev/null
    code=$?
    [[ $code == "$expected" ]] || fail "exit code $code instead of $expected: nephroid $*"
}
says() { grep -qF -- "$1" err || fail "stderr does not say \"$1\""; }
prints() { grep -qF -- "$1" out || fail "stdout does not say \"$1\""; }
silent() { [[ ! -s $1 ]] || fail "$1 is not empty: $(head -c 200 "$1")"; }
same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }
exists() { [[ -s $1 ]] || fail "$1 was not written"; }
# Waits until a program in the background has written a file, for a minute.
await() {
    for _ in {1..600}; do
        [[ ! -s $1 ]] || return 0
        sleep 0.1
    done
    fail "$1 did not appear within a minute"
}
absent() { [[ ! -e $1 ]] || fail "$1 was written"; }
# Only these files (and out, err) are in the folder.
only() {
    local found
    found=$(find . -mindepth 1 ! -name out ! -name err -printf '%P\n' | sort | xargs)
    [[ $found == "$(printf '%s\n' "$@" | sort | xargs)" ]] || fail "the folder holds: $found; expected: $*"
}
finish() {
    ((failures == 0)) || {
        echo "$failures failures"
        exit 1
    }
    echo "all good"
    exit 0
}

cat >scene.pbrt <<'SCENE'
LookAt 0 1 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 24 "string filename" "named.exr"
Sampler "independent" "integer pixelsamples" 2
WorldBegin
LightSource "point" "rgb I" [ 9 9 9 ] "point3 from" [ 0 3 -4 ]
LightSource "infinite" "float scale" 0.1
Material "dielectric"
Shape "sphere" "float radius" 1
Material "diffuse"
Translate 0 -1 0
Shape "disk" "float radius" 5 "float hieght" 0
SCENE
# room: a scene of a lamp over a floor with a glass ball on it, closed in by a box, of the material that stdin sets last.
room() {
    cat <<'SCENE'
LookAt 0 1 -2.9  0 0.4 0  0 1 0
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 40 "integer yresolution" 30 "string filename" "room.exr"
Sampler "sobol" "integer pixelsamples" 2
Integrator "path" "integer maxdepth" 7
WorldBegin
AttributeBegin
AreaLightSource "diffuse" "rgb L" [ 9 8 4 ]
Translate 0 2.9 0
Rotate 90 1 0 0
Shape "disk" "float radius" 0.5
AttributeEnd
SCENE
    cat
    cat <<'SCENE'
AttributeBegin
ReverseOrientation
Shape "box" "point3 lo" [ -3 -0.5 -3 ] "point3 hi" [ 3 3 3 ]
AttributeEnd
Material "dielectric"
Shape "sphere" "float radius" 0.5
SCENE
}
