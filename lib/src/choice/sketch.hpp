#pragma once
#include "avi/autodiff/partials.hpp"
#include "avi/autodiff/recording.hpp"
#include "avi/core/dot.hpp"
#include "avi/integrators/runge_kutta.hpp"
#include "src/features/barriers.hpp"
#include "src/features/switches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

/// @file
/// A rough run along the beginning of an orbit, from which its scales are taken.

namespace avi::detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();  ///< Infinity, or unknown.

/// (q, p) as one vector.
inline VectorX stacked(const State<dynamic>& z) { return (VectorX(2 * z.q.size()) << z.q, z.p).finished(); }

/// The Hamiltonian vector field of H, evaluated at one point at a time.
class PointField {
 public:
  /// Makes the field of H, a node of a graph of (q, p). @param supplied nodes of its gradient, if H supplies
  /// its own
  PointField(const ExpressionGraph& graph, int energy, const std::vector<int>& supplied)
      : recording_(std::make_shared<const Recording>(graph, energy, energy, supplied)),
        n_(recording_->inputs() / 2), formula_{recording_->value_and_gradient()} {}

  /// Sets dz = J grad H at z = (q, p). @return H
  double operator()(const VectorX& z, VectorX& dz) { return (*this)(z.data(), z.data() + n_, dz); }
  /// Evaluates the field at a state.
  double operator()(const State<dynamic>& z, VectorX& dz) { return (*this)(z.q.data(), z.p.data(), dz); }
  /// Evaluates the field at q and p, n entries each.
  double operator()(const double* q, const double* p, VectorX& dz) {
    formula_.run(q, p, n_);
    for (int i = 0; i < n_; ++i) {
      dz[i] = sense * formula_.partial(n_ + i);
      dz[n_ + i] = -sense * formula_.partial(i);
    }
    return formula_.value();
  }
  /// Value of H.
  double energy(const double* q, const double* p) {
    // Making a program of H alone takes as long as some evaluations of H with its gradient.
    if (!value_ && ++energies_ > 40) value_.emplace(RecordedFormula<double>{recording_->value()});
    RecordedFormula<double>& formula = value_ ? *value_ : formula_;
    formula.run(q, p, n_);
    return formula.value();
  }
  /// Estimates the diagonal of H_pp at z by two probes with random signs: exact where H_pp is diagonal, else
  /// approximate. Entries that are not positive are replaced by the largest one.
  VectorX metric(const VectorX& z) {
    Duals room(formula_.program);
    VectorX metric = VectorX::Zero(n_), v = VectorX::Zero(2 * n_), w(2 * n_);
    unsigned bits = 12345u;
    for (int probe = 0; probe < 2; ++probe) {
      for (int i = 0; i < n_; ++i)
        v[n_ + i] = sign(bits);
      linear(room, z, v, w);
      for (int i = 0; i < n_; ++i)
        metric[i] = std::max(metric[i], v[n_ + i] * w[i]);
    }
    double largest = 0.0;
    for (int i = 0; i < n_; ++i)
      if (std::isfinite(metric[i])) largest = std::max(largest, metric[i]);
    for (int i = 0; i < n_; ++i)
      if (!(metric[i] > 0.0) || !std::isfinite(metric[i])) metric[i] = largest > 0.0 ? largest : 1.0;
    return metric;
  }
  /// Estimates the largest frequency of small oscillations about z, by power iteration on the linearised
  /// field. The result is a little low; it is 0 where it would not be finite. @param metric diagonal of H_pp
  double fastest(const VectorX& z, const VectorX& metric) {
    Duals room(formula_.program);
    VectorX root = metric, scaled(2 * n_);
    for (double& each : root)
      each = std::sqrt(each);
    const auto size = [&](const VectorX& v) {
      scaled << v.head(n_).cwiseQuotient(root), v.tail(n_).cwiseProduct(root);
      return norm(scaled);
    };
    VectorX v(2 * n_), w(2 * n_);
    unsigned bits = 6789u;
    for (int i = 0; i < n_; ++i)
      v[i] = sign(bits) * root[i], v[n_ + i] = sign(bits) / root[i];
    double square = 0.0;
    for (int k = 0; k < 8; ++k) {
      const double before = size(v);
      linear(room, z, v, w);
      linear(room, z, w, v);
      square = size(v) / before;
      if (!std::isfinite(square) || !(square > 0.0)) return 0.0;
      v /= size(v);
    }
    return std::sqrt(square);
  }
  /// The largest frequency of coordinates that move, but are pushed by no force at z, as in the middle of a
  /// well; 0 if there are none. It is found from the second time derivative of their momenta. @param dz the
  /// slope at z
  double frequency_of_unpushed(const VectorX& z, const VectorX& dz, const VectorX& metric) {
    const auto unpushed = [&](Eigen::Index i) { return dz[n_ + i] == 0.0 && dz[i] != 0.0; };
    double square = 0.0;
    VectorX change;
    for (Eigen::Index i = 0; i < n_ - (timed ? 1 : 0); ++i)
      if (unpushed(i)) {
        if (change.size() == 0) {
          Duals room(formula_.program);
          change.resize(2 * n_);
          linear(room, z, dz, change);
        }
        square = std::max(square, std::abs(change[n_ + i] / dz[i]) * metric[i]);
      }
    return std::isfinite(square) ? std::sqrt(square) : 0.0;
  }
  /// The largest rate at which an entry of the slope changes with time alone, relative to that entry. It is
  /// large near a singularity of coefficients in time. @param dz the slope at z @return 0 where it is not
  /// finite, or H does not depend on time
  double rate_in_time(const VectorX& z, const VectorX& dz) {
    if (!timed) return 0.0;
    Duals room(formula_.program);
    VectorX along = VectorX::Zero(2 * n_), change(2 * n_);
    along[n_ - 1] = 1.0;
    linear(room, z, along, change);
    double rate = 0.0;
    for (int i = 0; i < n_ - 1; ++i)
      for (const int k : {i, n_ + i})
        if (dz[k] != 0.0) rate = std::max(rate, std::abs(change[k] / dz[k]));
    return std::isfinite(rate) ? rate : 0.0;
  }
  /// Raises `most` to the change of the slope at z per relative error of the entries of z, to first order.
  /// @param slope that at z @param draw seed for the signs of those errors
  void add_sensitivity(const Eigen::Map<const VectorX>& z, const Eigen::Map<const VectorX>& slope,
                       unsigned draw, VectorX& most) {
    constexpr double error = 1e-7;
    moved_ = z, there_.resize(z.size());
    for (double& entry : moved_)
      entry *= 1.0 + sign(draw) * error;
    (*this)(moved_, there_);
    most = most.cwiseMax((there_ - slope).cwiseAbs() / error);
  }
  [[nodiscard]] int size() const { return n_; }  ///< Number of degrees of freedom.
  /// Number of operations of H with its gradient.
  [[nodiscard]] double operations() const { return static_cast<double>(formula_.program.operations()); }
  /// The recording of H.
  [[nodiscard]] const std::shared_ptr<const Recording>& recording() const { return recording_; }

