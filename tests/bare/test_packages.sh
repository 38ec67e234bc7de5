#!/bin/sh
# The Debian packages of a build are installed on a bare Debian 12, and work:
# the program, a host in C, the Python module, manual pages, completions.
#
#     test_packages.sh BUILD_FOLDER
set -eu
build=$(realpath "$1")
work=$build/packages
megabytes=4000
programs=
. "$(dirname "$0")/machine.sh"

(cd "$work" && cpack --config "$build/CPackConfig.cmake" -B "$work/debs" \
    >"$log" 2>&1) || { cat "$log"; exit 1; }
rm -rf "$work/debs/_CPack_Packages"
for name in libosdtex0 libosdtex-dev_ osdtex_ osdtex-doc_ python3-osdtex_; do
    test -n "$(find "$work/debs" -name "$name*.deb")" || {
        echo "there is no package $name"
        exit 1
    }
done

make_machine
cp "$work"/debs/*.deb "$root/root/osdtex/"
cp models/cages/plane.obj models/exemplars/gravel_tile.png \
    tests/consumer/consumer.c "$root/root/osdtex/"
status=0
run_there <<'END' || status=$?
set -eu
cd /root/osdtex
export DEBIAN_FRONTEND=noninteractive
apt-get update
# Manual pages are left out of small images.
rm -f /etc/dpkg/dpkg.cfg.d/*
apt-get install -y --no-install-recommends ./*.deb
osdtex --version
osdtex map plane.obj gravel_tile.png -o by_program.obj --level 1
test -s by_program.exr
test -s /usr/share/man/man1/osdtex.1 -o -s /usr/share/man/man1/osdtex.1.gz
test -s /usr/share/man/man1/osdtex-bake.1 -o -s /usr/share/man/man1/osdtex-bake.1.gz
bash -c '. /usr/share/bash-completion/completions/osdtex; complete -p osdtex'
test -s /usr/share/zsh/vendor-completions/_osdtex
test -s /usr/share/fish/vendor_completions.d/osdtex.fish
test -s /usr/share/doc/osdtex/report.schema.json
cat >use.py <<'PYTHON'
import osdtex
with osdtex.Context() as context:
    mapping = context.map(context.read_cage("plane.obj"),
                          context.read_exemplar("gravel_tile.png"), level=1)
    mapping.write("by_module.obj")
    print(osdtex.build(), mapping.uvs.shape)
PYTHON
python3 use.py
grep '^v\|^f' by_program.obj >one
grep '^v\|^f' by_module.obj >other
cmp one other
# What the shared library and the headers need is said by their packages.
apt-get install -y --no-install-recommends gcc libc6-dev pkgconf
cc -std=c17 consumer.c -o consumer $(pkg-config --cflags --libs osdtex)
./consumer plane.obj gravel_tile.png by_host.obj
grep '^v\|^f' by_host.obj >/dev/null
apt-get purge -y osdtex libosdtex-dev python3-osdtex osdtex-doc
test ! -e /usr/bin/osdtex
END

if [ $status -ne 0 ]; then
    tail -n 100 "$log"
    exit 1
fi
grep '^osdtex [0-9]' "$log"
