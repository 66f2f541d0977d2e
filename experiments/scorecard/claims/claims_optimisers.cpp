#include "scorecard/claims/claims.hpp"

#include <algorithm>

// Claims of Sections 4.5.4 and 4.5.5: against Runge-Kutta methods and other optimisers.

namespace scorecard {
namespace {

/// The runs of a method in one approach. MATLAB's two solvers are dormand_prince and bogacki_shampine.
std::vector<Row> baselines(const Results& data, std::string_view method, std::string_view approach) {
  return data.rows("runge_kutta_baselines", {{"method", method}, {"approach", approach}});
}

/// Iterations until the stopping test holds for good, and the gradients of that many.
double sustained(const Row& run) { return run.number("sustained"); }
double sustained_gradients(const Row& run) {
  return run.number("gradient_evaluations") / run.number("iterations") * sustained(run);
}

/// Converged is what the stopping test says from some iteration on; at a first passage alone it is not.
Finding rk4_fails(const Results& data) {
  Cases cases;
  std::vector<std::string> seen;
  for (const auto& [approach, shown] : {std::pair{"direct", "Direct"}, {"adaptive", "Adaptive"}}) {
    std::string converged;
    for (const Row& run : baselines(data, "runge_kutta_4", approach))
      if (std::isfinite(sustained(run)))
        converged = fmt::format("{} at h = {} from step {} on", shown, rounded(run.number("h"), 3),
                                run.text("sustained"));
    cases.add(converged.empty());
    if (!converged.empty()) seen.push_back(converged);
  }
  return {in_cases(cases), seen.empty() ? "At no step that was tried."
                                        : fmt::format("The test for delta = 1e-10 holds for good: {}.",
                                                      fmt::join(seen, ", "))};
}

/// Steps or gradients of every run of MATLAB's two pairs that converged for good, over those of HTVI in the
/// same approach.
Cases against_pairs(const Results& data, double (*cost)(const Row&), const char* approach) {
  Cases cases;
  for (const char* method : {"dormand_prince", "bogacki_shampine"})
    for (const Row& run : baselines(data, method, approach)) {
      const double ratio = cost(run) / cost(baselines(data, "htvi", approach).at(0));
      if (!std::isnan(ratio)) cases.add(ratio > 1.0, ratio);
    }
  return cases;
}

Finding fewer_iterations(const Results& data) {
  const Cases direct = against_pairs(data, sustained, "direct"),
              adaptive = against_pairs(data, sustained, "adaptive");
  const Row pair = find(data("runge_kutta_baselines"),
                        {{"method", "dormand_prince"}, {"approach", "direct"}, {"rtol", "0.001"}});
  return finding(in_cases(direct + adaptive),
                 "Against the Dormand-Prince and the Bogacki-Shampine pair over five tolerances, where they "
                 "converge for good: in {} of {} runs of the Direct approach and {} of {} of the Adaptive "
                 "one. At ode45's default, 1e-3, Dormand-Prince, Direct, takes {:.0f} steps where HTVI takes "
                 "{:.0f}; the source names no tolerance.",
                 direct.holding, direct.all, adaptive.holding, adaptive.all, sustained(pair),
                 sustained(baselines(data, "htvi", "direct").at(0)));
}

Finding fewer_gradients(const Results& data) {
  const Cases direct = against_pairs(data, sustained_gradients, "direct"),
              adaptive = against_pairs(data, sustained_gradients, "adaptive");
  return finding(in_cases(direct + adaptive),
                 "In the same runs: {} of {} Direct, where the least is {:.2f} times HTVI's, and {} of {} "
                 "Adaptive, where the least is {:.2f} times.",
                 direct.holding, direct.all, direct.least, adaptive.holding, adaptive.all, adaptive.least);
}

Finding pairs_gain_nothing(const Results& data) {
  // Iterations of the Direct approach over those of the Adaptive one.
  const auto gain = [&](std::string_view method, std::string_view rtol) {
    const auto of = [&](std::string_view approach) {
      return data.number("runge_kutta_baselines",
                         {{"method", method}, {"approach", approach}, {"rtol", rtol}}, "sustained");
    };
    return of("direct") / of("adaptive");
  };
  Cases cases;
  for (const char* method : {"dormand_prince", "bogacki_shampine"})
    for (const Row& run : baselines(data, method, "direct"))
      if (const double ratio = gain(method, run.text("rtol"));
          run.number("rtol") < 5e-3 && !std::isnan(ratio))
        cases.add(ratio < 1.2, ratio);
  const double of_htvi = gain("htvi", "nan");
  return finding(of_htvi > 1.5 ? in_cases(cases) : Ruling::fails,
                 "Direct takes {:.2f} to {:.2f} times the steps of Adaptive for the pairs at relative "
                 "tolerances of 1e-3 and less, {:.2f} times for HTVI.",
                 cases.least, cases.most, of_htvi);
}

/// Where an envelope falls like an exponential of the iterations, a tenth of the run brings a tenth of its
/// decades; a slow start brings clearly less.
Finding slow_start(const Results& data) {
  Cases slow, even;
  std::vector<std::string> seen;
  for (const auto& [method, shown] : {std::pair{"htvi", "HTVI"}, {"dormand_prince", "Dormand-Prince"}}) {
    const auto curve =
        data.rows("runge_kutta_baselines_curves", {{"method", method}, {"approach", "adaptive"}});
    if (curve.empty()) continue;
    const auto tenth = std::ranges::find_if(curve, [&](const Row& at) {
      return at.number("iteration") >= 0.1 * curve.back().number("iteration");
    });
    const double first = curve.front().number("ahead");
    const double share =
        std::log(first / tenth->number("ahead")) / std::log(first / curve.back().number("ahead"));
    slow.add(share < 0.05);
    even.add(share >= 0.1);
    seen.push_back(fmt::format("{:.0f} % of its decades for {}", 100.0 * share, shown));
  }
  return finding(in_cases(slow) == Ruling::holds   ? Ruling::holds
                 : in_cases(even) == Ruling::holds ? Ruling::fails
                                                   : Ruling::undecided,
                 "In the first tenth of the iterations of the Adaptive runs the envelope of f falls through "
                 "{}; an even fall would be 10 %, and the source gives no measure of a start.",
                 fmt::join(seen, ", "));
}

// ---- Table S6 ----

/// Iterations to the first passage; infinite where the run did not converge.
double count(const Results& data, const char* method, const char* delta) {
  const Row run = find(data("optimiser_comparison"), {{"method", method}, {"delta", delta}});
  return run.text("converged") == "1" ? run.number("iterations") : HUGE_VAL;
}

/// HTVI's row there is not reproduced, and its settings in our data were chosen to come near it: to judge by
/// them would be circular. Tables 3 and 5 have runs of Adaptive HTVI on the same objective, from the same
/// start, to the tightest of the tolerances, with p, p_ring and h as printed. The least count of these is the
/// rival.
double reproduced_htvi(const Results& data) {
  double least = HUGE_VAL;
  for (const char* stem : {"direct_vs_adaptive", "p_dependence"})
    for (const Row& run : data.rows(stem, {{"method", "htvi"}, {"approach", "adaptive"}, {"converged", "1"}}))
      least = std::min(least, run.number("iterations"));
  if (!std::isfinite(least)) throw std::out_of_range("The data hold no Adaptive run of HTVI.");
  return least;
}

Finding beats(const Results& data) {
  const double ours = reproduced_htvi(data);
  Cases cases;
  std::vector<std::string> seen;
  for (const auto& [method, shown] : {std::pair{"nag", "NAG"}, {"adam", "ADAM"}, {"adagrad", "AdaGrad"}}) {
    const double theirs = count(data, method, "1e-10");
    cases.add(theirs > 1.5 * ours);
    seen.push_back(std::isfinite(theirs) ? fmt::format("{} takes {:.0f}", shown, theirs)
                                         : fmt::format("{} does not stop within our cap", shown));
  }
  return finding(
      in_cases(cases),
      "HTVI's row of S6 is not reproduced, and ours is a fit, so neither is used. At delta = 1e-10 the best "
      "of the runs of S3 and S5, whose steps are printed, takes {:.0f} iterations to the first passage; {} "
      "in our runs. Their rates are those of S6, ADAM's the default: no tuned rivals.",
      ours, fmt::join(seen, ", "));
}

Finding not_the_best(const Results& data) {
  const double ours = reproduced_htvi(data), rmsprop = count(data, "rmsprop", "1e-10"),
               trust = count(data, "trust_region", "1e-10");
  Cases cases;
  cases.add(std::min(rmsprop, trust) < ours);
  return finding(in_cases(cases),
                 "To the first passage at delta = 1e-10 RMSprop takes {:.0f} and TRUST {:.0f} iterations, "
                 "where the best run of HTVI in S3 and S5 takes {:.0f}.",
                 rmsprop, trust, ours);
}

Finding gradients_equal_iterations(const Results& data) {
  Cases cases;
  std::vector<std::string> others;
  for (const auto& [method, shown] : {std::pair{"htvi", "HTVI"},
                                      {"nag", "NAG"},
                                      {"adam", "ADAM"},
                                      {"adagrad", "AdaGrad"},
                                      {"rmsprop", "RMSprop"},
                                      {"trust_region", "TRUST"}}) {
    const Row run = find(data("optimiser_comparison"), {{"method", method}, {"delta", "0.01"}});
    const double n = run.number("iterations"), gradients = run.number("gradient_evaluations");
    cases.add(gradients <= n + 1.0);
    if (gradients > n + 1.0)
      others.push_back(fmt::format("{}, {:.0f} gradients for {:.0f}", shown, gradients, n));
  }
  return finding(in_cases(cases),
                 "But for {} iterations: the stopping test needs a gradient at x, the step one at y.",
                 fmt::join(others, ", "));
}

Finding nag_never(const Results& data) {
  const double plain = count(data, "nag", "1e-10"), shifted = count(data, "nag_shifted", "1e-10");
  if (std::isfinite(plain)) return finding(Ruling::fails, "It takes {:.0f} iterations.", plain);
  const Row run = find(data("optimiser_comparison"), {{"method", "nag"}, {"delta", "1e-10"}});
  const double made = run.number("iterations");
  return finding(made < 1e10 ? Ruling::undecided : Ruling::holds,
                 "Not reached in our {:.0e} iterations, in which the least |grad f| is {:.2e}: too short a "
                 "run to say. Written in the variable x - 1, where rounding is less, the same method {}.",
                 made, run.number("least_gradient"),
                 std::isfinite(shifted) ? fmt::format("stops after {:.0f}", shifted)
                                        : "does not stop either");
}

}  // namespace

Decisions optimiser_decisions() {
  return {{"rk4_fails", rk4_fails},
          {"fewer_iterations_than_pairs", fewer_iterations},
          {"fewer_gradients_than_pairs", fewer_gradients},
          {"pairs_gain_nothing", pairs_gain_nothing},
          {"slow_start", slow_start},
          {"beats_popular_methods", beats},
          {"not_the_most_efficient", not_the_best},
          {"gradients_equal_iterations", gradients_equal_iterations},
          {"nag_never_reaches", nag_never}};
}

}  // namespace scorecard
