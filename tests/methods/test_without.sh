#!/bin/sh
# Each method can be deleted: its folder and its row, and nothing else.
#
#     test_without.sh FOLDER [METHOD ...]
#
# Builds the program without each method of the table in turn, or without those
# that are named, and textures a cage with the first that is left.
set -eu
folder=$1
shift
[ $# -gt 0 ] || set -- $(ls -d osdtex/method/*/ | xargs -n 1 basename)

for method; do
    tree=$folder/$method
    rm -rf "$tree/tree"
    mkdir -p "$tree/tree"
    cp -r CMakeLists.txt include osdtex tools "$tree/tree"
    rm -r "$tree/tree/osdtex/method/$method"
    sed -i "/otx_method_$method[;,]/d" "$tree/tree/osdtex/method/method.c"
    cmake -S "$tree/tree" -B "$tree/build" -G Ninja -DOSDTEX_TESTS=OFF \
        -DOSDTEX_WERROR=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        >"$tree/log" 2>&1 || { cat "$tree/log"; exit 1; }
    cmake --build "$tree/build" --target osdtex >"$tree/log" 2>&1 ||
        { cat "$tree/log"; exit 1; }
    program=$tree/build/osdtex
    if "$program" methods | grep "^$method "; then
        echo "$method is still there"
        exit 1
    fi
    if [ "$method" = hierarchical ]; then
        exemplar=$tree/tiles.exr
        "$program" tiles models/exemplars/pebbles_tile.png -o "$exemplar" \
            --tile-size 64 -q
    else
        exemplar=models/exemplars/pebbles_tile.png
    fi
    "$program" map models/cages/torus.obj "$exemplar" -o "$tree/out.obj" \
        --method auto --level 1 -q
    grep -q '^vt ' "$tree/out.obj"
    echo "works without $method"
done
