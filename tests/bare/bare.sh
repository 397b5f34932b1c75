#!/usr/bin/env bash
# What a newcomer does, on a system where nothing is installed: the working commit is cloned into a new Debian tree, where the README's first
# command runs and the tests are configured (with --full: built and run). With --package, the Debian packages in build/packages are installed there
# instead, used by an ordinary user, and removed. What this machine has compiled through ccache is taken from there. Called by `./run test --bare`.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
repository=$(cd "$here/../.." && pwd)

fail() {
  echo "bare: $*" >&2
  exit 1
}

release=bookworm depth=demo
for argument in "$@"; do
  case $argument in
    bookworm | 12) release=bookworm ;;
    trixie | 13) release=trixie ;;
    --full | --package) depth=${argument#--} ;;
    *) fail "'$argument': allowed are bookworm (12), trixie (13), --full and --package" ;;
  esac
done
((EUID == 0)) || fail "a tree with a system of its own needs root: sudo ./run test --bare $release"
for tool in mmdebstrap git unshare chroot; do command -v "$tool" >/dev/null || fail "$tool is missing"; done

# In a mount and process namespace of its own: whatever ends this script, nothing stays mounted or running.
if [[ -z ${BRECCIA_BARE_NAMESPACE:-} ]]; then
  BRECCIA_BARE_NAMESPACE=1 exec unshare --mount --pid --fork --kill-child --propagation private "${BASH_SOURCE[0]}" "$@"
fi

# source_lines RELEASE: lines for its sources.list, from the places that this machine takes its own packages from.
source_lines() {
  local own uri suite component
  own=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Identifier: Packages' | sort -u |
    while read -r uri suite component; do
      [[ $component == main && ($suite == "$own" || $suite == "$own"-*) ]] || continue
      echo "deb $uri $1${suite#"$own"} main"
    done
}

# The tree without anything of ours, made once, also where two trials begin at the same time.
base=${XDG_CACHE_HOME:-$HOME/.cache}/breccia/bare/$release-$(dpkg --print-architecture).tar
mkdir -p "$(dirname "$base")"
exec {lock}>"$base.lock"
flock "$lock"
if [[ ! -f $base ]]; then
  echo "bare: making a Debian tree ($release), kept in $base"
  sources=$(source_lines "$release")
  [[ -n $sources ]] || fail "apt names no place from which Debian's packages come"
  mmdebstrap --quiet --variant=minbase "$release" "${base%.tar}.part.tar" - <<<"$sources" || fail "mmdebstrap cannot make a tree of $release"
  mv "${base%.tar}.part.tar" "$base"
fi
exec {lock}>&-

tree=$(mktemp -d "${TMPDIR:-/var/tmp}/breccia-bare.XXXXXX")
out=$repository/runs/bare/$release
[[ $depth != package ]] || out+=-package
leave() {
  umount -R "$tree/dev" "$tree/proc" "$tree/sys" 2>/dev/null || true
  # What is mounted from this machine must never be removed with the tree: that would be of one file system.
  if mountpoint -q "$tree/root/.cache/ccache" && ! umount "$tree/root/.cache/ccache"; then
    echo "bare: $tree is left, since this machine's compiler cache is still mounted there" >&2
    return
  fi
  rm -rf --one-file-system "$tree"
}
trap leave EXIT
tar -C "$tree" -xpf "$base" --exclude='./dev/*'
mount -t proc proc "$tree/proc"
mount -t sysfs sysfs "$tree/sys"
mount -t tmpfs -o mode=755,size=16M tmpfs "$tree/dev"
for node in null zero full random urandom tty; do
  touch "$tree/dev/$node"
  mount --bind "/dev/$node" "$tree/dev/$node"
done
ln -s /proc/self/fd "$tree/dev/fd"
for n in "0 stdin" "1 stdout" "2 stderr"; do ln -s "/proc/self/fd/${n% *}" "$tree/dev/${n#* }"; done
mkdir "$tree/dev/shm" "$tree/dev/pts"
mount -t tmpfs -o mode=1777 tmpfs "$tree/dev/shm"
cp -L /etc/resolv.conf /etc/hosts "$tree/etc/"

rm -rf "$out"
mkdir -p "$out" "$tree/root/breccia"

