#include "scorecard/numbers/printed.hpp"
#include "scorecard/numbers/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace scorecard {
namespace {

bool printed_is(const std::string& published, double ours) {
  return !published.empty() && Printed(published).equals(ours);
}

/// Where a setting is not the printed one, the evidence for a slip is that the other columns of the row come
/// out with ours in every printed digit.
Judgement setting(const Cell& cell, const Row& run) {
  const double ours = run.number(cell.quantity());
  Judgement judgement = compare_setting(cell, ours);
  const bool rest_agrees =
      printed_is(cell.sibling("steps"), run.number("steps") + 1.0) &&
      std::ranges::all_of(
          std::array{"min_step", "max_step", "energy_error", "global_error"},
          [&](const char* quantity) { return printed_is(cell.sibling(quantity), run.number(quantity)); });
  if (judgement.verdict == Verdict::exact || !rest_agrees) return judgement;
  judgement.verdict = Verdict::erratum;
  const char* reason = cell.quantity() == "h"
                           ? "; the printed one gives neither its steps nor its step range."
                       : printed_is(cell.published(), run.number("h") * ours)
                           ? "; the printed value is that bound times h, the bound on the step itself."
                           : ".";
  judgement.note =
      fmt::format("With {} every other measured column of the row comes out in every printed digit{}",
                  rounded(ours), reason);
  return judgement;
}

/// The source counts points; a fixed step it counts as we do.
Judgement steps(const Cell& cell, const Row& run) {
  const Judgement points =
      compare_count(cell, run.number("steps"), 1.0, "The source counts points, one more than our steps.");
  const Judgement plain = compare(cell, run.number("steps"));
  const bool fixed = cell.text("monitor") == "none";
  return plain.verdict == Verdict::exact && (fixed || points.verdict != Verdict::exact) ? plain : points;
}

/// Verlet's published global error takes the state after N - 1 steps against the exact one at N h.
Judgement global_error(const Cell& cell, const Row& run) {
  const double ours = run.number("global_error");
  if (cell.text("method") == "stormer_verlet")
    return compare(cell, run.number("global_error_shifted"),
                   fmt::format("The printed value compares the state after N - 1 steps with the exact one at "
                               "N h; at equal times the error is {:.3E}.",
                               ours));
  Judgement judgement = compare(cell, ours, "", cell.text("monitor") == "none" ? 1.0 : 0.0);
  if (judgement.verdict == Verdict::within)
    judgement.note = "One unit of the last digit: fixed steps do not resolve the pericentre, and the orbit "
                     "after it is sensitive.";
  return judgement;
}

/// Seconds of another machine and language cannot agree; what can be compared is the ratio to Stormer-Verlet.
Judgement seconds(const Cell& cell, const Row& run, const Table& data) {
  Judgement judgement{.reproduced = rounded(run.number("seconds"), 3),
                      .verdict = Verdict::differs,
                      .note = "The unit of the ratios in the rows above."};
  if (cell.text("method") == "stormer_verlet") return judgement;
  const double ours = run.number("seconds") / find(data, {{"method", "stormer_verlet"}}).number("seconds");
  const double printed = Printed(cell.published()).value / Printed(cell.elsewhere("SV", "seconds")).value;
  judgement.note = fmt::format("In units of Stormer-Verlet's time: printed {:.3g}, ours {:.3g}{}.", printed,
                               ours, printed > 1.0 && ours < 1.0 ? ": compiled code reverses the order" : "");
  return judgement;
}

Judgement outcome(const Cell& cell, const Row& run) {
  if (cell.quantity() == "steps") return steps(cell, run);
  if (cell.quantity() == "global_error") return global_error(cell, run);
  return compare(cell, run.number(cell.quantity()));
}

/// True where it takes more than what is printed to get a row's outcome: another setting of the row, for
/// HTVI4 the authors' construction where the printed one does not give the number. What the source does not
/// print at all is in the table of its numbers.
bool recovered(const Cell& cell, const Row& run, const Table& data) {
  for (const char* input : {"h", "g_min", "g_max"})
    if (const std::string printed = cell.sibling(input);
        !printed.empty() && std::abs(run.number(input) / Printed(printed).value - 1.0) > 1e-12)
      return true;
  if (cell.text("method") != "htvi4") return false;
  const auto as_printed =
      rows(data, {{"method", "htvi4"}, {"construction", "printed"}, {"monitor", cell.text("monitor")}});
  return as_printed.empty() || outcome(cell, as_printed.front()).verdict != Verdict::exact;
}

}  // namespace

Judgement judge_kepler(const Cell& cell, const Table& data) {
  // Of HTVI4's constructions the authors' own reproduces the paper.
  const Row run = find(data, {{"method", cell.text("method")},
                              {"construction", cell.text("method") == "htvi4" ? "authors" : "nan"},
                              {"monitor", cell.text("monitor")}});
  const std::string& quantity = cell.quantity();
  if (quantity == "h" || quantity == "g_min" || quantity == "g_max") return setting(cell, run);
  if (quantity == "seconds") return seconds(cell, run, data);
  Judgement judgement = outcome(cell, run);
  judgement.recovered = recovered(cell, run, data);
  return judgement;
}

}  // namespace scorecard
