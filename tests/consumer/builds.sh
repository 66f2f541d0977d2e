#!/bin/sh
# builds.sh FOLDER: fails where the builds of the steppers and the minimiser in FOLDER show more than their doors, or the portable one has an
# instruction that not every x86-64 processor has.
set -eu
export LC_ALL=C
for build in portable v3 v4; do
  object=$(ls "$1"/gauss_$build*.o)
  seen=$(nm --defined-only --extern-only "$object" | grep -Evc "(gauss_steps|splitting_steps|minimise)_$build" || true)
  [ "$seen" = 0 ] || { echo "Seen from outside of $object:"; nm -C --defined-only --extern-only "$object"; exit 1; }
  vectors=$(objdump -d --no-show-raw-insn "$object" | grep -cE '%[yz]mm|	v[a-z0-9]+ ' || true)
  case $build in
  portable) [ "$vectors" = 0 ] || { echo "AVX in $object: $vectors instructions"; exit 1; } ;;
  *) [ "$vectors" -gt 1000 ] || { echo "No AVX in $object"; exit 1; } ;;
  esac
done
