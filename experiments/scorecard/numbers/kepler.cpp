#include "scorecard/numbers/printed.hpp"
#include "scorecard/numbers/sheets.hpp"

#include <fmt/format.h>

#include <cmath>

namespace scorecard {
namespace {

/// The data row that reproduces a row of the paper: for HTVI4 the authors' own construction.
std::size_t row_of(const Cell& cell, const experiment::Table& data) {
  const std::string_view construction = cell.text("method") == "htvi4" ? "authors" : "nan";
  return find(
      data,
      {{"method", cell.text("method")}, {"construction", construction}, {"monitor", cell.text("monitor")}});
}

bool printed_is(const std::string& published, double ours) {
  return !published.empty() && Printed(published).equals(ours);
}

/// A setting is what the run was made with, so it is the printed number or it is another one; rounding does
/// not come in. Where it is not the printed one, the evidence for a slip is that the other columns of the row
/// come out with ours in every printed digit.
Judgement setting(const Cell& cell, const experiment::Table& data, std::size_t row) {
  const double ours = data.number(row, cell.quantity()), printed = Printed(cell.published()).value;
  Judgement judgement{.reproduced = beside(cell.published(), ours), .verdict = Verdict::exact, .note = {}};
  if (std::abs(ours - printed) <= 1e-12 * printed) return judgement;
  judgement.verdict = Verdict::differs;
  const bool rest_agrees = printed_is(cell.sibling("min_step"), data.number(row, "min_step")) &&
                           printed_is(cell.sibling("max_step"), data.number(row, "max_step")) &&
                           printed_is(cell.sibling("steps"), data.number(row, "steps") + 1.0) &&
                           printed_is(cell.sibling("energy_error"), data.number(row, "energy_error")) &&
                           printed_is(cell.sibling("global_error"), data.number(row, "global_error"));
  if (!rest_agrees) return judgement;
  judgement.verdict = Verdict::erratum;
  judgement.note =
      fmt::format("With {} every other measured column of the row comes out in every printed digit",
                  experiment::rounded(ours));
  const double h = data.number(row, "h");
  if (cell.quantity() == "h")
    judgement.note += "; the printed one gives neither its steps nor its step range.";
  else if (printed_is(cell.published(), h * data.number(row, cell.quantity())))
    judgement.note += "; the printed value is that bound times h, the bound on the step itself.";
  else
    judgement.note += ".";
  return judgement;
}

Judgement steps(const Cell& cell, const experiment::Table& data, std::size_t row) {
  const double ours = data.number(row, "steps");
  Judgement points = compare(cell, ours + 1.0, "The source counts points, one more than our steps.");
  const bool count_points = cell.text("monitor") != "none" && points.verdict == Verdict::exact;
  Judgement plain = compare(cell, ours);
  if (count_points || plain.verdict != Verdict::exact) {
    points.reproduced = beside(cell.published(), ours);
    return points;
  }
  return plain;
}

/// Verlet's published global error takes the state after N - 1 steps against the exact one at N h.
Judgement global_error(const Cell& cell, const experiment::Table& data, std::size_t row) {
  if (cell.text("method") == "stormer_verlet") {
    const double equal_times = data.number(row, "global_error");
    return compare(
        cell, data.number(row, "global_error_shifted"),
        fmt::format("The printed value compares the state after N - 1 steps with the exact one at N h; "
                    "at equal times the error is {:.3E}.",
                    equal_times));
  }
  Judgement judgement =
      compare(cell, data.number(row, "global_error"), "", cell.text("monitor") == "none" ? 1.0 : 0.0);
  if (judgement.verdict == Verdict::within)
    judgement.note =
        "One unit of the last digit: fixed steps do not resolve the pericentre, and the orbit after it "
        "is sensitive.";
  return judgement;
}

/// Seconds of another machine and language cannot agree; what can be compared is the ratio to Stormer-Verlet.
Judgement seconds(const Cell& cell, const experiment::Table& data, std::size_t row) {
  const double ours = data.number(row, "seconds");
  Judgement judgement{.reproduced = experiment::rounded(ours, 3),
                      .verdict = Verdict::differs,
                      .note = "The unit of the ratios in the rows above."};
  if (cell.text("method") == "stormer_verlet") return judgement;
  const double verlet = data.number(find(data, {{"method", "stormer_verlet"}}), "seconds");
  const double printed = Printed(cell.published()).value / Printed(cell.elsewhere("SV", "seconds")).value;
  const double measured = ours / verlet;
  judgement.note =
      fmt::format("In units of Stormer-Verlet's time: printed {:.3g}, ours {:.3g}{}.", printed, measured,
                  printed > 1.0 && measured < 1.0 ? ": compiled code reverses the order" : "");
  return judgement;
}

Judgement outcome(const Cell& cell, const experiment::Table& data, std::size_t row) {
  if (cell.quantity() == "steps") return steps(cell, data, row);
  if (cell.quantity() == "global_error") return global_error(cell, data, row);
  return compare(cell, data.number(row, cell.quantity()));
}

/// Whether it takes more than what is printed to get a row's outcome: another setting of the row, for HTVI4
/// the authors' construction where the printed one does not give the number, for Verlet's global error the
/// shift in time.
bool recovered(const Cell& cell, const experiment::Table& data, std::size_t row) {
  for (const char* input : {"h", "g_min", "g_max"})
    if (const std::string printed = cell.sibling(input);
        !printed.empty() && std::abs(data.number(row, input) / Printed(printed).value - 1.0) > 1e-12)
      return true;
  if (cell.text("method") != "htvi4") return cell.quantity() == "global_error";
  try {
    const std::size_t as_printed =
        find(data, {{"method", "htvi4"}, {"construction", "printed"}, {"monitor", cell.text("monitor")}});
    return outcome(cell, data, as_printed).verdict != Verdict::exact;
  } catch (const std::out_of_range&) {
    return true;
  }
}

Judgement judge_kepler(const Cell& cell, const experiment::Table& data) {
  const std::size_t row = row_of(cell, data);
  const std::string& quantity = cell.quantity();
  if (quantity == "h" || quantity == "g_min" || quantity == "g_max") return setting(cell, data, row);
  if (quantity == "seconds") return seconds(cell, data, row);
  Judgement judgement = outcome(cell, data, row);
  judgement.recovered = recovered(cell, data, row);
  return judgement;
}

}  // namespace

Sheet kepler_sheet(std::string stem, std::string title) {
  return {std::move(stem), std::move(title), judge_kepler};
}

}  // namespace scorecard
