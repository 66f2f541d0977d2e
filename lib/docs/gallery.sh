#!/bin/sh
# gallery.sh EXPERIMENTS FOLDER: pages for `make docs`, from the table that CMake writes (experiments.tsv): FOLDER/gallery.md
# with every figure, its caption and the command that makes it, and a page for each chapter, whose introduction is
# lib/docs/chapters/<chapter>.md. A caption is what the figure's script says first. Pictures are shown where they have
# been drawn, and those that are missing are said to be.
set -eu
here=$(dirname "$0")
top=$here/../..
mkdir -p "$2"

caption() { awk '/^#/ { sub(/^# ?/, ""); printf "%s%s", space, $0; space = " "; next } { exit }' "$top/$1"; }

# entry NAME CHAPTER PAPER FIGURE SHOWS
entry() {
  printf '### %s\n\n' "$1"
  [ -z "$3" ] || printf '%s of the paper. ' "$3"
  printf 'Shows %s.\n\n' "$5"
  if [ -n "$4" ]; then
    if [ -e "$top/build/figures/$1.png" ]; then
      printf '![%s](%s.png)\n\n' "$1" "$1"
    else
      printf 'It has not been drawn yet.\n\n'
    fi
    printf '*%s*\n\n`make build/figures/%s.pdf`; drawn by `%s`, ' "$(caption "$4")" "$1" "$4"
  else
    printf '`make build/data/%s.tsv`; ' "$1"
  fi
  printf 'computed in `experiments/%s`, data in `build/data/%s.tsv`.\n\n' "$2" "$1"
}

{
  echo '# Every figure {#gallery}'
  echo
  chapters=$(awk -F'\t' 'NR > 1 && !seen[$2]++ { print $2 }' "$1")
  for chapter in $chapters; do
    page=$(echo "$chapter" | tr / _)
    title=$(sed -n '1s/^# //p' "$here/chapters/$page.md")
    printf '## %s\n\n' "$title"
    entries=$(sed 1d "$1" | tr '\t' '|' | while IFS='|' read -r name in paper figure shows; do
      [ "$in" != "$chapter" ] || entry "$name" "$in" "$paper" "$figure" "$shows"
    done)
    printf '%s\n\n' "$entries"
    {
      sed "1s/\$/ {#chapter_$page}/" "$here/chapters/$page.md"
      printf '\n%s\n' "$entries" | sed 's/^### \(.*\)$/## \1/'
    } >"$2/$page.md"
  done
} >"$2/gallery.md"
