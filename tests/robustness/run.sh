#!/usr/bin/env bash
# run.sh PROGRAM [SHARED [JOBS]]: broken files of every kind that the program reads. Each must end with exit code 0, 2 or 3
# within 10 s, name the file when it was refused, and be taken or refused as MANIFEST.tsv says. Nothing may be left behind.
#
# Scenes are rendered; meshes directly and as the plymesh or objmesh of a small scene; pictures as a texture and as an
# infinite light; spectra as a reflectance. Exit code 77 when the files are not there. NEPHROID_SHARED goes before SHARED;
# NEPHROID_TIMEOUT changes the 10 s; NEPHROID_REPORT names a file for a line on every run.
set -u
program=$(realpath "$1")
shared=${NEPHROID_SHARED:-${2:-}}
jobs=${3:-2}
limit=${NEPHROID_TIMEOUT:-10}
data=$shared/data/malformed
if [[ -z $shared || ! -d $data/made ]]; then
    echo "SKIPPED: no broken files at '$data'; set NEPHROID_SHARED to the folder that holds data/malformed"
    exit 77
fi
data=$(realpath "$data")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work"/{scenes,out,log,links}

# What the manifest expects cannot be met, or need not be, in these uses.
#   ok_rle.hdr is 8 x 1: pictures of infinite lights are square or twice as wide as high.
#   attr_unbalanced.pbrt and mesh_notmult.pbrt are read by pbrt, which goes on without the excess, and so do we (notes).
#   exp255.hdr is as bright as floats go: as a light its samples overflow, are dropped and counted, and the program says so.
declare -A instead=(
    [light:hdr/ok_rle.hdr]=either
    [light:hdr/exp255.hdr]=tainted
    [scene:pbrt/attr_unbalanced.pbrt]=accept
    [scene:pbrt/mesh_notmult.pbrt]=accept
)

declare -A expected=()
while IFS=$'\t' read -r file what _; do expected[$file]=$what; done <"$data/made/MANIFEST.tsv"

head_of_scene='LookAt 0 0 -5 0 0 0 0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
Sampler "independent" "integer pixelsamples" 1
WorldBegin'
list=$work/list
: >"$list"
number=0

# add KIND EXPECTED FILE ARGUMENTS…: one run. The list's entries end with NUL, fields with 0x1F.
add() {
    local kind=$1 what=$2 file=$3
    shift 3
    local name=${file#"$data"/made/}
    what=${instead[$kind:$name]:-$what}
    number=$((number + 1))
    printf '%s\x1f%s\x1f%s\x1f%s\x1f%s\0' "$number" "$kind" "$what" "$file" "$(printf '%q ' "$@")" >>"$list"
}
# wrapped KIND EXPECTED FILE DIRECTIVES: a scene of these directives around the file.
wrapped() {
    local scene=$work/scenes/$number-$1.pbrt
    printf '%s\n%s\n' "$head_of_scene" "$4" >"$scene"
    add "$1" "$2" "$3" "$scene"
}

while IFS= read -r -d '' file; do
    name=${file#"$data"/made/}
    what=${expected[$name]:-either}
    suffix=${file##*.}
    [[ $file == */afl/* ]] && suffix=obj
    # Materials are read with their meshes; the rest are notes.
    [[ $file == *.txt || $file == *.mtl || $file == *.csv || $file == */LICENSE ]] && continue
    small=(--spp 1 --size 8x8)
    case $suffix in
        pbrt)
            # Where the fault is the film's size or the number of samples, the command line must not hide it.
            [[ $name == pbrt/res* || $name == pbrt/spp* ]] && small=()
            add scene "$what" "$file" "$file" "${small[@]}"
            ;;
        ply)
            add direct "$what" "$file" "$file" "${small[@]}"
            wrapped plymesh "$what" "$file" "Shape \"plymesh\" \"string filename\" \"$file\""
            ;;
        obj)
            direct=$file
            if [[ $file != *.obj ]]; then
                direct="$work/links/${file##*/}.obj"
                ln -s "$file" "$direct"
            fi
            add direct "$what" "$file" "$direct" "${small[@]}"
            wrapped objmesh "$what" "$file" "Shape \"objmesh\" \"string filename\" \"$direct\""
            ;;
        png | exr | hdr | pfm)
            wrapped texture "$what" "$file" "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"$file\"