  /// Returns true if a place where H is infinite lies between two points, see Barriers.
  bool crosses(const VectorX& from, const VectorX& to) {
    return barriers &&
           barriers->between(from.data(), to.data(), [this](const double* z) { return energy(z, z + n_); });
  }

  double sense = 1.0;  ///< Direction of time; -1 follows the orbit backwards.
  bool timed = false;  ///< Whether the last coordinate is time, which has a unit of its own.
  std::shared_ptr<const Switches> switches = {};  ///< Times at which H switches, if any.
  std::optional<Barriers> barriers = {};          ///< Where H is infinite, if it may be.
  std::function<double(const VectorX&)> limit;    ///< Longest step of a sketch from a point, if limited.

 private:
  using Duals = Program::Room<Partials<double, 1>>;
  static double sign(unsigned& bits) {
    bits = bits * 1664525u + 1013904223u;
    return bits >> 31 ? 1.0 : -1.0;
  }
  /// Sets w to the derivative of the field at z along v.
  void linear(Duals& room, const VectorX& z, const VectorX& v, VectorX& w) {
    for (int i = 0; i < 2 * n_; ++i)
      room.arguments()[i] = Partials<double, 1>::variable(z[i], 0, v[i]);
    formula_.program.run(room);
    for (int i = 0; i < n_; ++i) {
      w[i] = formula_.program.slope(room, n_ + i).partial(0);
      w[n_ + i] = -formula_.program.slope(room, i).partial(0);
    }
  }
  std::shared_ptr<const Recording> recording_;
  int n_;
  RecordedFormula<double> formula_;  // H with its gradient
  VectorX moved_, there_;            // scratch
  int energies_ = 0;                 // evaluations of H alone before it has a program
  std::optional<RecordedFormula<double>> value_;
};

