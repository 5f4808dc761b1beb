#!/bin/sh
# A newcomer's Debian: a root with nothing but a compiler and CMake, a clone of the last commit in it, and the two commands.
#   tests/debian_root.sh SUITE                makes the root anew and runs ./quickstart and ./quickstart test in it (SUITE: bookworm, trixie)
#   tests/debian_root.sh SUITE COMMAND...     runs COMMAND in the checkout of the root that is there (made if there is none), brought to the last commit
# To be run as root on a Debian with debootstrap. Mirror and proxy are those of this machine's apt. Roots stand in VITRUM_ROOTS (default /var/tmp/vitrum-roots).
# With CCACHE_DIR set the compiler's cache is shared with the root; times are then not those of a newcomer.
set -eu
suite="${1:?usage: tests/debian_root.sh SUITE [COMMAND...]}"
shift
source="$(cd "$(dirname "$0")/.." && pwd)"
root="${VITRUM_ROOTS:-/var/tmp/vitrum-roots}/$suite"

make_root() {
  mirror="$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Label: Debian' | head -n 1)"
  proxy="$(apt-config shell proxy Acquire::http::Proxy)"
  eval "$proxy"
  [ -z "${proxy-}" ] || export http_proxy="$proxy"
  rm -rf --one-file-system "$root"
  mkdir -p "$root"
  # The archive's security updates are left out: they change no interface.
  debootstrap --variant=minbase --include="g++,cmake${CCACHE_DIR:+,ccache}" "$suite" "$root" "$mirror" >"$root.log"
  apt-config dump Acquire >"$root/etc/apt/apt.conf.d/10host"
}

clone() {
  commit="$(git -C "$source" rev-parse HEAD)"
  [ -d "$root/vitrum/.git" ] || git clone --quiet --no-hardlinks --no-checkout "$source" "$root/vitrum"
  git -C "$root/vitrum" fetch --quiet "$source" "$commit"
  git -C "$root/vitrum" checkout --quiet --force --detach "$commit"
}

# A namespace of its own for mounts and processes: whatever happens, none of them stays behind.
in_root() {
  unshare --mount --pid --fork --kill-child sh -c '
    set -eu
    root="$1"; shift
    mount --bind "$root" "$root"  # a mount point of its own: tests mount small disks below it
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    mount -t tmpfs tmpfs "$root/run"
    if [ -n "${CCACHE_DIR-}" ]; then
      mkdir -p "$root/ccache"
      mount --bind "$CCACHE_DIR" "$root/ccache"
      set -- env CCACHE_DIR=/ccache CCACHE_BASEDIR=/vitrum CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS="${CCACHE_SLOPPINESS-}" \
        CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache "$@"
    fi
    exec env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 TERM="${TERM-dumb}" \
      chroot "$root" sh -c "cd /vitrum && exec \"\$@\"" sh "$@"' sh "$root" "$@"
}

timed() {
  start="$(date +%s)"
  in_root "$@"
  echo "== $suite: $* took $(($(date +%s) - start)) s"
}

if [ $# -eq 0 ]; then
  make_root
  clone
  timed ./quickstart
  timed ./quickstart test
else
  [ -f "$root/etc/apt/apt.conf.d/10host" ] || make_root
  clone
  in_root "$@"
fi