LightSource \"point\" \"rgb I\" [ 1 1 1 ] \"point3 from\" [ 0 0 -5 ]
Material \"diffuse\" \"texture reflectance\" \"t\"
Shape \"sphere\""
            wrapped light "$what" "$file" "LightSource \"infinite\" \"string filename\" \"$file\"
Material \"diffuse\" \"rgb reflectance\" [ .5 .5 .5 ]
Shape \"sphere\""
            ;;
        spd)
            wrapped spectrum "$what" "$file" "LightSource \"point\" \"point3 from\" [ 0 0 -5 ]
Material \"diffuse\" \"spectrum reflectance\" \"$file\"
Shape \"sphere\""
            ;;
    esac
done < <(find "$data"/made/{pbrt,ply,obj,png,exr,hdr,pfm,spd} "$data/image" "$data/mesh" -type f -print0 | sort -z)

one() {
    local number kind what file arguments
    IFS=$'\x1f' read -r -d '' number kind what file arguments <<<"$1"
    local log=$work/log/$number out=$work/out/$number code bad=""
    mkdir "$out"
    local -a args
    eval "args=($arguments)"
    local start=${EPOCHREALTIME/./}
    (cd "$out" && timeout -s KILL "$limit" "$program" render "${args[@]}" -o picture.png --threads 1 --quiet) >"$log.out" 2>"$log"
    code=$?
    local took=$(((${EPOCHREALTIME/./} - start) / 1000))
    case $code in
        0) [[ $what != reject ]] || bad="accepted, but the manifest says reject" ;;
        6) [[ $what == tainted ]] || bad="exit code 6" ;;
        2 | 3) [[ $what != accept ]] || bad="refused, but the manifest says accept" ;;
        137) bad="killed: more than $limit s, or out of memory" ;;
        *) bad="exit code $code" ;;
    esac
    if ((code == 0 || code == 6)); then
        [[ -s $out/picture.png ]] || bad+=" no picture"
        rm -f "$out/picture.png"
    elif [[ -z $bad ]]; then
        grep -qF -- "${file##*/}" "$log" || bad="the message does not name the file"
        (($(wc -c <"$log") < 2000)) || bad="a message of $(wc -c <"$log") bytes"
    fi
    grep -qE 'Sanitizer|runtime error:' "$log" && bad+=" (sanitizer)"
    [[ -z $(ls -A "$out") ]] || bad+=" left behind: $(ls -A "$out" | tr '\n' ' ')"
    printf '%s\t%s\t%s\t%s\t%s\n' "$took" "$code" "$kind" "$file" "$(head -c 300 "$log" | head -2 | tr '\n\t' '  ')" >"$log.took"
    [[ -z $bad ]] && return
    printf 'FAILED: %s %s: %s\n' "$kind" "${file#"$data"/}" "$bad"
    head -c 3000 "$log" | head -12 | sed 's/^/    /'
    touch "$log.failed"
}
export -f one
export work program limit data
xargs -0 -n 1 -P "$jobs" bash -c 'one "$1"' _ <"$list"

failed=$(find "$work/log" -name '*.failed' | wc -l)
read -r slowest code kind file _ < <(cat "$work"/log/*.took | sort -rn | head -1)
accepted=$(cat "$work"/log/*.took | cut -f2 | grep -c '^0$')
[[ -z ${NEPHROID_REPORT:-} ]] || cat "$work"/log/*.took >"$NEPHROID_REPORT"
echo "$number runs: $accepted taken, $((number - accepted)) refused or worse, $failed failed; the slowest took $slowest ms ($kind ${file#"$data"/})"
((number > 0 && failed == 0))
