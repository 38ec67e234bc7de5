#!/bin/sh
# One full run, and a picture of it, without a single finding of valgrind.
#
#     test_valgrind.sh PROGRAM
set -eu
program=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Threads are looked at by the sanitizers; here one is faster.
check="valgrind -q --error-exitcode=9 --leak-check=full
    --errors-for-leak-kinds=definite --show-leak-kinds=definite"

$check "$program" map models/cages/plane.obj models/exemplars/gravel_tile.png \
    -o "$work/out.obj" --level 1 --scale 4 --threads 1 -q \
    --json-report "$work/out.json"
$check "$program" render "$work/out.obj" -o "$work/out.png" --size 32x24 \
    --samples 1 --threads 1 -q
