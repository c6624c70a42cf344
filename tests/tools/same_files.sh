#!/usr/bin/env bash
# same_files.sh TOOL DIR: what `TOOL somewhere` writes is in DIR with the same bytes, and these folders hold no other file.
set -euo pipefail
tool=$1 dir=$2
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
"$tool" "$made"
bad=0
for part in meshes textures include/valley; do
    diff -rq "$made/$part" "$dir/$part" || bad=1
done
((bad == 0)) || echo "run ./dev meshes and look at what changed"
exit "$bad"
