#!/bin/sh
# Each method can be deleted: its folder and its row, and nothing else.
#
#     test_without.sh FOLDER [METHOD ...]
#
# Builds the program without each method of the table in turn, or without those
# that are named, and textures a cage with the first that is left. It is one
# copy of the tree, so that only what saw the method is compiled again.
set -eu
folder=$1
shift
[ $# -gt 0 ] || set -- $(ls -d osdtex/method/*/ | xargs -n 1 basename)

methods=$folder/tree/osdtex/method
program=$folder/build/osdtex
rm -rf "$folder/tree" "$folder/without"
mkdir -p "$folder/tree"
cp -r CMakeLists.txt include osdtex tools "$folder/tree"
cp "$methods/method.c" "$folder/method.c"

build() {
    cmake -S "$folder/tree" -B "$folder/build" -G Ninja -DOSDTEX_TESTS=OFF \
        -DOSDTEX_WERROR=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
    cmake --build "$folder/build" --target osdtex >"$folder/log" 2>&1 ||
        { cat "$folder/log"; exit 1; }
}

map() {
    exemplar=models/exemplars/pebbles_tile.png
    if [ "$1" = hierarchical ]; then
        exemplar=$folder/tiles.exr
        "$program" tiles models/exemplars/pebbles_tile.png -o "$exemplar" \
            --tile-size 64 -q
    fi
    "$program" map models/cages/torus.obj "$exemplar" -o "$folder/out.obj" \
        --method auto --level 1 -q
    grep -q '^vt ' "$folder/out.obj"
}

for method; do
    mv "$methods/$method" "$folder/without"
    sed "/otx_method_$method[;,]/d" "$folder/method.c" >"$methods/method.c"
    build
    if "$program" methods | grep "^$method "; then
        echo "$method is still there"
        exit 1
    fi
    map "$method"
    echo "works without $method"
    mv "$folder/without" "$methods/$method"
done
