#include "src/choice/sketch.hpp"

#include "avi/core/dot.hpp"
#include "avi/integrators/runge_kutta.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace avi::detail {

namespace {

constexpr double loose = 0.004;  // error of a step
constexpr double angle = 0.68;   // radians of a spring in a step with that error
constexpr int enough = 48;       // least number of samples of an orbit that repeats itself

/// Sets the errors of a step from `at`, by the embedded formula of order 2; those that are rounding count
/// as zero. @return the largest, relative to the scale of its entry
double find_errors(const RungeKuttaStages<BogackiShampine>& step, const VectorX& at, double h,
                   const VectorX& scale, VectorX& errors) {
  using Pair = BogackiShampine;
  double worst = 0.0;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    double change = 0.0;
    for (std::size_t j = 0; j < 4; ++j)
      change += (Pair::b[j] - Pair::embedded[j]) * step.k[j][i];
    errors[i] = h * std::abs(change);
    if (errors[i] <= 1e3 * std::numeric_limits<double>::epsilon() * std::abs(at[i])) errors[i] = 0.0;
    if (errors[i] > 0.0) worst = std::max(worst, errors[i] / scale[i]);
    if (!std::isfinite(errors[i])) worst = infinity;
  }
  return worst;
}
/// Moves z over a switch.
void pass(Switches& switches, const Switches::Switch& at, VectorX& z) {
  const Eigen::Index n = z.size() / 2;
  z[2 * n - 1] += switches.fall(z.data(), z.data() + n, at);
  z[n - 1] = at.after;
}

/// Passes the switches at z, then shortens the step h if there is a switch in it. @return that switch, if
/// any
std::optional<Switches::Switch> to_switch(Switches& switches, VectorX& z, double sense, double& h) {
  double& t = z[z.size() / 2 - 1];
  while (const auto here = switches.at(t, sense))
    pass(switches, *here, z);
  const auto next = switches.next(t, t + sense * h);
  if (next) {
    // The field is also evaluated at the end of the step, which must be before the switch.
    const double way = std::abs(next->before - t);
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(next->before);
    h = std::max(way - std::max(1e-9 * way, rounding), 0.5 * way);
  }
  return next;
}

/// Numbers for all but the light bodies, and for these: their motion is small beside that of the others,
/// masses taken out, but it is no rounding.
using ByMass = std::array<double, 2>;
/// Whether a mass is so small a part of the heaviest one. @param root square root of 1 / mass
bool is_light(double root, double of_heaviest) { return root > 3e8 * of_heaviest; }
/// Raises scales of entries to at least 1e-10 of the largest one of their kind, masses taken out, and that
/// of the momentum of time to at least 1e-10 of an energy. @param roots square roots of the diagonal of
/// H_pp
/// @param change a change of the largest momentum, masses taken out, that is below its digits
void lift(VectorX& scale, const VectorX& roots, bool timed, const ByMass& change = {}) {
  const Eigen::Index n = roots.size(), seen = timed ? n - 1 : n;
  const double heaviest = roots.head(seen).minCoeff();
  ByMass of_q{}, of_p{};
  for (Eigen::Index i = 0; i < seen; ++i) {
    const bool light = is_light(roots[i], heaviest);
    of_q[light] = std::max(of_q[light], scale[i] / roots[i]);
    of_p[light] = std::max(of_p[light], scale[n + i] * roots[i]);
  }
  for (Eigen::Index i = 0; i < seen; ++i) {
    const bool light = is_light(roots[i], heaviest);
    scale[i] = std::max(scale[i], 1e-10 * of_q[light] * roots[i]);
    scale[n + i] = std::max(scale[n + i], std::max(1e-10 * of_p[light], change[light]) / roots[i]);
  }
  if (timed) scale[2 * n - 1] = std::max(scale[2 * n - 1], 1e-10 * of_p[0] * of_p[0]);
}

