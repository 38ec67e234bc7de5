#!/bin/sh
# Installs a build into a folder of its own and builds a project against it:
# by find_package (shared and static) and by pkg-config (both again).
#
#     test_consumer.sh BUILD_FOLDER
set -eu
build=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

cmake --install "$build" --prefix "$prefix" >/dev/null
"$prefix/bin/osdtex" --version
test -s "$prefix/include/osdtex/osdtex.h"

cmake -S "$here" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
cmake --build "$work/build"
# What the README and the library's guide show are these programs.
sed -n '/^    \/\* Textures a cage/,/^    }$/p' "$here/../../README.md" |
    sed 's/^    //' | diff -u "$here/consumer.c" -
awk '/^\/\* Textures a cube/ {on = 1} /^```$/ {on = 0} on' \
    "$here/../../docs/library.md" | diff -u "$here/memory.c" -

run() {
    models=$here/../../models
    "$1" "$models/cages/plane.obj" "$models/exemplars/gravel_tile.png" \
        "$work/out.obj"
    test -s "$work/out.obj" && test -s "$work/out.exr"
    rm "$work"/out.*
    ! "$1" "$models/cages/none.obj" none.png "$work/out.obj" 2>"$work/said"
    test -s "$work/said" && ! test -e "$work/out.obj"
}
# A host without files: the texels add up to what the picture does, and figures
# are told; both libraries say the same but for times.
told() {
    "$1" >"$work/told"
    grep -q '^256 x 256 texels, mean 0\.3[0-9]*$' "$work/told"
    grep -q '^seams.visible_share = ' "$work/told"
    grep -v '^seconds\|^memory' "$work/told" >"$work/$2"
}
told "$work/build/memory_shared" shared
told "$work/build/memory_static" static
diff "$work/shared" "$work/static"
run "$work/build/consumer_shared"
run "$work/build/consumer_static"

library=$(dirname "$(find "$prefix" -name libosdtex.a)")
PKG_CONFIG_PATH=$library/pkgconfig
export PKG_CONFIG_PATH
pkg-config --modversion osdtex
cc -std=c17 "$here/consumer.c" -o "$work/by_pkgconfig" \
    $(pkg-config --cflags --libs osdtex)
(export LD_LIBRARY_PATH="$library"; run "$work/by_pkgconfig")
cc -std=c17 "$here/consumer.c" -o "$work/by_pkgconfig_static" \
    $(pkg-config --cflags osdtex) "$library/libosdtex.a" \
    $(pkg-config --libs --static osdtex | sed 's/-losdtex//')
run "$work/by_pkgconfig_static"
