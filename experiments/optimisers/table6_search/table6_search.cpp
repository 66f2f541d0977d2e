#include "bregman/setting.hpp"
#include "common/frame.hpp"
#include "optimisers/table6_search/scan.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <random>

// The search for the settings of HTVI in Table 6, which the source does not print: a grid that is fine enough
// to find planted rows, what it finds for the printed one, and what it finds for rows of the same kind that
// nobody made.

namespace {

using namespace experiment;
using namespace experiment::table6_search;

/// The printed counts as updates: the source counts points.
constexpr Counts printed{2181, 2485, 2749, 3232, 3433, 3592, 4013, 4096, 4565};

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all{{.name = "as printed"},
                                        {.name = "gradient alone", .test = Test::gradient},
                                        {.name = "values alone", .test = Test::value},
                                        {.name = "relative test", .test = Test::relative},
                                        {.name = "Type III", .form = Form::type_3},
                                        {.name = "kick-drift-kick", .form = Form::kick_drift},
                                        {.name = "drift-kick-drift", .form = Form::drift_kick},
                                        {.name = "mirror map of Sigma", .form = Form::mirror, .u_by = 4.0},
                                        {.name = "x0 = 0", .away = -1.0, .u_by = 4.0},
                                        {.name = "t0 < 1: momentum 100", .momentum = 1e2},
                                        {.name = "t0 < 1: momentum 1000", .momentum = 1e3, .u_by = 0.5},
                                        {.name = "temporal looping", .loop = true}};
  return all;
}

/// The counts, a hyphen where the test was not met within the cap.
std::string text(const Counts& counts) {
  std::string all;
  for (const auto count : counts)
    all += fmt::format("{}{}", all.empty() ? "" : " ", count > 0 ? fmt::format("{}", count) : "-");
  return all;
}

/// How many leading cells of a row another one hits.
int leading(const Counts& ours, const Counts& wanted) {
  int hit = 0;
  while (hit < cells && ours[hit] > 0 && std::abs(ours[hit] - wanted[hit]) <= slack)
    ++hit;
  return hit;
}

struct Power {
  int planted = 0, found = 0, confirmed = 0;
};

/// Plants rows: settings at random, their counts from the run itself, then the scan around them, with its
/// grid at an offset that has nothing to do with them. Found is a row with all nine cells; `confirmed` counts
/// the rows that the library's own run_updates() gives with the same settings.
Power power_of(const Spectrum& of, const Variant& variant, const Ranges& ranges, int plants,
               std::mt19937_64& bits) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto between = [&](double low, double high) { return low * std::pow(high / low, uniform(bits)); };
  Power made;
  for (int tries = 0; made.planted < plants && tries < 40 * plants; ++tries) {
    const double u = between(ranges.u_low, ranges.u_high), eta = between(ranges.eta_low, ranges.eta_high),
                 p = between(6.0, 40.0);
    const Counts row = exact_counts(of, variant, p, u, eta);
    if (row.back() == 0) continue;
    ++made.planted;
    Ranges near = ranges;
    near.u_low = u * (1.0 - 3e-4 * uniform(bits)), near.u_high = near.u_low * (1.0 + 4e-4);
    near.eta_low = eta * (1.0 - 0.05 * uniform(bits)), near.eta_high = near.eta_low * 1.06;
    made.found += scan(of, variant, near, {row}).front().with[cells] > 0.0;
    if (&variant != &variants().front()) continue;  // the library has this one only
    const CorrelatedQuartic f;
    Counts again{};
    int cell = 0;
    double before = std::nan("");
    const auto watch = [&](const avi::Iterate& at, long k, long) {
      while (k > 0 && cell < cells && std::abs(at.value - before) < std::pow(10.0, -2 - cell) &&
             avi::norm(at.gradient) < std::pow(10.0, -2 - cell))
        again[cell++] = k;
      before = at.value;
    };
    (void)run_updates({.method = "htvi",
                       .family = avi::BregmanFamily::adaptive(p, p * p * h / eta, (u / eta) * (u / eta)),
                       .h = h},
                      f, f.start(), {.delta = 1e-10, .iterations = 12000}, watch);
    made.confirmed += leading(again, row) == cells;
  }
  return made;
}