/// Points along the beginning of an orbit, from a run by the Bogacki-Shampine pair. Its tolerance is loose,
/// and relative to the range through which each entry of (q, p) moves, so that the steps follow the fastest
/// entry, whatever its mass or unit. What is measured here sets lengths of trials and first guesses, never a
/// result.
class Sketch {
 public:
  /// A point of the sketch and the step from it.
  struct Sample {
    using Numbers = Eigen::Map<const VectorX>;  ///< Vector of 2n numbers, which the sketch holds.
    Numbers z;                                  ///< The point (q, p).
    Numbers slope;                              ///< Velocity in phase space.
    Numbers errors;                             ///< Errors of the step, for each entry.
    double h;                                   ///< Time to the next sample.
    double frequency;  ///< Radians per unit of time, estimated from the error of the step.
    double energy;     ///< Value of H.
  };

  static constexpr int few = 128;  ///< Largest number of steps, unless more are asked for.

  /// Makes a sketch along the orbit of `field` from z, over the time `span` or at most `most` steps.
  /// @param metric diagonal of H_pp; a motion of 1e-10 of the largest, masses taken out, does not limit the
  /// steps @param before time that has passed already; if 0, the sketch ends where the orbit begins to repeat
  /// itself @param longest the longest step allowed
  Sketch(PointField& field, const VectorX& z, double span, const VectorX& metric, int most = few,
         double before = 0.0, double longest = infinity) {
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
    VectorX low = at, high = at, scale(size), errors(size);
    double energy = field(at, step.k[0]), last = energy;
    // If no force acts here, a long step may lead to where none acts either, passing over a force in between.
    const double unpushed = field.frequency_of_unpushed(at, step.k[0], metric);
    double h = std::min(first_step(field, at, step.k[0], span, roots), 1.0 / unpushed);
    int grown = 0;  // number of samples when an entry last left its range
    int alike = 0;  // refused steps in a row whose errors, relative to the motion, did not fall
    double refused = 0.0;
    double work = 0.0, lost = 0.0;  // integral of half of |p q'|; energy lost near poles
    for (int tries = 0; time < span && static_cast<int>(samples.size()) < most && tries < 6 * most; ++tries) {
      h = std::min({h, span - time, longest, field.limit ? field.limit(at) : infinity});
      const double usual = h;
      std::optional<Switches::Switch> at_end;
      if (switches) at_end = to_switch(*switches, at, field.sense, h);
      step.advance([&](const VectorX& x, VectorX& dx) { last = field(x, dx); }, at, h);
      for (Eigen::Index i = 0; i < size; ++i) {
        const double fastest =
            std::max({std::abs(step.k[0][i]), std::abs(step.k[1][i]), std::abs(step.k[2][i])});
        scale[i] = std::max(std::max(high[i], step.end[i]) - std::min(low[i], step.end[i]), h * fastest);
      }
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
      if (motion > 10.0 * work / time) lost += last - energy;
      work += h * motion;
      samples.push_back({kept(at), kept(step.k[0]), kept(errors), h, 0.0, energy});
      energy = last;
      time += h;
      at = step.end;
      const auto made = static_cast<int>(samples.size());
      for (Eigen::Index i = 0; i < size; ++i) {
        if (std::max(low[i] - at[i], at[i] - high[i]) > 0.01 * (high[i] - low[i])) grown = made;
        low[i] = std::min(low[i], at[i]), high[i] = std::max(high[i], at[i]);
      }
      // An orbit that stays within its ranges for as long as it took to fill them repeats itself. If the way
      // is short, a quarter of it has to do: all of it takes hardly more than a longer sketch.
      if (before == 0.0 && !field.limit && made >= enough && grown <= made / 2) break;
      if (made >= most / 2 && time >= 0.25 * span) break;
      // At a pole, momenta are large, and so are errors. If the energy has changed by then as much as there
      // is energy of motion elsewhere, the sketch goes on along another orbit.
      if (made > 8 && motion < work / time && std::abs(lost) > work / time) break;
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
    find_frequencies(high - low, roots, field.timed, static_cast<bool>(field.limit));
  }

  std::vector<Sample> samples;  ///< Samples in the order of time.
  double time = 0.0;            ///< Length in time.
  double radians = 0.0;         ///< Integral of the frequency over time.
  bool stuck = false;           ///< Whether steps became too short to go on, as before a singularity.

  /// The time of the fastest motion, and the factor by which that is faster than the slowest.
  [[nodiscard]] std::pair<double, double> fastest() const {
    double t = 0.0, at = 0.0, most = 0.0, least = infinity;
    for (const Sample& sample : samples) {
      if (sample.frequency > most) at = t, most = sample.frequency;
      if (sample.frequency > 0.0) least = std::min(least, sample.frequency);
      t += sample.h;
    }
    return {at, most / least};
  }
  /// The highest frequency of a sample.
  [[nodiscard]] double highest_frequency() const {
    double most = 0.0;
    for (const Sample& sample : samples)
      most = std::max(most, sample.frequency);
    return most;
  }
  /// Adds the samples of another part of the orbit.
  void append(Sketch&& other) {
    for (const Sample& sample : other.samples)
      samples.push_back(sample);
    time += other.time, radians += other.radians;
    more_.push_back(std::move(other.numbers_));
  }
  /// The time in which the phase grows by so many radians, extrapolated beyond the end of the sketch.
  [[nodiscard]] double time_of(double phase) const {
    double t = 0.0, seen = 0.0;
    for (const Sample& sample : samples) {
      const double here = sample.h * sample.frequency;
      if (seen + here >= phase) return t + (phase - seen) / sample.frequency;
      seen += here;
      t += sample.h;
    }
    return seen > 0.0 ? t * phase / seen : infinity;
  }

 private:
  static constexpr double loose = 0.004;  // error of a step
  static constexpr double angle = 0.68;   // radians of a spring in a step with that error
  static constexpr int enough = 48;       // least number of samples of an orbit that repeats itself

  /// Sets the errors of a step from `at`, by the embedded formula of order 2; those that are rounding count
  /// as zero. @return the largest, relative to the scale of its entry
  static double find_errors(const RungeKuttaStages<BogackiShampine>& step, const VectorX& at, double h,
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
  /// Sets the frequency of each sample by its errors, relative to the ranges of the entries, and the phase.
  /// Steps that were far too short, as the first ones, have errors from rounding only: they take the
  /// frequency of the next step. @param limited whether other steps, too, were shorter than errors ask for
  void find_frequencies(const VectorX& ranges, const VectorX& roots, bool timed, bool limited) {
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

  /// Passes the switches at z, then shortens the step h if there is a switch in it. @return that switch, if
  /// any
  static std::optional<Switches::Switch> to_switch(Switches& switches, VectorX& z, double sense, double& h) {
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
  /// Moves z over a switch.
  static void pass(Switches& switches, const Switches::Switch& at, VectorX& z) {
    const Eigen::Index n = z.size() / 2;
    z[2 * n - 1] += switches.fall(z.data(), z.data() + n, at);
    z[n - 1] = at.after;
  }

  /// Numbers for all but the light bodies, and for these: their motion is small beside that of the others,
  /// masses taken out, but it is no rounding.
  using ByMass = std::array<double, 2>;
  /// Whether a mass is so small a part of the heaviest one. @param root square root of 1 / mass
  static bool is_light(double root, double of_heaviest) { return root > 3e8 * of_heaviest; }
  /// Raises scales of entries to at least 1e-10 of the largest one of their kind, masses taken out, and that
  /// of the momentum of time to at least 1e-10 of an energy. @param roots square roots of the diagonal of
  /// H_pp
  /// @param change a change of the largest momentum, masses taken out, that is below its digits
  static void lift(VectorX& scale, const VectorX& roots, bool timed, const ByMass& change = {}) {
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
  static double first_step(PointField& field, const VectorX& z, const VectorX& dz, double span,
                           const VectorX& roots) {
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

  std::unique_ptr<double[]> numbers_;            // numbers of all samples,
  std::vector<std::unique_ptr<double[]>> more_;  // and of those that were appended
};

}  // namespace avi::detail
