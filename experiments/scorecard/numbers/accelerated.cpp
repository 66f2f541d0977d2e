#include "scorecard/numbers/printed.hpp"
#include "scorecard/numbers/sheets.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace scorecard {
namespace {

/// Where the paper counts points instead of updates: by how much its count exceeds ours.
double offset(std::string_view method) {
  if (method == "htvi" || method == "splitting") return 1.0;
  if (method == "adam" || method == "adagrad" || method == "rmsprop" || method == "trust_region") return 2.0;
  return 0.0;
}

std::string convention(std::string_view method) {
  const double more = offset(method);
  return more == 0.0 ? "" : fmt::format("The source's count is our number of updates + {}.", more);
}

/// The data row with a cell's method, approach, p and p_ring that has `converged` as wanted; the row with the
/// printed h first.
std::size_t row_of(const Cell& cell, const experiment::Table& data, std::string_view converged) {
  const std::string p = cell.sibling("p"), h = cell.sibling("h");
  const std::string p_ring = cell.text("approach") == "direct" ? "nan" : cell.sibling("p_ring");
  const auto matching = [&](std::optional<std::string_view> step) {
    if (step)
      return find(data, {{"method", cell.text("method")},
                         {"approach", cell.text("approach")},
                         {"p", p},
                         {"p_ring", p_ring},
                         {"h", *step},
                         {"converged", converged}});
    return find(data, {{"method", cell.text("method")},
                       {"approach", cell.text("approach")},
                       {"p", p},
                       {"p_ring", p_ring},
                       {"converged", converged}});
  };
  try {
    return matching(h);
  } catch (const std::out_of_range&) {
    return matching(std::nullopt);
  }
}

/// The step: the printed one when the run with it converged; else the evidence that another one was meant.
Judgement step(const Cell& cell, const experiment::Table& data) {
  const std::size_t row = row_of(cell, data, "1");
  const double ours = data.number(row, "h"), printed = Printed(cell.published()).value;
  Judgement judgement{.reproduced = beside(cell.published(), ours), .verdict = Verdict::exact, .note = {}};
  if (std::abs(ours - printed) <= 1e-12 * printed) return judgement;
  const std::size_t failed = row_of(cell, data, "0");
  const bool agrees = Printed(cell.sibling("iterations"))
                          .equals(data.number(row, "iterations") + offset(cell.text("method")));
  judgement.verdict = agrees ? Verdict::erratum : Verdict::differs;
  judgement.note =
      fmt::format("With the printed step the run diverges after {} iterations; with {} its count is "
                  "the printed one.",
                  data.text(failed, "iterations"), experiment::rounded(ours));
  return judgement;
}

/// How many moved starts the data come from: the head says "counts from 16 starts moved by up to 1e-14".
std::string moved_starts(const experiment::Table& data) {
  for (const auto& [key, text] : data.head)
    if (key == "perturbed" && text.starts_with("counts from "))
      return text.substr(12, text.find(" starts") - 12) + " starts";
  return "Starts";
}

/// A count is exact, or its row is chaotic: starts moved by 1e-14 give different ones.
Judgement iterations(const Cell& cell, const experiment::Table& data) {
  const std::size_t row = row_of(cell, data, "1");
  const std::string& method = cell.text("method");
  const double more = offset(method), ours = data.number(row, "iterations");
  Judgement judgement = compare(cell, ours + more, convention(method));
  judgement.reproduced = beside(cell.published(), ours);
  const double least = data.number(row, "perturbed_least") + more;
  const double most = data.number(row, "perturbed_most") + more;
  const double failed = data.number(row, "perturbed_failed");
  if (least == most && failed == 0.0) return judgement;
  const double printed = Printed(cell.published()).value;
  std::string range = fmt::format("{} moved by 1e-14 give {:.0f} to {:.0f}", moved_starts(data), least, most);
  if (failed > 0.0) range += fmt::format(", and {:.0f} of them diverge", failed);
  range += fmt::format("; the printed count lies {} that range.",
                       printed >= least && printed <= most ? "inside" : "outside");
  if (judgement.verdict != Verdict::exact) judgement.verdict = Verdict::chaotic;
  judgement.note = judgement.note.empty() ? range : judgement.note + " " + range;
  return judgement;
}

/// The start, its momentum and time and the weight C are not printed: every count rests on those that were
/// found.
Judgement with_recovered_start(Judgement judgement) {
  judgement.recovered = true;
  return judgement;
}

Judgement judge_symplectic(const Cell& cell, const experiment::Table& data) {
  if (cell.quantity() == "h") return step(cell, data);
  if (cell.quantity() == "iterations") return with_recovered_start(iterations(cell, data));
  return compare(cell, data.number(row_of(cell, data, "1"), cell.quantity()));
}

/// A cell beyond the cap of the run: what the cells before it say.
Judgement beyond_cap(const Cell& cell, const experiment::Table& data, std::size_t row) {
  const std::string& method = cell.text("method");
  const double cap = data.number(row, "iterations");
  if (method == "adagrad" && row >= 2) {
    // For a quartic AdaGrad's count grows as delta^(-2/3): the step is rate g / |sum of g^2|^(1/2).
    const double before = data.number(row - 1, "iterations"),
                 ratio = before / data.number(row - 2, "iterations");
    Judgement judgement = compare(cell, before * ratio);
    if (data.text(row - 1, "converged") == "1" && judgement.verdict == Verdict::exact) {
      judgement.verdict = Verdict::within;
      judgement.note =
          fmt::format("Extrapolated: the run is capped at {:.0e}, and the counts grow by {:.3f} from "
                      "cell to cell (10^(2/3) = 4.642); `make long` runs it.",
                      cap, ratio);
    }
    return judgement;
  }
  Judgement judgement{.reproduced = fmt::format(">{:.0e}", cap), .verdict = Verdict::within, .note = {}};
  judgement.note = fmt::format("Not reached within our cap of {:.0e} either (`make long` has none).", cap);
  if (method == "nag") {
    const std::size_t shifted = find(data, {{"method", "nag_shifted"}, {"delta", cell.text("delta")}});
    if (data.text(shifted, "converged") == "1")
      judgement.note +=
          fmt::format(" An artefact of rounding: in the variable x - 1 the same method stops after {}.",
                      data.text(shifted, "iterations"));
  }
  return judgement;
}

Judgement judge_optimisers(const Cell& cell, const experiment::Table& data) {
  const std::string& method = cell.text("method");
  const std::size_t row = find(data, {{"method", method}, {"delta", cell.text("delta")}});
  if (data.text(row, "converged") != "1") return beyond_cap(cell, data, row);
  const double ours = data.number(row, "iterations");
  Judgement judgement = compare(cell, ours + offset(method), convention(method));
  judgement.reproduced = beside(cell.published(), ours);
  if (method == "htvi" && judgement.verdict != Verdict::exact) {
    judgement.verdict = Verdict::unstated;
    judgement.note = "p, p_ring and C of this row are not printed and were not recovered; p = 15, p_ring = "
                     "0.1, C = 0.03 comes "
                     "within a few per cent.";
  }
  return judgement;
}

}  // namespace

Sheet symplectic_sheet(std::string stem, std::string title) {
  return {std::move(stem), std::move(title), judge_symplectic};
}

Sheet optimiser_sheet() {
  return {"optimiser_comparison", "Table 6: optimisers over nine tolerances",
          [](const Cell& cell, const experiment::Table& data) {
            return with_recovered_start(judge_optimisers(cell, data));
          }};
}

}  // namespace scorecard
