#!/bin/sh
# sample_data.sh [--quick] [FOLDER]: runs to try reader, filters and examples on, made from meshes/ into FOLDER (runs/sample).
# --quick: very coarse and short ones only, a minute in all. BRECCIA names the program: build/release/solver/breccia where it is not set.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
quick=
[ "${1:-}" = --quick ] && { quick=1; shift; }
folder=${1:-$root/runs/sample}
breccia=${BRECCIA:-$root/build/release/solver/breccia}
[ -x "$breccia" ] || { echo "sample_data.sh: $breccia is missing: ./run build makes it, or BRECCIA names another" >&2; exit 1; }
mkdir -p "$folder"

# sample NAME CASE RANKS: a run, unless it is there already.
sample() {
  echo "$folder/$1: $2 on $3 rank(s)"
  grep -qs '"status": *"complete"' "$folder/$1/summary.json" && return
  if [ "$3" = 1 ]; then
    "$breccia" run "$root/meshes/$2" -f -o "$folder/$1" --progress none
  else
    mpiexec --oversubscribe -n "$3" "$breccia" run "$root/meshes/$2" -f -o "$folder/$1" --progress none
  fi
}
sample glass_coarse glass_impact/case_smoke.toml 1
sample glass_coarse_2_ranks glass_impact/case_smoke.toml 2
[ -n "$quick" ] && exit
sample glass glass_impact/case_demo.toml 1
sample blocks block_drop/case_smoke.toml 1
