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
grep -ho 'osdtex_[a-z_]*(' ../../include/osdtex/*.h | tr -d '(' |
    grep -v '_default$\|_none$' | sort -u | diff -u symbols.txt -
