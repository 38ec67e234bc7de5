#!/bin/sh
# The shared library still has the interface that its name promises: nothing
# that programs are linked against is gone or laid out in another way. Additions
# are fine (docs/conventions.md, "Versions").
#
#     test_abi.sh LIBRARY             compare with tests/api/abi/NAME.abi.gz
#     test_abi.sh --write LIBRARY     describe a new interface
set -eu
write=
[ "$1" = --write ] && write=1 && shift
if ! command -v abidiff >/dev/null || ! command -v abidw >/dev/null; then
    echo "skipped: there is no abidiff (Debian: abigail-tools)"
    exit 77
fi
here=$(realpath "$(dirname "$0")")
name=$(objdump -p "$1" | awk '/SONAME/ {print $2}')
wanted=$here/abi/$name.abi.gz
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
abidw --suppressions "$here/abi/private.suppr" --no-show-locs \
    --no-corpus-path --no-comp-dir-path --short-locs "$1" >"$work/new.abi"
if [ -n "$write" ]; then
    gzip -9nc "$work/new.abi" >"$wanted"
    exit
fi
if [ ! -e "$wanted" ]; then
    echo "there is no description of $name; run $0 --write $1"
    exit 1
fi
gunzip -c "$wanted" >"$work/old.abi"
# 4: something changed; 8: so that programs break; 1, 2: it did not work.
set +e
abidiff "$work/old.abi" "$work/new.abi"
status=$?
set -e
case $status in 0 | 4) ;; *) exit 1 ;; esac
