#!/bin/sh
# instructions.sh COMPILER FOLDER OPTION...: compiles instructions.cpp for several instruction sets and fails where two
# of the objects share a function of packs or dual numbers.
set -eu
export LC_ALL=C
compiler=$1 folder=$2
shift 2
here=$(dirname "$0")
mkdir -p "$folder"
case $(uname -m) in x86_64) ;; *) exit 0 ;; esac
all=$folder/all
: >"$all"
for set in x86-64 sandybridge x86-64-v3 x86-64-v4; do
  "$compiler" -std=c++20 -O0 -march=$set "$@" -c "$here/instructions.cpp" -o "$folder/$set.o"
  nm "$folder/$set.o" | awk '$2 ~ /[WV]/ { print $3 }' | grep -E '4Pack|10DualNumber|12EightEntries|6turned|sine' | sort -u >"$folder/$set"
  [ -s "$folder/$set" ] || { echo "No function of packs was found."; exit 1; }
  cat "$folder/$set" >>"$all"
done
shared=$(sort "$all" | uniq -d | c++filt)
[ -z "$shared" ] || { echo "Shared by files with different -m options:"; echo "$shared"; exit 1; }
