#!/bin/sh
# On a bare Debian 12, from a clone without shared data beside it, the two
# commands of README.md pass, and nothing is looked for in vain on the way.
#
#     test_bare.sh BUILD_FOLDER
set -eu
work=$(realpath "$1")/bare
megabytes=6000
programs=git
. "$(dirname "$0")/machine.sh"

make_machine
git -c safe.directory='*' clone -q --no-hardlinks . "$root/root/osdtex"
status=0
run_there <<'END' || status=$?
set -eu
cd /root/osdtex
./tools/demo
./tools/test
END

grep '^skipped in \|^[0-9]* passed' "$log" || true
if [ $status -ne 0 ]; then
    tail -n 200 "$log"
    exit 1
fi
if grep 'Unable to locate package' "$log"; then
    exit 1
fi
for name in creature.obj creature.exr creature.png creature_patches.png; do
    test -s "$root/root/osdtex/out/demo/$name"
done
