#!/usr/bin/env bash
# Counts the instructions of small renders (callgrind, one thread, fixed seeds) and compares them with instructions.tsv: times are
# noisy, instructions are not (repeated runs differ by 1e-5). More than 5% above the table fails.
#   instructions.sh NEPHROID SCENES COMPILER           compare
#   instructions.sh NEPHROID SCENES COMPILER --renew   write the table again
set -euo pipefail
nephroid=$1 scenes=$2 compiler=$3 how=${4:-}
here=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd)
table=$here/instructions.tsv
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
command -v valgrind >/dev/null || {
    echo "valgrind is missing: apt-get install valgrind"
    exit 1
}

# SCENE, and the options that make it a small render: of one pass, since time decides how many make a batch, and each batch keeps what a
# stop goes back to.
renders=(
    "cornell-box --integrator path --color rgb"
    "cornell-box --integrator path --color spectral"
    "cornell-spheres --integrator path --color rgb"
    "lights --integrator path --color rgb"
    "instances --integrator path --color spectral"
    "iced-juice --integrator path --color spectral"
    "cornell-spheres --integrator whitted --color rgb"
    "cornell-spheres --integrator sppm --color rgb --set photonsperiteration=16000 --set radius=20"
    "cornell-spheres --integrator photonmap --color rgb --set indirectphotons=16000 --set finalgathersamples=4 --set radius=40"
    "cup --integrator lightpath --color spectral"
)

count() { # count SCENE OPTION…: instructions
    local scene=$1
    shift
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$nephroid" render "$scenes/$scene.pbrt" "$@" \
        --size 136x136 --spp 1 --threads 1 --seed 1 --quiet -o "$folder/p.pfm" 2>"$folder/log" >"$folder/out" || {
        cat "$folder/log"
        return 1
    }
    sed -n 's/^.*Collected : \([0-9]*\).*$/\1/p' "$folder/log"
}

if [[ $how == --renew ]]; then
    {
        printf '# Instructions of small renders: instructions.sh counts them; ./dev instructions writes this table.\n'
        printf '# compiler\t%s\n' "$compiler"
    } >"$folder/table"
else
    made_by=$(sed -n 's/^# compiler\t//p' "$table")
    if [[ $made_by != "$compiler" ]]; then
        echo "not compared: the table was made with $made_by, this build with $compiler"
        exit 77 # ctest: skipped
    fi
fi

bad=0 row=0
printf '%14s %14s %8s  render\n' counted table change
for render in "${renders[@]}"; do
    read -ra words <<<"$render"
    counted=$(count "${words[@]}")
    if [[ $how == --renew ]]; then
        printf '%d\t%s\n' "$counted" "$render" >>"$folder/table"
        printf '%14d %14s %8s  %s\n' "$counted" - - "$render"
        continue
    fi
    row=$((row + 1))
    expected=$(awk -F '\t' -v render="$render" '$2 == render {print $1}' "$table")
    if [[ -z $expected ]]; then
        echo "no row for '$render' in $table: ./dev instructions"
        bad=1
        continue
    fi
    verdict=$(awk -v a="$counted" -v b="$expected" 'BEGIN {c = 100 * (a / b - 1); printf "%+.2f%% %s", c, (c > 5 ? "MORE" : (c < -5 ? "less: ./dev instructions keeps it" : ""))}')
    printf '%14d %14d %8s  %s %s\n' "$counted" "$expected" "${verdict%% *}" "$render" "${verdict#* }"
    [[ $verdict != *MORE ]] || bad=1
done
if [[ $how == --renew ]]; then
    cat "$folder/table" >"$table"
    echo "$table: look at the diff"
elif ((bad)); then
    echo "more than 5% above tests/instructions/instructions.tsv: if that is the price of something right, ./dev instructions writes the table again"
fi
exit "$bad"
