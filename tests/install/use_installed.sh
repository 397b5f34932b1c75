#!/usr/bin/env bash
# Uses an installed Breccia as its users would: `breccia` is on PATH, files go into the current folder. Fails where something does not work.
set -euo pipefail

fail() {
  echo "use_installed: $*" >&2
  exit 1
}

program=$(readlink -f "$(command -v breccia)")
prefix=$(dirname "$(dirname "$program")")
case=$prefix/share/breccia/meshes/glass_impact/case_smoke.toml
[[ $program != */build/* ]] || fail "this is the program of a build, not an installed one: $program"
for file in share/man/man1/breccia.1 share/bash-completion/completions/breccia share/doc/breccia/copyright; do
  [[ -s $prefix/$file || -s $prefix/$file.gz ]] || fail "$file is not installed"
done

breccia --version
breccia check "$case" >check.txt
grep -q '^advice' check.txt || fail "check gave no advice"
breccia run "$case" -o plain --progress none
mpiexec --oversubscribe -n 2 breccia run "$case" -o ranks --progress none
hash_of() { sed -n 's/.*"state_hash": "\(.*\)".*/\1/p' "$1/summary.json"; }
[[ -n "$(hash_of plain)" && "$(hash_of plain)" == "$(hash_of ranks)" ]] || fail "one rank and two ranks differ"

# is_picture FILE: not of one colour, which takes a few kB.
is_picture() { [[ -s $1 && $(stat -c %s "$1") -gt 20000 ]] || fail "$1 is no picture"; }
if command -v pvbatch >/dev/null; then
  breccia-picture plain picture.png
  is_picture picture.png
fi

if [[ -d $prefix/share/doc/breccia/guide ]]; then
  page=$(breccia guide --address contact)
  [[ $page == file://* && -s $(sed 's|file://||; s|%20| |g' <<<"$page") ]] || fail "the guide has no page at $page"
fi

[[ -s $prefix/lib/breccia/libbreccia_gmsh.so ]] || fail "the library that reads meshes with gmsh is not installed"
for file in lib/breccia/libbreccia_catalyst2.so share/breccia/catalyst/python/breccia_catalyst2.py; do
  [[ -s $prefix/$file ]] || fail "the adaptor for Catalyst 2 is not whole, $file lacks"
done
if [[ -f $prefix/lib/breccia/libbreccia_catalyst.so ]]; then
  info=$(breccia insitu info)
  [[ $info == *"$prefix/lib/breccia/libbreccia_catalyst.so"* ]] || fail "another adaptor is used: $info"
  breccia run "$case" -o insitu --progress none --insitu stress,fractures
  [[ "$(hash_of insitu)" == "$(hash_of plain)" ]] || fail "pipelines changed the run"
  [[ -s insitu/extracts/fractures/fractures.pvd ]] || fail "nothing was recorded"
  is_picture "$(find insitu/extracts/stress -name '*.png' | tail -n 1)"

  # ParaView listens where `live` says, and ends with it.
  port=$((20000 + $$ % 10000))
  setsid timeout 120 xvfb-run -a breccia live "$case" --set "insitu.live.address=\"localhost:$port\"" >live.txt 2>&1 &
  for ((waited = 0; waited < 60; ++waited)); do
    grep -q "listens at port $port" live.txt && break
    sleep 1
  done
  grep -q "listens at port $port" live.txt || fail "live did not say where ParaView listens: $(cat live.txt)"
  sleep 5
  kill -0 $! 2>/dev/null || fail "ParaView did not stay: $(cat live.txt)"
  # All of its session: a ParaView whose display goes away first may hang for ever.
  kill -- -$!
  sleep 2
  kill -KILL -- -$! 2>/dev/null || true
  wait $! 2>/dev/null || true
else
  breccia run "$case" -o insitu --insitu stress --progress none 2>message.txt && fail "pipelines without an adaptor"
  grep -q "adaptor is not installed" message.txt || fail "no word of the missing adaptor: $(cat message.txt)"
fi
echo "the installed program works: $program"
