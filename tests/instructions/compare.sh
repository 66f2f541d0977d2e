#!/bin/sh
# compare.sh PROGRAM COUNTS [accept]: counts the instructions of every workload of PROGRAM with callgrind and compares
# them with the file COUNTS (workload, compiler, instructions). More than 10 % above: a warning, and still exit status 0;
# 1 when something cannot be counted. With `accept`, the counts of this compiler become those of today.
set -eu
export LC_ALL=C
program=$1 counts=$2 accept=${3:-}
compiler=$("$program" --compiler)
kept=$(mktemp)
trap 'rm -f "$kept"' EXIT
awk -F'\t' -v compiler="$compiler" 'NR == 1 || $2 != compiler' "$counts" >"$kept"
for workload in $("$program" --list); do
  now=$("${VALGRIND:-valgrind}" --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=measured \
    "$program" "$workload" 2>&1 | sed -n 's/^.*Collected : \([0-9][0-9]*\)$/\1/p')
  [ "${now:-0}" -gt 0 ] || { echo "The instructions of '$workload' cannot be counted." >&2; exit 1; }
  before=$(awk -F'\t' -v workload="$workload" -v compiler="$compiler" '$1 == workload && $2 == compiler { print $3 }' "$counts")
  printf '%s\t%s\t%s\n' "$workload" "$compiler" "$now" >>"$kept"
  if [ -z "$before" ]; then
    echo "$workload: $now instructions; nothing to compare with for $compiler"
  else
    awk -v name="$workload" -v now="$now" -v before="$before" 'BEGIN {
      printf "%s%s: %d instructions, %+.1f %%\n", (now > 1.1 * before ? "WARNING: " : ""), name, now, 100 * (now / before - 1) }'
  fi
done
[ -z "$accept" ] || cat "$kept" >"$counts"