/// Returns a step in which no entry of the field changes by much, and at most a thousandth of the span.
double first_step(PointField& field, const VectorX& z, const VectorX& dz, double span, const VectorX& roots) {
  VectorX ahead(z.size()), there(z.size()), scale = dz.cwiseAbs();
  lift(scale, roots, field.timed);
  if (field.timed) scale[scale.size() - 1] = 0.0;  // nothing depends on the momentum of time
  double h = 1e-3 * span;
  for (int i = 0; i < 60; ++i, h *= 0.1) {
    ahead = z + h * dz;
    field(ahead, there);
    double worst = 0.0;
    for (Eigen::Index k = 0; k < z.size(); ++k) {
      const double change = std::abs(there[k] - dz[k]);
      if (!std::isfinite(change)) worst = infinity;
      if (scale[k] > 0.0) worst = std::max(worst, change / scale[k]);
    }
    if (worst <= 0.5) return h;
  }
  return h;
}

/// The ranges, and the energy, along the samples so far.
struct Passed {
  explicit Passed(const VectorX& start) : low(start), high(start) {}

  VectorX low, high;  // ranges of the entries
  int samples = 0;
  int grown = 0;                  // number of samples when an entry last left its range
  double work = 0.0, lost = 0.0;  // integral of half of |p q'|; energy lost near poles

  /// Sets the scale of each entry: its range, or its way in this step.
  void set_scale(const RungeKuttaStages<BogackiShampine>& step, double h, VectorX& scale) const {
    for (Eigen::Index i = 0; i < scale.size(); ++i) {
      const double fastest =
          std::max({std::abs(step.k[0][i]), std::abs(step.k[1][i]), std::abs(step.k[2][i])});
      scale[i] = std::max(std::max(high[i], step.end[i]) - std::min(low[i], step.end[i]), h * fastest);
    }
  }
  /// Takes in a step. @param motion half of |p q'| at its beginning @param time up to there @param gained
  /// change of the energy
  void add(double motion, double h, double time, double gained) {
    if (motion > 10.0 * work / time) lost += gained;
    work += h * motion;
  }
  /// Takes in the end of a step.
  void reach(const VectorX& at) {
    ++samples;
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      if (std::max(low[i] - at[i], at[i] - high[i]) > 0.01 * (high[i] - low[i])) grown = samples;
      low[i] = std::min(low[i], at[i]), high[i] = std::max(high[i], at[i]);
    }
  }
  /// An orbit that stays within its ranges for as long as it took to fill them repeats itself.
  [[nodiscard]] bool repeats() const { return samples >= enough && grown <= samples / 2; }
  /// At a pole, momenta are large, and so are errors. If the energy has changed by then as much as there is
  /// energy of motion elsewhere, the sketch goes on along another orbit.
  [[nodiscard]] bool is_lost(double motion, double time) const {
    return samples > 8 && motion < work / time && std::abs(lost) > work / time;
  }
};

}  // namespace

