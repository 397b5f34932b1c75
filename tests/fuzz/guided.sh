#!/bin/sh
# guided.sh FUZZ_GUIDED SECONDS [TARGET...]: every target, or those named, under libFuzzer for so long, one after another.
# Inputs that reach new branches stay in ./guided/TARGET and are gone on from; ends with 1 when something has been found,
# whose bytes stand in ./guided/TARGET_found. Prints executions, branches reached and the size of what is kept.
set -u
fuzz=$(readlink -f "$1")
seconds=$2
shift 2
[ $# -gt 0 ] || set -- case override quantity geometry mesh content source control checkpoint index state
# Open MPI, which the checkpoint's library brings, keeps memory of its own.
export ASAN_OPTIONS=detect_leaks=0
found=0
for target in "$@"; do
  mkdir -p "guided/$target" "guided/${target}_found"
  [ -e "guided/$target/seed_0" ] || "$fuzz" "--target=$target" "--seeds=guided/$target"
  "$fuzz" "--target=$target" "-max_total_time=$seconds" -timeout=10 -max_len=65536 -print_final_stats=1 \
    "-artifact_prefix=guided/${target}_found/" "guided/$target" >"guided/$target.log" 2>&1 || found=1
  awk -v name="$target" '/cov: /{ for (i = 1; i < NF; ++i) if ($i == "cov:") branches = $(i + 1); else if ($i == "corp:") kept = $(i + 1) }
    /number_of_executed_units/ { executions = $2 }
    END { printf "%-10s %10d executions, %5d branches, kept %s\n", name, executions, branches, kept }' "guided/$target.log"
done
ls guided/*_found/* 2>/dev/null
exit $found
