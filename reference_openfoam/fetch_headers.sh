#!/bin/sh
# Fetches the headers that belong to the installed Debian package `libopenfoam`.
#
# Debian's binary package has the libraries and programs but no headers; the source package of the same version has them.
# apt fetches that source package from the machine's own Debian entries, turned into source entries in a private folder, so
# that the machine's configuration stays as it is; apt checks the signature of the index and the checksums of the files.
#
# Usage: fetch_headers.sh CACHE_FOLDER
# Result: CACHE_FOLDER/openfoam-VERSION/include/LIBRARY/*.H (flat folders of links, as wmake's lnInclude), and on stdout the
# path CACHE_FOLDER/openfoam-VERSION. Does nothing when that folder is already there. Status 1 and one line on failure.
set -eu

say_and_stop() { echo "fetch_headers.sh: $1" >&2; exit 1; }

[ $# -eq 1 ] || say_and_stop "usage: fetch_headers.sh CACHE_FOLDER"
command -v dpkg-query >/dev/null || say_and_stop "this is no Debian machine; install OpenFOAM v1912 or later and source its etc/bashrc instead"
version=$(dpkg-query -W -f '${source:Version}' libopenfoam 2>/dev/null) || version=
[ -n "$version" ] || say_and_stop "the package libopenfoam is not installed; run: apt-get install openfoam"

mkdir -p "$1" || say_and_stop "cannot make the cache folder $1"
cache=$(cd "$1" && pwd)
final=$cache/openfoam-$version
if [ -f "$final/complete" ]; then echo "$final"; exit 0; fi

work=$(mktemp -d "$cache/fetching-XXXXXX") || say_and_stop "cannot write in $cache"
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM HUP
mkdir -p "$work/parts" "$work/lists/partial" "$work/archives/partial" "$work/download" "$work/tree/include"

# The machine's Debian entries, of either form, as source entries. apt itself reads only *.sources and *.list.
for entry in /etc/apt/sources.list.d/*.sources; do
    [ -f "$entry" ] || continue
    awk 'BEGIN { RS = ""; ORS = "\n\n" }
         tolower($0) ~ /debian/ && $0 !~ /(^|\n)Enabled:[ \t]*no/ { gsub(/(^|\n)Types:[^\n]*/, "\nTypes: deb-src"); sub(/^\n/, ""); print }' \
        "$entry" > "$work/parts/$(basename "$entry")"
done
for entry in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ -f "$entry" ] || continue
    sed -n 's/^[ \t]*deb[ \t]\(.*debian.*\)$/deb-src \1/p' "$entry" > "$work/parts/$(basename "$entry" .list).list"
done
find "$work/parts" -size 0 -delete
[ -n "$(ls "$work/parts")" ] || say_and_stop "no Debian entry found in /etc/apt/sources.list or /etc/apt/sources.list.d"

apt_private() {
    apt-get -q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/parts" -o Dir::State::Lists="$work/lists" \
        -o Dir::Cache="$work" -o Dir::Cache::archives="$work/archives" -o APT::Sandbox::User= -o Acquire::Languages=none -o Acquire::Retries=3 "$@"
}
echo "fetch_headers.sh: fetching the source package of openfoam $version (45 MB)" >&2
apt_private update > "$work/log" 2>&1 \
    || say_and_stop "apt cannot read the source index: $(grep -m1 '^E:' "$work/log" || echo 'no message')"
(cd "$work/download" && apt_private source --download-only "openfoam=$version") > "$work/log" 2>&1 \
    || say_and_stop "apt cannot fetch the source package openfoam $version: $(grep -m1 '^E:' "$work/log" || echo 'no message')"

archive=$(find "$work/download" -name 'openfoam_*.orig.tar.*' ! -name '*.asc' | head -n 1)
[ -n "$archive" ] || say_and_stop "the source package of openfoam $version holds no orig.tar archive"
libraries="OpenFOAM OSspecific/POSIX finiteVolume meshTools surfMesh fileFormats transportModels"
patterns=
for library in $libraries; do patterns="$patterns */src/$library"; done
# shellcheck disable=SC2086
tar -xf "$archive" -C "$work/tree" --strip-components=1 --wildcards $patterns \
    || say_and_stop "cannot unpack $(basename "$archive")"

# One flat folder of relative links for each library, in place of wmake's lnInclude; only what a compiler reads is linked.
for library in $libraries; do
    flat=$work/tree/include/$(basename "$library")
    mkdir -p "$flat"
    (cd "$work/tree/src/$library" && find . \( -name '*.[HC]' -o -name '*.hpp' -o -name '*.h' \) ! -path '*/lnInclude/*' ! -path '*/Make/*') \
        | awk -v source="../../src/$library" '{ sub(/^\.\//, ""); print source "/" $0 }' \
        | (cd "$flat" && xargs ln -sf -t .)
done
[ -f "$work/tree/include/finiteVolume/fvCFD.H" ] || say_and_stop "the source package of openfoam $version has no fvCFD.H"
echo "$version" > "$work/tree/complete"
rm -rf "$final"
mv "$work/tree" "$final" || say_and_stop "cannot move the headers to $final"
echo "$final"
