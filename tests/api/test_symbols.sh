#!/bin/sh
# The shared library exports what is declared, and nothing else.
#
#     test_symbols.sh LIBRARY
set -eu
library=$(realpath "$1")
cd "$(dirname "$0")"
LC_ALL=C
export LC_ALL
nm -D --defined-only "$library" | awk '{print $3}' | sort | diff -u symbols.txt -
# Every options struct has its defaults for bindings, too.
without=$(grep -ho 'osdtex_[a-z_]*_\(default\|none\)(void)' \
    ../../include/osdtex/*.h | sed 's/_[a-z]*(void)$/_init/' | sort |
    comm -23 - symbols.txt)
test -z "$without" || { echo "not there: $without"; exit 1; }
grep -ho 'osdtex_[a-z_]*(' ../../include/osdtex/*.h | tr -d '(' |
    grep -v '_default$\|_none$' | sort -u | diff -u symbols.txt -
