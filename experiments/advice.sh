#!/bin/sh
# The README's table "Which method when", from the work_precision_advice.tsv in a folder: experiments/advice.sh build/data
set -e
awk -F'\t' '
  function number(x) { return x == "nan" ? "–" : sprintf("%.2g", x) }
  function other(name, cost) { return name == "none" ? "–" : "`" name "` " number(cost) }
  /^#/ { next }
  !head { for (i = 1; i <= NF; ++i) at[$i] = i; head = 1
          print "| problem | error | cheapest here | cost | best HTVI | best of other libraries |"
          print "| --- | --- | --- | --- | --- | --- |"; next }
  $at["method"] == "none" || $at["target"] + 0 == 1e-5 || $at["target"] + 0 == 1e-9 { next }
  {
    e = $at["eccentricity"]; p = $at["problem"]; h = $at["horizon"]
    name = p == "kepler" ? "Kepler" : p == "perturbed_kepler" ? "Kepler with quadrupole" : \
           p == "henon_heiles" ? "Hénon–Heiles" : "figure-eight orbit"
    if (e != "nan") name = name sprintf(", e = %g", e)
    name = name ", " (h ~ /^[0-9]+$/ ? "T = " h : h)
    printf "| %s | %.0e | %s | %s | %s |\n", name, $at["target"], other($at["method"], $at["cost"]),
      other($at["htvi"], $at["htvi_cost"]), other($at["peer"], $at["peer_cost"])
  }' "$1/work_precision_advice.tsv" | sed 's/^\(| [^|]*| [^|]*|\) `\([^`]*\)` \([^|]*\)|/\1 `\2` | \3|/'
