#include "scorecard/numbers/printed.hpp"
#include "scorecard/numbers/sheet.hpp"

#include <fmt/format.h>

namespace scorecard {
namespace {

/// Where the paper counts points instead of updates: by how much its count exceeds ours.
double offset(std::string_view method) {
  if (method == "htvi" || method == "splitting") return 1.0;
  if (method == "adam" || method == "adagrad" || method == "rmsprop" || method == "trust_region") return 2.0;
  return 0.0;
}

/// A count of updates against a printed one.
Judgement compare_updates(const Cell& cell, double ours) {
  const double more = offset(cell.text("method"));
  return compare_count(cell, ours, more,
                       more == 0.0 ? ""
                                   : fmt::format("The source's count is our number of updates + {}.", more));
}

/// The data row with a cell's method, approach, p and p_ring that has `converged` as wanted; the row with the
/// printed h first.
Row row_of(const Cell& cell, const Table& data, std::string_view converged) {
  const std::string p = cell.sibling("p"), h = cell.sibling("h");
  const std::string p_ring = cell.text("approach") == "direct" ? "nan" : cell.sibling("p_ring");
  const Cells run{{"method", cell.text("method")},
                  {"approach", cell.text("approach")},
                  {"p", p},
                  {"p_ring", p_ring},
                  {"converged", converged}};
  for (const Row& row : rows(data, run))
    if (same(row.text("h"), h)) return row;
  return find(data, run);
}

/// The step: the printed one when the run with it converged; else the evidence that another one was meant.
Judgement step(const Cell& cell, const Table& data) {
  const Row run = row_of(cell, data, "1");
  Judgement judgement = compare_setting(cell, run.number("h"));
  if (judgement.verdict == Verdict::exact) return judgement;
  if (Printed(cell.sibling("iterations")).equals(run.number("iterations") + offset(cell.text("method"))))
    judgement.verdict = Verdict::erratum;
  judgement.note = fmt::format(
      "With the printed step the run diverges after {} iterations; with {} its count is the printed one.",
      row_of(cell, data, "0").text("iterations"), rounded(run.number("h")));
  return judgement;
}

/// How many moved starts the data come from: the head says "counts from 16 starts moved by up to 1e-14".
std::string moved_starts(const Table& data) {
  for (const auto& [key, text] : data.head)
    if (key == "perturbed" && text.starts_with("counts from "))
      return text.substr(12, text.find(" starts") - 12) + " starts";
  return "Starts";
}

/// A count is exact, or its row is chaotic: starts moved by 1e-14 give different ones.
Judgement iterations(const Cell& cell, const Table& data) {
  const Row run = row_of(cell, data, "1");
  Judgement judgement = compare_updates(cell, run.number("iterations"));
  const double more = offset(cell.text("method")), printed = Printed(cell.published()).value;
  const double least = run.number("perturbed_least") + more, most = run.number("perturbed_most") + more;
  const double failed = run.number("perturbed_failed");
  judgement.sensitive = least != most || failed != 0.0;
  if (!judgement.sensitive) return judgement;
  if (judgement.verdict != Verdict::exact) judgement.verdict = Verdict::chaotic;
  judgement.note +=
      fmt::format("{}{} moved by 1e-14 give {:.0f} to {:.0f}{}; the printed count lies {} that range.",
                  judgement.note.empty() ? "" : " ", moved_starts(data), least, most,
                  failed > 0.0 ? fmt::format(", and {:.0f} of them diverge", failed) : "",
                  printed >= least && printed <= most ? "inside" : "outside");
  return judgement;
}

/// A cell beyond the cap of the run, which a shorter run neither confirms nor refutes: what the cells before
/// it and the shorter run say.
Judgement beyond_cap(const Cell& cell, const Table& data, const Row& run) {
  const double cap = run.number("iterations");
  const std::string& method = cell.text("method");
  Judgement judgement{.reproduced = fmt::format(">{:.0e}", cap), .verdict = Verdict::short_run, .note = {}};
  if (method == "adagrad") {
    // For a quartic AdaGrad's count grows as delta^(-2/3): the step is rate g / |sum of g^2|^(1/2).
    const auto at = [&](double wider) {
      const double delta = wider * Printed(cell.text("delta")).value;
      return find(data, {{"method", method}, {"delta", fmt::format("{:g}", delta)}});
    };
    const double before = at(10.0).number("iterations"), ratio = before / at(100.0).number("iterations");
    judgement.note = fmt::format("Not run to its end. Our run stops at {:.0e}; as the counts grow by {:.3f} "
                                 "from cell to cell (10^(2/3) = 4.642) the next one would be {:.1e}.",
                                 cap, ratio, before * ratio);
    return judgement;
  }
  judgement.note = fmt::format("Not run to its end. Our run stops at {:.0e}, and the least |grad f| in it is "
                               "{:.2e}, so that a later passage is not excluded.",
                               cap, run.number("least_gradient"));
  if (method == "nag") {
    const Row shifted = find(data, {{"method", "nag_shifted"}, {"delta", cell.text("delta")}});
    if (shifted.text("converged") == "1")
      judgement.note +=
          fmt::format(" In the variable x - 1, where rounding is less, the same method stops after {}.",
                      shifted.text("iterations"));
  }
  return judgement;
}

}  // namespace

Judgement judge_symplectic(const Cell& cell, const Table& data) {
  if (cell.quantity() == "h") return step(cell, data);
  if (cell.quantity() != "iterations") return compare(cell, row_of(cell, data, "1").number(cell.quantity()));
  return iterations(cell, data);
}

Judgement judge_optimisers(const Cell& cell, const Table& data) {
  const Row run = find(data, {{"method", cell.text("method")}, {"delta", cell.text("delta")}});
  const double ours = run.number("iterations");
  Judgement judgement =
      run.text("converged") == "1" ? compare_updates(cell, ours) : beyond_cap(cell, data, run);
  if (cell.text("method") == "htvi" && judgement.verdict != Verdict::exact) {
    judgement.verdict = Verdict::unstated;
    judgement.note = "Not reproduced. p, p_ring and C are not printed; with C = 0.0625 of the other tables "
                     "the printed test gave the row in no run, and whether these, the test or the method "
                     "differ is not known: a search that finds most planted rows finds none for this one. p "
                     "= 15, p_ring = 0.1, C = 0.03 comes within a few per cent.";
  }
  return judgement;
}

}  // namespace scorecard
