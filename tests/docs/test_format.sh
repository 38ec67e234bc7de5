#!/bin/sh
# Every source is as clang-format 14, Debian's, leaves it.
#
#     test_format.sh
set -eu
cd "$(dirname "$0")/../.."
if ! command -v clang-format >/dev/null; then
    echo "skipped: there is no clang-format"
    exit 77
fi
case $(clang-format --version) in
*"version 14."*) ;;
*)
    echo "skipped: this is $(clang-format --version), which formats otherwise"
    exit 77
    ;;
esac
find osdtex include tests tools \( -name '*.c' -o -name '*.h' -o -name '*.cpp' \) |
    LC_ALL=C sort | xargs clang-format --dry-run -Werror
