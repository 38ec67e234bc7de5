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
"$work/build/consumer_shared"
"$work/build/consumer_static"

library=$(dirname "$(find "$prefix" -name libosdtex.a)")
PKG_CONFIG_PATH=$library/pkgconfig
export PKG_CONFIG_PATH
pkg-config --modversion osdtex
cc -std=c17 "$here/consumer.c" -o "$work/by_pkgconfig" \
    $(pkg-config --cflags --libs osdtex)
LD_LIBRARY_PATH=$library "$work/by_pkgconfig"
cc -std=c17 "$here/consumer.c" -o "$work/by_pkgconfig_static" \
    $(pkg-config --cflags osdtex) "$library/libosdtex.a" \
    $(pkg-config --libs --static osdtex | sed 's/-losdtex//')
"$work/by_pkgconfig_static"
