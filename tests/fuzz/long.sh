#!/bin/sh
# long.sh FUZZ SECONDS [PROCESSES]: the readers under mutated bytes for long, every process from its own seed; ends with 1
# when one of them has found something. Bytes of findings and the figures stand in ./fuzz_SEED.
set -u
fuzz=$(readlink -f "$1")
processes=${3:-$(nproc)}
first=$(date +%s)
pids=
for seed in $(seq "$first" $((first + processes - 1))); do
  mkdir -p "fuzz_$seed"
  (cd "fuzz_$seed" && exec "$fuzz" all "$2" "$seed" >figures.txt 2>findings.txt) &
  pids="$pids $!"
done
found=0
for pid in $pids; do wait "$pid" || found=1; done
awk '{ sum[$1] += $2 } END { for (name in sum) { print name, sum[name], "executions"; all += sum[name] } print "all", all, "executions" }' fuzz_*/figures.txt
cat fuzz_*/findings.txt
exit $found
