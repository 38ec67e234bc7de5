#!/bin/sh
# A wheel of the Python module is built against an installed osdtex and used
# from where pip puts it.
#
#     test_wheel.sh BUILD_FOLDER
set -eu
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -c 'import numpy, setuptools, wheel, pip' 2>/dev/null || {
    echo "skipped: no pip, setuptools, wheel or NumPy (tools/deps medium)"
    exit 77
}

cmake --install "$build" --prefix "$work/prefix" >/dev/null
PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name osdtex.pc)")
export PKG_CONFIG_PATH
cp -r tools/python "$work/source"
/usr/bin/python3 -m pip wheel --quiet --no-deps --no-build-isolation \
    --no-index --wheel-dir "$work" "$work/source"
wheel=$(find "$work" -maxdepth 1 -name 'osdtex-*-cp311-abi3-*.whl')
test -s "$wheel"
/usr/bin/python3 -m pip install --quiet --no-deps --no-index \
    --target "$work/there" "$wheel"
cat >"$work/use.py" <<'END'
import sys
sys.path.insert(0, sys.argv[1])
import osdtex
assert osdtex.__file__.startswith(sys.argv[1]), osdtex.__file__
with osdtex.Context() as context:
    mapping = context.map(
        context.read_cage("models/cages/plane.obj"),
        context.read_exemplar("models/exemplars/gravel_tile.png"), level=1)
    print(osdtex.version(), mapping.uvs.shape)
END
/usr/bin/python3 "$work/use.py" "$work/there"
# And what is installed beside the library.
module=$(dirname "$(find "$work/prefix" -name '_osdtex*.so')")
test -e "$module/py.typed"
/usr/bin/python3 "$work/use.py" "$(dirname "$module")"