Sketch::Sketch(PointField& field, const VectorX& z, double span, const VectorX& metric, int most,
               double before, double longest) {
  const Eigen::Index size = z.size(), n = metric.size(), seen = field.timed ? n - 1 : n;
  numbers_.reset(new double[static_cast<std::size_t>(3 * size * most)]);
  samples.reserve(static_cast<std::size_t>(most));
  double* room = numbers_.get();
  const auto kept = [&](const VectorX& x) {
    std::copy(x.begin(), x.end(), room);
    room += size;
    return Sample::Numbers(room - size, size);
  };
  // A force that changes only the last digits of the momenta does not limit the steps either.
  VectorX roots = metric;
  for (double& each : roots)
    each = std::sqrt(each);
  const double heaviest = roots.head(seen).minCoeff();
  ByMass largest{};
  for (Eigen::Index i = 0; i < seen; ++i) {
    double& its = largest[is_light(roots[i], heaviest)];
    its = std::max(its, 1e-12 * std::abs(z[n + i]) * roots[i]);
  }
  std::optional<Switches> switches;
  if (field.switches) switches.emplace(*field.switches);
  RungeKuttaStages<BogackiShampine> step(size);
  VectorX at = z;
  if (switches) {
    double none = 0.0;
    (void)to_switch(*switches, at, field.sense, none);  // z may be at one already
  }
  Passed passed(at);
  VectorX scale(size), errors(size);
  double energy = field(at, step.k[0]), last = energy;
  if (field.has_kinks) {
    // At a kink the slope is the mean of both sides; the motion begins with that of one side.
    const VectorX ahead = at + 1e-12 * span * step.k[0];
    field(ahead, errors);
    if ((errors - step.k[0]).cwiseAbs().maxCoeff() > 1e-3 * errors.cwiseAbs().maxCoeff()) step.k[0] = errors;
  }
  // If no force acts here, a long step may lead to where none acts either, passing over a force in between.
  const double unpushed = field.frequency_of_unpushed(at, step.k[0], metric);
  double h = std::min(first_step(field, at, step.k[0], span, roots), 1.0 / unpushed);
  int alike = 0;  // refused steps in a row whose errors, relative to the motion, did not fall
  double refused = 0.0;
  for (int tries = 0; time < span && static_cast<int>(samples.size()) < most && tries < 6 * most; ++tries) {
    h = std::min({h, span - time, longest, field.limit ? field.limit(at) : infinity});
    const double usual = h;
    std::optional<Switches::Switch> at_end;
    if (switches) at_end = to_switch(*switches, at, field.sense, h);
    step.advance([&](const VectorX& x, VectorX& dx) { last = field(x, dx); }, at, h);
    passed.set_scale(step, h, scale);
    lift(scale, roots, field.timed, largest);
    const double worst = find_errors(step, at, h, scale, errors);
    const double factor = std::isfinite(worst) ? std::cbrt(loose / std::max(worst, 1e-3 * loose)) : 0.1;
    alike = factor < 0.8 && worst > 0.7 * refused && std::isfinite(worst) ? alike + 1 : 0;
    refused = factor < 0.8 ? worst : 0.0;
    // A motion that begins from rest as a power of time has the same error, relative to its range, in a
    // shorter step.
    const bool begins = alike > 3, good = !(factor < 0.8) || begins;
    if (!good || field.crosses(at, step.end)) {
      h *= good ? 0.5 : std::max(0.1, 0.9 * factor);
      const double way = before + time;
      if (stuck = !(h > 1e-14 * (way > 0.0 ? way : span)); stuck) break;
      continue;
    }
    const double motion = 0.5 * std::abs(dot(at.segment(n, seen), step.k[0].head(seen)));
    passed.add(motion, h, time, last - energy);
    samples.push_back({kept(at), kept(step.k[0]), kept(errors), h, 0.0, energy});
    energy = last;
    time += h;
    at = step.end;
    passed.reach(at);
    // If the way is short, a quarter of it has to do: all of it takes hardly more than a longer sketch.
    if ((before == 0.0 && !field.limit && passed.repeats()) || passed.is_lost(motion, time) ||
        (passed.samples >= most / 2 && time >= 0.25 * span))
      break;
    std::swap(step.k[0], step.k[3]);
    if (at_end) {
      pass(*switches, *at_end, at);
      energy = field(at, step.k[0]);
      h = usual;
      continue;
    }
    h *= begins ? 2.0 : std::min(5.0, 0.9 * factor);
  }
  // Ranges were small at first, so frequencies are found now that all ranges are known.
  find_frequencies(passed.high - passed.low, roots, field.timed, static_cast<bool>(field.limit));
}

/// Sets the frequency of each sample by its errors, relative to the ranges of the entries, and the phase.
/// Steps that were far too short, as the first ones, have errors from rounding only: they take the
/// frequency of the next step. @param limited whether other steps, too, were shorter than errors ask for
void Sketch::find_frequencies(const VectorX& ranges, const VectorX& roots, bool timed, bool limited) {
  VectorX scale(ranges.size());
  double next = 0.0;
  for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample) {
    double worst = 0.0;
    for (Eigen::Index i = 0; i < ranges.size(); ++i)
      scale[i] = std::max(ranges[i], sample->h * std::abs(sample->slope[i]));
    lift(scale, roots, timed);
    for (Eigen::Index i = 0; i < ranges.size(); ++i)
      if (sample->errors[i] > 0.0) worst = std::max(worst, sample->errors[i] / scale[i]);
    constexpr double least = 1e-4;
    if (worst > least * loose)
      next = angle / sample->h * std::cbrt(worst / loose);
    else if (limited)  // it may have been as short as a bend asked for
      next = std::min(next, angle / sample->h * std::cbrt(least));
    sample->frequency = next;
    radians += sample->h * next;
  }
}

}  // namespace avi::detail
