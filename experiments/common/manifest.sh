#!/bin/sh
# manifest.sh FOLDER: one line for each data file of a folder, with two checksums (SHA-256): of the file, and of its
# content - without the head, which names commit and date, and without columns of time. Two runs on one machine agree in
# the second. A table that ranks methods by time has none: its content is "timed".
set -eu
export LC_ALL=C
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$1"
set -- # the data files
for file in *.tsv; do
  case $file in manifest.tsv | scorecard*) ;; *) set -- "$@" "$file" ;; esac
done
# Contents go into files of their own, so that one process takes all checksums.
awk -F'\t' -v scratch="$scratch" '
  function finish() { if (name != "") { print name "\t" rows "\t" commit "\t" date "\t" timed; close(content) } }
  FNR == 1 { finish(); name = FILENAME; rows = -1; commit = date = ""; timed = 0; content = scratch "/" name }
  /^# commit: / && commit == "" { commit = substr($0, 11) }
  /^# date: / && date == "" { date = substr($0, 9) }
  /^#/ { next }
  ++rows == 0 { split("", skip); for (i = 1; i <= NF; ++i) { skip[i] = $i ~ /seconds/; timed += $i == "cost" } }
  { line = ""; for (i = 1; i <= NF; ++i) if (!skip[i]) line = line "\t" $i; print line >content }
  END { finish() }' "$@" >"$scratch/heads"
sha256sum "$@" >"$scratch/files"
(cd "$scratch" && sha256sum "$@") >"$scratch/contents"
printf 'file\trows\tcommit\tdate\tcontent\tsha256\n'
paste "$scratch/heads" "$scratch/contents" "$scratch/files" | awk -F'\t' -v OFS='\t' '{
  sub(/\.tsv$/, "", $1); print $1, $2, $3, $4, $5 ? "timed" : substr($6, 1, 64), substr($7, 1, 64) }'
