#!/bin/sh
# Two ranks write the same bits as one, and a file that is lost is an error. Arguments: mpirun, program, folder.
set -e
mkdir -p "$3"
# Where root runs it, and where there are fewer processors than ranks.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
"$1" -n 1 "$2" "$3/one.tsv"
"$1" -n 2 "$2" "$3/two.tsv"
cmp "$3/one.tsv" "$3/two.tsv"
test "$(wc -l < "$3/two.tsv")" -eq 60
if [ -c /dev/full ] && "$1" -n 1 "$2" /dev/full; then
  echo "A full disk was not noticed."
  exit 1
fi
