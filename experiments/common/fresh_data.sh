#!/bin/sh
# fresh_data.sh --note PROGRAM MADE: PROGRAM has just written its data files in MADE; notes in MADE/.<stem>.made the
# checksums (SHA-256) of the program and of each file.
# fresh_data.sh PROGRAM MADE FOLDER: PROGRAM's data files in FOLDER. They are copied from MADE where the note there is of
# this very program and of the files as they are; else the program runs.
set -eu
sum_of() { sha256sum <"$1" | cut -c1-64; }
if [ "$1" = --note ]; then
  stem=$(basename "$2")
  program=$(sum_of "$2")
  cd "$3"
  { echo "$program"; find * -prune -name "$stem.tsv" -o -prune -name "${stem}_*.tsv" | xargs sha256sum; } >".$stem.part"
  mv ".$stem.part" ".$stem.made"
  exit
fi
stem=$(basename "$1")
note=$2/.$stem.made
mkdir -p "$3"
rm -f "$3/$stem.tsv" "$3/${stem}"_*.tsv
if [ -f "$note" ] && [ "$(head -n 1 "$note")" = "$(sum_of "$1")" ]; then
  sed 1d "$note" | while read -r _ file; do cp "$2/$file" "$3" 2>/dev/null || true; done
  # The copies are checked, not what they were copied from: nothing changes in between.
  (cd "$3" && sed 1d | sha256sum --check --status 2>/dev/null) <"$note" && exit
  rm -f "$3/$stem.tsv" "$3/${stem}"_*.tsv
fi
exec "$1" --output "$3"
