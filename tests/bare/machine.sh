# machine.sh -- a bare Debian 12, as a chroot in a build folder; to be read by
# the tests here, after
#
#     work=FOLDER          which is emptied, and removed afterwards
#     megabytes=NUMBER     that it takes of the disk
#     programs=NAMES       that are needed beside mmdebstrap and unshare
#
# It sets root and log, and ends as skipped where chroots cannot be made, or no
# packages be had.
root=$work/root
log=$work/log

skip() {
    echo "skipped: $*"
    exit 77
}

[ "$(id -u)" = 0 ] || skip "only root makes a chroot"
for program in mmdebstrap unshare $programs; do
    command -v "$program" >/dev/null ||
        skip "no $program (tools/deps medium)"
done
unshare --mount --pid --fork true 2>/dev/null || skip "no namespaces here"
[ "$(df --output=avail -m "$(dirname "$work")" | tail -n 1)" -gt "$megabytes" ] ||
    skip "a bare machine takes $megabytes MB of disk"

# A run that was killed may have left one. Its mounts went with its namespace.
clean() {
    rm -rf --one-file-system "$work"
}
clean
mkdir -p "$work"
trap clean EXIT

make_machine() {
    mmdebstrap --variant=minbase bookworm "$root" >"$log" 2>&1 ||
        skip "no bare Debian can be made: $(tail -n 1 "$log")"
    cp /etc/resolv.conf "$root/etc/"
    mkdir -p "$root/root/osdtex"
}

# Runs the shell commands of standard input there, with nothing of this
# machine's environment but how packages are had. What they say goes to the log.
run_there() {
    cat >"$root/root/commands"
    unshare --mount --pid --fork --kill-child sh -eu -c '
        mount --make-rprivate /
        mount --rbind /dev "$0/dev"
        mount -t proc proc "$0/proc"
        exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
            ${http_proxy:+http_proxy="$http_proxy"} \
            ${https_proxy:+https_proxy="$https_proxy"} \
            sh /root/commands' "$root" >"$log" 2>&1
}
