#!/bin/sh
# The tree built another way: with another compiler, or with sanitizers.
#
#     inner_build.sh FOLDER compile|test [cmake options]
#
# Warnings are errors. `test` also runs the short tier there.
set -eu
folder=$1
what=$2
shift 2
cmake -S . -B "$folder" -G Ninja -DOSDTEX_WERROR=ON -DOSDTEX_INNER=ON "$@" \
    >"$folder.log" 2>&1 || { cat "$folder.log"; exit 1; }
cmake --build "$folder" >"$folder.log" 2>&1 || { cat "$folder.log"; exit 1; }
if [ "$what" = test ]; then
    ctest --test-dir "$folder" -L '^short$' --output-on-failure -j "$(nproc)"
fi