/// Runs at settings drawn at random, where one trajectory serves one setting only.
struct Sample {
  double runs = 0;
  int best = 0;  ///< Leading cells.
  Counts counts{};
};

Sample sample(const Spectrum& of, const Variant& variant, int runs, std::mt19937_64& bits) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Ranges whole;
  Sample made;
  for (int run = 0; run < runs; ++run, ++made.runs) {
    const double u = whole.u_low * std::pow(whole.u_high / whole.u_low, uniform(bits)),
                 eta = whole.eta_low * std::pow(whole.eta_high / whole.eta_low, uniform(bits)),
                 p = 6.0 * std::pow(6.0, uniform(bits)), turn = 1.0 + 20.0 * uniform(bits);
    const Counts counts = exact_counts(of, variant, p, u, eta, 5000, std::exp(turn / p));
    if (const int hit = leading(counts, printed); hit > made.best || run == 0)
      made.best = hit, made.counts = counts;
  }
  return made;
}

}  // namespace

int main(int argc, char** argv) {
  bool longer = false;
  std::string only;
  const std::vector<Option> options{{AVI_LONGER, &longer, AVI_LONGER_TEXT},
                                    {"--variant", &only, "Only variants whose name contains this"}};
  return run(argc, argv, AVI_SHOWS, options, [&](Frame& frame) {
    const Spectrum of = spectrum();
    Table& table =
        frame.table({"variant", "u_low", "u_high", "u_ratio", "eta_low", "eta_high", "eta_ratio", "points",
                     "planted", "found", "confirmed", "leading", "leading_by_chance", "u", "eta", "counts"});
    table.note("printed", text(printed));
    table.note("leading", "how many of the first cells the best point hits within 3");
    table.note("leading_by_chance",
               "the most over three rows that are the printed one moved by 37, 71 and 113");
    std::mt19937_64 bits(1);
    double done = 0.0;
    for (const Variant& variant : variants()) {
      if (std::string_view(variant.name).find(only) == std::string_view::npos) continue;
      if (frame.quick && done > 0.0) break;
      frame.progress(variant.name, done++, static_cast<double>(variants().size()));
      Ranges whole;
      whole.u_low *= variant.u_by, whole.u_high *= variant.u_by;
      Ranges ranges = whole;
      if (!longer) {  // a window of u
        ranges.u_low = 6e-4 * variant.u_by, ranges.u_high = (frame.quick ? 6.02e-4 : 6.1e-4) * variant.u_by;
        if (frame.quick) ranges.eta_high = 0.0042;
      }
      const int plants = frame.quick ? 6 : 24;
      if (variant.loop) {
        const Sample made = sample(of, variant, frame.quick ? 50 : longer ? 40000 : 4000, bits);
        table.row(variant.name, whole.u_low, whole.u_high, unknown, whole.eta_low, whole.eta_high, unknown,
                  made.runs, 0, 0, 0, made.best, unknown, unknown, unknown, text(made.counts));
        continue;
      }
      const Power power = power_of(of, variant, whole, plants, bits);
      std::vector<Counts> rows{printed};
      for (const long moved : {37, 71, 113})
        for (long& count : rows.emplace_back(printed))
          count += moved;
      const std::vector<Scan> scans = scan(of, variant, ranges, rows);
      const Scan& found = scans.front();
      int chance = 0;
      for (std::size_t r = 1; r < scans.size(); ++r)
        for (int i = 1; i <= cells; ++i)
          if (scans[r].with[i] > 0.0) chance = std::max(chance, i);
      const Hit& best = found.best;
      const Counts counts = best.leading ? exact_counts(of, variant, 15.0, best.u, best.eta) : Counts{};
      table.row(variant.name, ranges.u_low, ranges.u_high, ranges.u_ratio, ranges.eta_low, ranges.eta_high,
                Ranges::eta_ratio, found.points, power.planted, power.found, power.confirmed, best.leading,
                chance, best.u, best.eta, best.leading ? text(counts) : std::string("-"));
    }
  });
}
