#include "scorecard/claims/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// Claims of Sections 4.5.4 and 4.5.5: against Runge-Kutta methods and other optimisers.

namespace scorecard {
namespace {

constexpr std::array approaches{"direct", "adaptive"};
/// MATLAB's two solvers are these pairs.
constexpr std::array pair_methods{"dormand_prince", "bogacki_shampine"};

/// Converged is what the stopping test says from some iteration on; at a first passage alone it is not.
Finding rk4_fails(const Results& data) {
  const experiment::Table& table = data("runge_kutta_baselines");
  std::size_t failing = 0;
  std::string seen;
  for (const char* approach : approaches) {
    std::string converged;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      if (table.text(i, "method") == "runge_kutta_4" && table.text(i, "approach") == approach &&
          std::isfinite(table.number(i, "sustained")))
        converged = fmt::format("h = {} from step {} on", experiment::rounded(table.number(i, "h"), 3),
                                table.text(i, "sustained"));
    failing += converged.empty();
    if (!converged.empty())
      seen += fmt::format("{}{} at {}", seen.empty() ? "" : ", ",
                          std::string_view(approach) == "direct" ? "Direct" : "Adaptive", converged);
  }
  return {in_cases(failing, approaches.size()),
          seen.empty() ? "At no step that was tried."
                       : "The test for delta = 1e-10 holds for good: " + seen + "."};
}

/// Iterations until the stopping test holds for good, and the gradients of that many.
double sustained(const experiment::Table& table, std::size_t row) { return table.number(row, "sustained"); }
double sustained_gradients(const experiment::Table& table, std::size_t row) {
  return table.number(row, "gradient_evaluations") / table.number(row, "iterations") * sustained(table, row);
}

/// Calls visit(pair's row, HTVI's row) for every run of an embedded pair that converged for good.
template <class Visit>
std::size_t against_pairs(const experiment::Table& table, Visit visit) {
  std::size_t cases = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (std::ranges::find(pair_methods, table.text(i, "method")) == pair_methods.end() ||
        std::isnan(sustained(table, i)))
      continue;
    ++cases;
    visit(i, find(table, {{"method", "htvi"}, {"approach", table.text(i, "approach")}}));
  }
  return cases;
}

Finding fewer_iterations(const Results& data) {
  const experiment::Table& table = data("runge_kutta_baselines");
  std::size_t holding = 0;
  const auto cases = against_pairs(table, [&](std::size_t i, std::size_t htvi) {
    holding += sustained(table, htvi) < sustained(table, i);
  });
  const auto at = [&](std::initializer_list<std::pair<std::string_view, std::string_view>> where) {
    return sustained(table, find(table, where));
  };
  return {in_cases(holding, cases),
          fmt::format(
              "In {} of {} runs of the pairs over tolerances. At ode45's default, 1e-3, Dormand-Prince takes "
              "{:.0f} steps where HTVI takes {:.0f}; the source names no tolerance.",
              holding, cases, at({{"method", "dormand_prince"}, {"approach", "direct"}, {"rtol", "0.001"}}),
              at({{"method", "htvi"}, {"approach", "direct"}}))};
}

Finding fewer_gradients(const Results& data) {
  const experiment::Table& table = data("runge_kutta_baselines");
  std::size_t holding = 0;
  double least = 1e99;
  const auto cases = against_pairs(table, [&](std::size_t i, std::size_t htvi) {
    const double ratio = sustained_gradients(table, i) / sustained_gradients(table, htvi);
    holding += ratio > 1.0;
    least = std::min(least, ratio);
  });
  return {in_cases(holding, cases),
          fmt::format("In {} of {} runs; the least is {:.2f} times HTVI's.", holding, cases, least)};
}

Finding pairs_gain_nothing(const Results& data) {
  const experiment::Table& table = data("runge_kutta_baselines");
  std::size_t holding = 0, cases = 0;
  double least = 1e99, most = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (std::ranges::find(pair_methods, table.text(i, "method")) == pair_methods.end() ||
        table.text(i, "approach") != "direct" || table.number(i, "rtol") > 5e-3)
      continue;
    const double ratio =
        sustained(table, i) / sustained(table, find(table, {{"method", table.text(i, "method")},
                                                            {"approach", "adaptive"},
                                                            {"rtol", table.text(i, "rtol")}}));
    if (std::isnan(ratio)) continue;
    ++cases;
    holding += ratio < 1.2;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  const double gain = sustained(table, find(table, {{"method", "htvi"}, {"approach", "direct"}})) /
                      sustained(table, find(table, {{"method", "htvi"}, {"approach", "adaptive"}}));
  return {gain > 1.5 ? in_cases(holding, cases) : Ruling::fails,
          fmt::format("Direct takes {:.2f} to {:.2f} times the steps of Adaptive for the pairs at relative "
                      "tolerances of 1e-3 and less, {:.2f} times for HTVI.",
                      least, most, gain)};
}

/// Where an envelope falls like an exponential of the iterations, a tenth of the run brings a tenth of its
/// decades; a slow start brings clearly less.
Finding slow_start(const Results& data) {
  const experiment::Table& curves = data("runge_kutta_baselines_curves");
  std::size_t slow = 0, even = 0, cases = 0;
  std::string seen;
  for (const char* method : {"htvi", "dormand_prince"}) {
    double first = 0.0, last = 0.0, end = 0.0, tenth = 0.0;
    for (const bool second_pass : {false, true})
      for (std::size_t i = 0; i < curves.rows.size(); ++i) {
        if (curves.text(i, "method") != method || curves.text(i, "approach") != "adaptive") continue;
        const double ahead = curves.number(i, "ahead"), k = curves.number(i, "iteration");
        if (!second_pass) {
          if (first == 0.0) first = ahead;
          last = ahead, end = k;
        } else if (tenth == 0.0 && k >= 0.1 * end) {
          tenth = ahead;
        }
      }
    const double share = std::log(first / tenth) / std::log(first / last);
    ++cases;
    slow += share < 0.05;
    even += share >= 0.1;
    seen += fmt::format("{}{:.0f} % of its decades for {}", seen.empty() ? "" : ", ", 100.0 * share,
                        std::string_view(method) == "htvi" ? "HTVI" : "Dormand-Prince");
  }
  return {slow == cases   ? Ruling::holds
          : even == cases ? Ruling::fails
                          : Ruling::undecided,
          "In the first tenth of the iterations the envelope of f falls through " + seen +
              "; an even fall would be 10 %, and the source gives no measure of a start."};
}

// ---- Table 6 ----

double count(const Results& data, const char* method, const char* delta) {
  const experiment::Table& table = data("optimiser_comparison");
  const std::size_t row = find(table, {{"method", method}, {"delta", delta}});
  return table.text(row, "converged") == "1" ? table.number(row, "iterations") : 1e99;
}
constexpr std::array deltas{"0.01", "1e-4", "1e-6", "1e-8", "1e-10"};

Finding beats(const Results& data) {
  std::size_t holding = 0, cases = 0;
  for (const char* method : {"nag", "adam", "adagrad"})
    for (const char* delta : deltas) {
      ++cases;
      holding += count(data, method, delta) > 1.5 * count(data, "htvi", delta);
    }
  return {in_cases(holding, cases),
          fmt::format("To the first passage NAG, ADAM and AdaGrad take {:.1f}, {:.0f} and {:.0f} times as "
                      "many iterations at "
                      "delta = 1e-2, and the gap grows for NAG and AdaGrad.",
                      count(data, "nag", "0.01") / count(data, "htvi", "0.01"),
                      count(data, "adam", "0.01") / count(data, "htvi", "0.01"),
                      count(data, "adagrad", "0.01") / count(data, "htvi", "0.01"))};
}

Finding not_the_best(const Results& data) {
  std::size_t holding = 0;
  for (const char* delta : deltas)
    holding += std::min(count(data, "rmsprop", delta), count(data, "trust_region", delta)) <
               count(data, "htvi", delta);
  return {in_cases(holding, deltas.size()),
          fmt::format("To the first passage at delta = 1e-10 RMSprop takes {:.0f} and TRUST {:.0f} "
                      "iterations where HTVI takes "
                      "{:.0f}.",
                      count(data, "rmsprop", "1e-10"), count(data, "trust_region", "1e-10"),
                      count(data, "htvi", "1e-10"))};
}

Finding gradients_equal_iterations(const Results& data) {
  const experiment::Table& table = data("optimiser_comparison");
  std::size_t holding = 0, cases = 0;
  std::string others;
  for (const char* method : {"htvi", "nag", "adam", "adagrad", "rmsprop", "trust_region"}) {
    const std::size_t row = find(table, {{"method", method}, {"delta", "0.01"}});
    const double n = table.number(row, "iterations"), gradients = table.number(row, "gradient_evaluations");
    ++cases;
    if (gradients <= n + 1.0)
      ++holding;
    else
      others += fmt::format("{}{}, {:.0f} gradients for {:.0f}", others.empty() ? "" : ", ",
                            std::string_view(method) == "nag" ? "NAG" : method, gradients, n);
  }
  return {in_cases(holding, cases),
          "But for " + others + " iterations: the stopping test needs a gradient at x, the step one at y."};
}

Finding nag_never(const Results& data) {
  const double plain = count(data, "nag", "1e-10"), shifted = count(data, "nag_shifted", "1e-10");
  if (plain < 1e98) return {Ruling::fails, fmt::format("It takes {:.0f} iterations.", plain)};
  return {
      shifted < 1e98 ? Ruling::in_part : Ruling::holds,
      fmt::format("As printed, by rounding: written in the variable x - 1 the same method stops after {:.0f} "
                  "iterations.",
                  shifted)};
}

}  // namespace

const Decisions& optimiser_decisions() {
  static const Decisions decisions{{"rk4_fails", rk4_fails},
                                   {"fewer_iterations_than_pairs", fewer_iterations},
                                   {"fewer_gradients_than_pairs", fewer_gradients},
                                   {"pairs_gain_nothing", pairs_gain_nothing},
                                   {"slow_start", slow_start},
                                   {"beats_popular_methods", beats},
                                   {"not_the_most_efficient", not_the_best},
                                   {"gradients_equal_iterations", gradients_equal_iterations},
                                   {"nag_never_reaches", nag_never}};
  return decisions;
}

}  // namespace scorecard
