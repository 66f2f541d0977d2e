#!/bin/sh
# The table of lib/docs/methods.md, "Which method when", from the work_precision_advice.tsv in a folder:
# advice.sh build/full
set -e
awk -F'\t' '
  function number(x) { return x == "nan" ? "–" : sprintf("%.2g", x) }
  function other(name, cost) { return name == "none" ? "–" : "`" name "` " number(cost) }
  /^#/ { next }
  !head { for (i = 1; i <= NF; ++i) at[$i] = i; head = 1
          print "| problem | error | cheapest here | cost | best collocation | best HTVI | best of other libraries |"
          print "| --- | --- | --- | --- | --- | --- | --- |"; next }
  $at["method"] == "none" || $at["target"] + 0 == 1e-5 || $at["target"] + 0 == 1e-9 { next }
  {
    e = $at["eccentricity"]; p = $at["problem"]; h = $at["horizon"]
    name = p == "kepler" ? "Kepler" : p == "perturbed_kepler" ? "Kepler with quadrupole" : \
           p == "henon_heiles" ? "Hénon–Heiles" : p == "star_cluster" ? "seven bodies" : \
           p == "chain64" ? "chain of 64" : p == "double_pendulum" ? "double pendulum" : \
           p == "solar_system" ? "outer Solar System" : "figure-eight orbit"
    if (e != "nan") name = name sprintf(", e = %g", e)
    name = name ", " (h ~ /^[0-9]+$/ ? "T = " h : h)
    printf "| %s | %.0e | %s | %s | %s | %s |\n", name, $at["target"], other($at["method"], $at["cost"]),
      other($at["collocation"], $at["collocation_cost"]), other($at["htvi"], $at["htvi_cost"]), other($at["peer"], $at["peer_cost"])
  }' "$1/work_precision_advice.tsv" | sed 's/^\(| [^|]*| [^|]*|\) `\([^`]*\)` \([^|]*\)|/\1 `\2` | \3|/'
