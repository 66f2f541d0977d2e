#!/bin/sh
# check_log.sh LOG: fails on what a referee would see in the PDF: an undefined or doubled reference or label, a missing
# glyph, a box that stands out by more than 5 pt.
# Without a log there is nothing to judge: status 77, which CTest takes for a skipped test.
set -eu
[ -e "$1" ] || exit 77
bad=$(grep -aE 'undefined|multiply.defined|Missing character|Font Warning.*(undefined|not available)|Rerun to get' "$1" || true
  grep -aoE 'Overfull \\[hv]box \([0-9.]+pt too (wide|high)\).*' "$1" | awk -F'[(p]' '$2 + 0 > 5' || true)
[ -z "$bad" ] || { echo "$bad"; exit 1; }
