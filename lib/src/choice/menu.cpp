#include "src/choice/menu.hpp"

#include "avi/core/require.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

/// @file
/// The candidates for an orbit, and the steps that their runs begin with.

namespace avi::detail {

void Menu::write(Choice& choice) {
  const double energy = known_.trip->energy_at_start;
  all = candidates(question_, energy, *known_.sketch, *known_.bends, known_.radians, known_.resting,
                   known_.metric, choice, known_.field.operations());
  if (const std::string& wanted = question_.options.monitor.name; !wanted.empty()) {
    take_the_named(wanted, choice);
  } else {
    for (Candidate& it : all)
      it.aside = it.noise * known_.radians > std::max(0.3 * question_.tolerance, 3e-15 * known_.radians);
    std::stable_partition(all.begin(), all.end(), [](const Candidate& it) { return !it.aside; });
  }
  for (Candidate& it : all) {
    it.supplied = question_.gradient, it.recording = known_.field.recording(),
    it.switches = question_.switches, it.kinks = question_.kinks;
    it.brief =
        known_.radians < 8.0 && known_.parts != Parts::coupled;  // machine code pays off after some 90 sweeps
  }
  aim_ = std::max(question_.tolerance / std::max(known_.radians, 1.0), 1e-16);
  // Order 8 is for runs of few steps whose sweeps contract well: there order 16 takes up to a tenth more
  // time. Over ten turns at tolerances 1e-2 and 1e-3, order 16 takes a tenth to a seventh less (means over
  // twenty problems).
  const bool brief = known_.radians < 20.0 && aim_ > 2e-6 && known_.parts != Parts::coupled;
  order_ = question_.options.order > 0 ? question_.options.order : brief ? 8 : 16;
  offer_splitting();
  if (question_.prepared)
    for (Candidate& it : all)
      it.take(question_.prepared->formulas_at(energy, choice.kinetic));
}

/// Leaves only the requested monitor in the menu. @throws std::invalid_argument if that monitor has no
/// meaning for this H
void Menu::take_the_named(const std::string& wanted, const Choice& choice) {
  const double energy = known_.trip->energy_at_start;
  const std::string_view kept = wanted == splitting ? "fixed" : std::string_view(wanted);
  std::erase_if(all, [&](const Candidate& it) { return it.name != kept; });
  if (question_.given >= 0) {
    Candidate own = candidate_of(wanted, question_, energy, choice, question_.prepared.get());
    const auto require_good = [&](const std::string& where, double g) {
      require(std::isfinite(g) && g > 0.0, "The given monitor " + where, g, "finite and positive");
    };
    require_good("at the start", own.rate_at(known_.trip->start));
    double t = question_.t;
    for (const Sketch::Sample& sample : known_.sketch->samples) {
      if (all.empty()) require_good(joined({"near t = ", t}), own.rate_at(sample.z.data()));
      t += known_.sense * sample.h;
    }
  }
  if (!all.empty()) return;
  if (wanted == "poles" && choice.poles.empty())
    throw std::invalid_argument("Monitor poles has no meaning here: H divides by no function of q alone, "
                                "nor takes its logarithm, nor bends within a short length; take monitor "
                                "fixed.");
  if (!(choice.kinetic > 0.0) && wanted.starts_with("energy"))
    throw std::invalid_argument("Monitor " + wanted +
                                " has no meaning here: its kinetic energy is not positive along the orbit; "
                                "take monitor fixed.");
  all.push_back(candidate(wanted, question_, energy, choice));
}

/// Adds the explicit splitting to the menu if fixed steps come first there: before them if it should take
/// less time, behind them if it should take less than twice as much. If it was asked for by name, it replaces
/// them.
void Menu::offer_splitting() {
  const SolveOptions& options = question_.options;
  const bool asked = options.monitor.name == splitting;
  if (!asked && (!options.monitor.name.empty() || options.order > 0 || all.empty() || !all.front().fixed() ||
                 !(aim_ > 1e-13)))
    return;
  if (known_.parts != Parts::nystrom) {
    if (!asked) return;
    throw std::invalid_argument(
        "Monitor splitting has no meaning here: it is for H = T(p) + V(q) with T quadratic in p.");
  }
  if (asked) {
    all.front().name = splitting;
    return;
  }
  (void)all.front().formulas();  // made once, for both
  all.insert(all.begin(), all.front());
  all.front().name = splitting;
  // The splitting makes two runs side by side for the price of one; for collocation, ten sweeps a step are
  // usual.
  const double split = 14.0 * all[0].price() * 2.0 / first_step(all[0]);
  const double other = 10.0 * all[1].price() * (order_ == 8 ? 0.6 : 1.0) * 1.8 / first_step(all[1]);
  // The usable step of the splitting varies by a factor of two from orbit to orbit; in a long run, trials
  // decide.
  if (!(split < other)) std::swap(all[0], all[1]);
  if (!(split < 2.0 * other)) all.erase(all.begin() + 1);
}

double Menu::first_step(const Candidate& it) {
  // The constants are medians over some hundred systems drawn at random. With a monitor they are larger,
  // because the motion is smoother in fictive time than the frequency of its fastest part suggests.
  const int order = order_of(it);
  const double usual = it.splits() ? 8.0 : it.fixed() ? (order == 8 ? 6.0 : 7.2) : (order == 8 ? 9.5 : 10.5);
  // Low orders need far shorter steps.
  const double radians = std::clamp(usual * std::pow(aim_, 1.0 / order), order < 6 ? 1e-5 : 0.01,
                                    !it.fixed()                      ? 3.5
                                    : known_.parts == Parts::coupled ? 1.8
                                                                     : 2.2);
  return std::min({it.longest > 0.0 ? radians / it.longest : infinity, longest_step(it) / longer,
                   known_.field.size() > 4 ? stable_step(it) / longer : infinity});
}

double Menu::stable_step(const Candidate& it) {
  if (!it.fixed()) return infinity;
  if (fastest_ < 0.0) fastest_ = known_.field.fastest(stacked(known_.trip->start), known_.metric);
  // An oscillation grows if step times frequency is 6.15 or more. Near 3.14 it grows by at most 6e-4 a step,
  // and only one of two runs can be that near.
  if (it.splits()) return fastest_ > 0.0 ? 5.5 / fastest_ : infinity;
  // Parts much faster than the visible motion are left to Newton's method.
  return fastest_ > 0.0 && fastest_ < 6.0 * it.longest ? 3.1 / fastest_ : infinity;
}

}  // namespace avi::detail
