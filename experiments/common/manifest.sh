#!/bin/sh
# manifest.sh FOLDER: one line for each data file of a folder, with two checksums (SHA-256): of the file, and of its
# content - without the head, which names commit and date, and without columns of time. Two runs on one machine agree in
# the second. A table that ranks methods by time has none: its content is "timed".
set -eu
export LC_ALL=C
printf 'file\trows\tcommit\tdate\tcontent\tsha256\n'
for file in "$1"/*.tsv; do
  stem=$(basename "$file" .tsv)
  case $stem in manifest | scorecard*) continue ;; esac
  head_of() { sed -n "s/^# $1: //p" "$file" | head -n 1; }
  if grep -v '^#' "$file" | head -n 1 | tr '\t' '\n' | grep -qx 'cost'; then
    content=timed
  else
    content=$(grep -v '^#' "$file" | awk -F'\t' '
      NR == 1 { for (i = 1; i <= NF; ++i) skip[i] = $i ~ /seconds/ }
      { line = ""; for (i = 1; i <= NF; ++i) if (!skip[i]) line = line "\t" $i; print line }' | sha256sum | cut -c1-64)
  fi
  printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$stem" "$(($(grep -vc '^#' "$file") - 1))" "$(head_of commit)" "$(head_of date)" \
    "$content" "$(sha256sum <"$file" | cut -c1-64)"
done
