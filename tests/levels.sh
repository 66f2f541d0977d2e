#!/bin/sh
# levels.sh [CONFIGURATION...]: the same numbers whatever the compiler, its level of optimisation and the instruction set?
# A configuration is <compiler>-<O0|O1|O2|O3>-<native|portable|nofma>, the last of them native without fused instructions;
# without any: g++ and clang++-14, O3, O2 and O0, native and portable.
# Each is built into build/levels/<configuration> and runs four experiments of the paper's tables, shortened. Every cell
# but seconds must be that of the first: counts exactly, other numbers to 2e-8 relative, and runs of collocation
# (tests/levels/collocation_bits.cpp) in every bit (seen with 20 such runs, sweeps counted: equal from g++ and clang++ at
# O3, O2 and O0, with AVX-512, AVX2 and SSE2, with and without fused instructions. Tables: equal in every digit
# between compilers, levels, portable and nofma; up to 6e-9 in an error where Eigen's products are fused).
set -eu
export LC_ALL=C
cd "$(dirname "$0")/.."
stems='kepler_e090 direct_vs_adaptive method_comparison p_dependence'
if [ $# = 0 ]; then
  for compiler in g++ clang++-14; do
    for level in O3 O2 O0; do set -- "$@" "$compiler-$level-native" "$compiler-$level-portable"; done
  done
fi

# tables CONFIGURATION: builds, runs, prints what was found, each line under the name of its table. Says itself where it
# fails: the shell heeds no -e in a function before ||.
tables() {
  machine=${1##*-} rest=${1%-*} flags= march=-march=native
  case ${rest##*-}-$machine in
  O[0-3]-native) preset=release ;;
  O[0-3]-portable) preset=portable march= ;;
  O[0-3]-nofma) preset=release flags='-mno-fma -mno-avx512f' ;;
  *) echo "levels.sh: configuration is '$1'; it must be like g++-O2-native or clang++-14-O0-portable." >&2; return 2 ;;
  esac
  build=build/levels/$1
  # At -O0 a source with a level of its own cannot read headers precompiled without.
  cmake --preset $preset -B "$build" -DCMAKE_CXX_COMPILER="${rest%-*}" -DAVI_TESTS=OFF \
    -DAVI_PRECOMPILE=OFF -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_CXX_FLAGS_RELEASE="-${rest##*-} -DNDEBUG" >&2 || return
  cmake --build "$build" --target $stems >&2 || return
  for stem in $stems; do
    "$build/bin/$stem" --quick --output "$build/data" || return
    awk -F'\t' -v stem="$stem" '/^#/ { next } !columns { columns = NF; for (i = 1; i <= NF; ++i) skip[i] = $i ~ /seconds/; next }
      { line = stem; for (i = 1; i <= NF; ++i) if (!skip[i]) line = line "\t" $i; print line }' "$build/data/$stem.tsv"
  done
  # Written in hexadecimal: equal or not.
  "${rest%-*}" -std=c++20 -w "-${rest##*-}" $march $flags \
    -ffp-contract=off -fno-math-errno -Ilib -Iexperiments -isystem /usr/include/eigen3 tests/levels/collocation_bits.cpp \
    -o "$build/bin/collocation_bits" "$build/lib/libavi.a" -pthread >&2 || return
  "$build/bin/collocation_bits"
}

# compare FIRST OTHER: files of tables() of the same shape
compare() {
  [ "$(wc -l <"$1")" = "$(wc -l <"$2")" ] && paste "$1" "$2" | awk -F'\t' '
    { n = NF / 2
      for (i = 1; i <= n; ++i) {
        a = $i; b = $(i + n); ++cells
        if (a "" == b "") continue
        number = a ~ /[.e]/ && a ~ /^[-+.0-9e]+$/ && b ~ /^[-+.0-9e]+$/
        away = number && a + 0 != 0 ? (a - b) / a : 1
        if (away < 0) away = -away
        if (away > worst) worst = away
        ++other
        if (away > 2e-8) { print "row " NR ": " a " and " b " in " $1 " " $2 " " $3 " " $4; bad = 1 }
      } }
    END { printf "%d cells, %d of them in other digits, by %.0e at most\n", cells, other, worst; exit bad }'
}

mkdir -p build/levels
first=
for each in "$@"; do
  tables "$each" >"build/levels/$each.tables" 2>"build/levels/$each.log" || { tail -n 20 "build/levels/$each.log" >&2; exit 1; }
  first=${first:-$each}
  echo "$first and $each"
  compare "build/levels/$first.tables" "build/levels/$each.tables" || { echo "levels.sh: $each differs from $first" >&2; exit 1; }
done
