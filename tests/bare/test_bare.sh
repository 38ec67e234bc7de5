#!/bin/sh
# On a bare Debian 12, from a clone without shared data beside it, the two
# commands of README.md pass, and nothing is looked for in vain on the way.
#
#     test_bare.sh BUILD_FOLDER
#
# The machine is a chroot in the build folder, removed afterwards. Skipped where
# chroots cannot be made, or no packages be had.
set -eu
work=$(realpath "$1")/bare
root=$work/root
log=$work/log

skip() {
    echo "skipped: $*"
    exit 77
}

[ "$(id -u)" = 0 ] || skip "only root makes a chroot"
for program in mmdebstrap git unshare; do
    command -v $program >/dev/null || skip "no $program (tools/deps medium)"
done
unshare --mount --pid --fork true 2>/dev/null || skip "no namespaces here"
[ "$(df --output=avail -m "$1" | tail -n 1)" -gt 6000 ] ||
    skip "a bare machine takes 6 GB of disk"

# A run that was killed may have left one. Its mounts went with its namespace.
clean() {
    rm -rf --one-file-system "$work"
}
clean
mkdir -p "$work"
trap clean EXIT

mmdebstrap --variant=minbase bookworm "$root" >"$log" 2>&1 ||
    skip "no bare Debian can be made: $(tail -n 1 "$log")"
cp /etc/resolv.conf "$root/etc/"
git -c safe.directory='*' clone -q --no-hardlinks . "$root/root/osdtex"
cat >"$work/commands" <<'END'
set -eu
cd /root/osdtex
./tools/demo
./tools/test
END
cp "$work/commands" "$root/root/commands"

status=0
unshare --mount --pid --fork --kill-child sh -eu -c '
    mount --make-rprivate /
    mount --rbind /dev "$0/dev"
    mount -t proc proc "$0/proc"
    exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
        ${http_proxy:+http_proxy="$http_proxy"} \
        ${https_proxy:+https_proxy="$https_proxy"} \
        sh /root/commands' "$root" >"$log" 2>&1 || status=$?

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