# in_tree COMMAND: as a newcomer would type it, with nothing of this machine's environment but its way to the network.
in_tree() {
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb ${http_proxy:+http_proxy=$http_proxy} \
    ${https_proxy:+https_proxy=$https_proxy} chroot "$tree" bash -c "cd /root/breccia && $1" </dev/null
}

# step NAME COMMAND: runs it in the tree, its output in NAME.log; says how long it took, fails with the log's end.
step() {
  local name=$1 start=$SECONDS
  echo "bare: $2"
  in_tree "$2" >"$out/$name.log" 2>&1 || {
    tail -n 40 "$out/$name.log" >&2
    fail "'$2' failed on a bare Debian $release; the whole of its output: $out/$name.log"
  }
  echo "bare: done in $((SECONDS - start)) s; the tree holds $(du -shx "$tree" | cut -f1)"
}

# Where this machine compiles through ccache, so does the tree, from the same cache. Nothing that is missing is hidden: ccache
# brings no header or library to compile with, and finds an object only by the compiler and all included files.
share_compiler_cache() {
  local cache
  command -v ccache >/dev/null || return 0
  cache=$(ccache --get-config cache_dir) && [[ -n $cache ]] && mkdir -p "$cache" || return 0
  step ccache "apt-get update && apt-get install -y --no-install-recommends ccache && rm -rf /var/lib/apt/lists/*"
  mkdir -p "$tree/root/.cache/ccache"
  mount --bind "$cache" "$tree/root/.cache/ccache"
}

newcomer() {
  [[ -z "$(git -C "$repository" status --porcelain)" ]] || echo "bare: what is not committed is not in the clone"
  git clone --quiet --no-hardlinks "$repository" "$tree/root/breccia"
  share_compiler_cache
  step demo "./run demo"
  cp "$tree/root/breccia/runs/packages.log" "$out/packages.log"
  grep -hE '^(Need to get|[0-9]+ upgraded)' "$out/demo.log" "$out/packages.log" || true
  local picture file
  for picture in plate fragments stress_20us; do
    file=$tree/root/breccia/runs/demo/$picture.png
    # A picture of one colour takes a few kB.
    [[ -s $file && $(stat -c %s "$file") -gt 50000 ]] || fail "the demo left no picture $picture.png"
    cp "$file" "$out/"
  done
  grep -q '"status": "complete"' "$tree/root/breccia/runs/demo/summary.json" || fail "the demo did not come to its end"
  step configure "./run test --configure"
  grep -E '^(Need to get|[0-9]+ upgraded)' "$out/configure.log" || true
  grep -q "In-situ adaptor: with ParaView" "$out/configure.log" || fail "the in-situ adaptor would not be built; see $out/configure.log"
  grep -q "Desktop: with Qt" "$out/configure.log" || fail "the desktop would not be built; see $out/configure.log"
  grep -q "without its toolbar" "$out/configure.log" && fail "the toolbar in ParaView's window would not be built; see $out/configure.log"
  grep -q "CMake Warning" "$out/configure.log" && fail "the configuration warns; see $out/configure.log"
  [[ -n "$(find "$tree/usr/lib" -name libqsvgicon.so)" ]] || fail "Qt cannot draw the icons: its plugin for SVG is not installed"
  [[ $depth == full ]] || return 0
  step test "./run test"
  tail -n 12 "$out/test.log"
}

user_of_packages() {
  cp "$repository"/build/packages/*.deb "$here/../install/use_installed.sh" "$tree/tmp/"
  chmod -R a+rX "$tree/tmp/"
  step install "apt-get update && apt-get install -y --no-install-recommends /tmp/breccia*.deb"
  step use "useradd --create-home newcomer && cd ~newcomer && su newcomer -c 'mkdir work && cd work && /tmp/use_installed.sh'"
  step remove "DEBIAN_FRONTEND=noninteractive apt-get purge -y breccia breccia-insitu"
  local left
  left=$(find "$tree" -xdev -iname '*breccia*' ! -path "$tree/tmp/*" ! -path "$tree/home/*" ! -path "$tree" ! -path "$tree/root/breccia")
  [[ -z $left ]] || fail "removed packages leave: $left"
}

if [[ $depth == package ]]; then user_of_packages; else newcomer; fi
echo "bare: Debian $release works ($depth); pictures and output in $out"
