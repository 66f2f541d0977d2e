#include "src/choice/overview.hpp"

#include "avi/core/dot.hpp"
#include "avi/core/require.hpp"
#include "src/autodiff/rounded_formula.hpp"
#include "src/choice/choose.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

/// @file
/// An orbit as it looks before any run along it: the sketch, its scales and its features.

namespace avi::detail {

double energy_at_start(const OrbitQuestion& question) {
  if (question.timed) return 0.0 * question.p.back();  // H + p_t
  const VectorX start = stacked_start(question);
  return RoundedFormula(question.graph, question.energy).rounded_once({start.begin(), start.end()});
}

void require_energy(double energy, const OrbitQuestion& question) {
  if (std::isfinite(energy)) return;
  std::ostringstream text;
  const auto point = [&](const char* name, const std::vector<double>& numbers) {
    const std::size_t n = numbers.size() - (question.timed ? 1 : 0);
    for (std::size_t i = 0; i < std::min<std::size_t>(n, 6); ++i)
      text << (i == 0 ? name : ", ") << numbers[i];
    text << (n > 6 ? ", ...)" : ")");
  };
  const double value = question.timed ? -question.p.back() : energy;
  text << "H is ";
  if (std::isnan(value))
    text << "nan";  // streams may print -nan
  else
    text << value;
  text << " at the start, where ";
  point("q = (", question.q), point(", p = (", question.p);
  if (question.timed) text << ", t = " << question.t;
  text << "; an orbit needs an energy that is finite.";
  throw std::invalid_argument(text.str());
}

bool Overview::late() const {
  return field.operations() > 1e5 && budget_.seconds() > question_.options.seconds;
}

void Overview::make(bool closely, const std::optional<State<dynamic>>& also) {
  const int n = field.size();
  const VectorX start = stacked_start(question_);
  VectorX slope(2 * n);
  const double energy = energy_and_slope(start, slope);
  metric = field.metric(start);
  // Time as a coordinate and its momentum are auxiliary: their errors do not count.
  const int seen = question_.timed ? n - 1 : n;
  distance.emplace(metric, question_.tolerance, seen);
  sketch_from(start, closely);
  if (late()) return;
  if (also) {
    const double before = std::abs(also->t - question_.t);
    sketch->append(Sketch(field, stacked(*also), span - before, metric, Sketch::few, before), before);
  }
  const double time = std::max(sketch->time, 1e-300);
  distance->frequency = sketch->radians / time;
  radians = sketch->radians / time * span;
  distance->noise = rounding_of_slopes();

  const State<dynamic> z{.q = start.head(n), .p = start.tail(n), .t = question_.t};
  Ranges ranges(z);
  for (const Sketch::Sample& sample : sketch->samples)
    ranges.add(sample.z.data(), sample.z.data() + n);
  bool drifting = false;  // something moves although all momenta are zero
  put_at_rest(seen, drifting);
  field.sense = 1.0;
  const double work = mean_motion(ranges, seen);
  describe_motion(seen, drifting);
  // For a body at rest, or where rounding hides the kinetic energy, the unit is a small part of H itself.
  double scale = std::max(std::isfinite(work) ? work : 0.0, 1e-13 * std::abs(energy));
  if (!(scale > 0.0)) scale = 1.0;
  trip.emplace(Trip{z, energy, scale, sense, budget_});
  take_unit_of_energy(scale);
  trip->span = span;
  trip->ranges = ranges.high - ranges.low;
  trip->seen = seen;
  look_for_features(scale);
}

/// Returns the energy at the start and sets the slope there. @throws std::invalid_argument unless both are
/// finite
double Overview::energy_and_slope(const VectorX& start, VectorX& slope) {
  const int n = field.size();
  const double energy = field(start, slope);
  require_energy(energy, question_);
  const auto name = [&](int i) {
    if (question_.timed && i == 2 * n - 1) return std::string("t");
    return (i < n ? "p[" : "q[") + std::to_string(i % n) + "]";
  };
  for (int i = 0; i < 2 * n; ++i)
    if (!std::isfinite(slope[i]))
      require(false, "The derivative of H by " + name(i) + " at the start", i < n ? slope[i] : -slope[i],
              "finite");
  return energy_at_start(question_);
}

/// Makes the sketch: a run of low accuracy that stands for the orbit during the rest of the choice.
void Overview::sketch_from(const VectorX& start, bool closely) {
  field.sense = sense;
  bends.emplace(question_.graph, question_.energy, question_.timed);
  if (closely) {
    constexpr double begun = std::numeric_limits<double>::min();
    sketch.emplace(field, start, span, metric, 4 * parts_of_close_sketch, begun,
                   span / parts_of_close_sketch);
    bends->measure(*sketch);
    return;
  }
  sketch.emplace(field, start, span, metric);
  // If nothing happens on the sketch, its long steps may have passed over something: limit them.
  if (sketch->radians < 1e-4 && sketch->time == span)
    sketch.emplace(field, start, span, metric, 512, 0.0, span / 256.0);
  follow_the_take_off(start.size() / 2 - 1);
  bends->measure(*sketch);
  const std::string& named = question_.options.monitor.name;
  if (named == "poles" || (named.empty() && question_.given < 0)) look_at_bends(start);
}

/// A system at rest that only the time dependence of H sets in motion hardly moves at first, so a sketch of
/// its beginning says nothing about the rest. Restarts the sketch from its own end until the motion no longer
/// grows by orders of magnitude over it.
void Overview::follow_the_take_off(Eigen::Index seen) {
  if (!question_.timed) return;
  const auto motion = [&](std::size_t last) {
    const auto moved = (sketch->samples[last].z - sketch->samples[0].z).cwiseAbs().eval();
    return std::max(moved.head(seen).maxCoeff(), moved.segment(seen + 1, seen).maxCoeff());
  };
  double before = 0.0;
  for (int restarts = 0; restarts < 64 && before < span; ++restarts) {
    const std::size_t count = sketch->samples.size();
    if (sketch->stuck || count < Sketch::few || !(motion(count - 1) > 1e3 * motion(count / 2))) return;
    before += sketch->time - sketch->samples.back().h;
    const VectorX from = sketch->samples.back().z;
    sketch.emplace(field, from, span - before, metric);
  }
}

/// Returns true if something other than time and its momentum changes at a sample.
bool Overview::moves(const Sketch::Sample& sample) const {
  const Eigen::Index n = field.size(), seen = question_.timed ? n - 1 : n;
  return !sample.slope.head(seen).isZero(0.0) || !sample.slope.segment(n, seen).isZero(0.0);
}

/// Makes the sketch again, with short steps near bends of H, if it has missed some.
void Overview::look_at_bends(const VectorX& start) {
  // Of what does not move yet, a sketch shows no bend.
  if (sketch->samples.size() < 2 || !moves(sketch->samples.front())) return bends->forget();
  if (question_.timed) bends->look_ahead(start, question_.t_end);
  if (late() || !bends->take_missed(*sketch)) return;
  const VectorX first = sketch->samples.front().z;  // at the start, or after the take-off
  const double before = question_.timed ? std::abs(first[first.size() / 2 - 1] - question_.t) : 0.0;
  const double usual = sketch->radians / sketch->time;
  field.limit = [this](const VectorX& z) { return 0.7 * bends->time_to_nearest(z.data()); };
  sketch.emplace(field, first, span - before, metric, 512);
  field.limit = nullptr;
  // A sketch of low order hardly feels a short bend, but a step of high order does.
  for (Sketch::Sample& sample : sketch->samples)
    sample.frequency = std::max(sample.frequency, 1.0 / bends->time_to_nearest(sample.z.data()));
  sketch->radians = std::max(sketch->radians, usual * sketch->time);
  bends->measure(*sketch);
  if (question_.timed) bends->look_ahead(start, question_.t_end);
}

/// Returns how far rounding of the slopes may move each entry in a hundred radians, if all rounding errors
/// have the same sign.
VectorX Overview::rounding_of_slopes() {
  const Eigen::Index n = metric.size();
  VectorX slope = VectorX::Zero(2 * n);
  const std::vector<Sketch::Sample>& samples = sketch->samples;
  const std::size_t every = samples.size() / 8 + 1;
  for (std::size_t i = 0; i < samples.size(); i += every)
    field.add_sensitivity(samples[i].z, samples[i].slope, i, slope);
  slope *= 10.0 * std::numeric_limits<double>::epsilon();
  const double frequency = distance->frequency, time = frequency > 0.0 ? 100.0 / frequency : span;
  VectorX moved = std::min(time, span) * slope;
  moved.head(n) += std::min(time, span) * metric.cwiseProduct(moved.tail(n));
  return moved;
}

/// Finds energies and forces along the sketch with everything at rest. @param drifting set if something
/// moves although all momenta are zero
void Overview::put_at_rest(Eigen::Index seen, bool& drifting) {
  const int n = field.size();
  resting.energy.reserve(sketch->samples.size());
  resting.forces.reserve(sketch->samples.size() * static_cast<std::size_t>(n));
  VectorX rest(2 * n), falling(2 * n);
  for (const Sketch::Sample& sample : sketch->samples) {
    rest.head(n) = sample.z.head(n);
    rest.tail(n).setZero();
    if (question_.timed) rest[n + seen] = sample.z[n + seen];
    double potential = field(rest, falling);
    if (drifting || !falling.head(seen).isZero(0.0)) {
      // These momenta stop all motion if H is quadratic in p with a diagonal; the forces there are those of
      // V.
      drifting = true;
      rest.segment(n, seen) = -sense * falling.head(seen).cwiseQuotient(metric.head(seen));
      potential = field(rest, falling);
    }
    resting.energy.push_back(potential);
    resting.forces.insert(resting.forces.end(), falling.begin() + n, falling.end());
  }
}

/// Sets the mean speed along the sketch and the highest speed that is expected. @return the mean of half
/// of |p q'|, which serves as unit of energy
double Overview::mean_motion(const Ranges& ranges, Eigen::Index seen) {
  const VectorX scales = distance->scales(ranges);
  double work = 0.0, highest = 0.0;
  for (const Sketch::Sample& sample : sketch->samples) {
    work += sample.h * 0.5 * std::abs(dot(sample.z.segment(field.size(), seen), sample.slope.head(seen)));
    const double speed = distance->speed(sample.slope, scales);
    usual_speed += sample.h * speed;
    highest = std::max(highest, speed);
  }
  const double time = std::max(sketch->time, 1e-300);
  usual_speed /= time;
  high_speed = std::min(highest, 20.0 * usual_speed);
  if (!(high_speed > 0.0)) high_speed = usual_speed = 1.0 / span;
  return work / time;
}

/// Sets the constants of the monitors: those of an earlier choice if there is one, else means over the
/// sketch.
void Overview::describe_motion(Eigen::Index seen, bool drifting) {
  Choice& choice = answer_.choice;
  if (question_.made) {
    choice.kinetic = question_.made->kinetic;
    choice.accelerations = question_.made->accelerations;
    choice.poles = question_.made->poles;
    choice.drifts = question_.made->drifts;
    return;
  }
  double kinetic = 0.0;
  for (std::size_t i = 0; i < resting.energy.size(); ++i)
    kinetic += sketch->samples[i].h * (sketch->samples[i].energy - resting.energy[i]);
  choice.kinetic = kinetic / std::max(sketch->time, 1e-300);
  choice.accelerations = accelerations(*sketch, metric, seen);
  if (drifting) choice.drifts.assign(metric.begin(), metric.begin() + seen);
}

void Overview::take_unit_of_energy(double scale) {
  const double rounding =
      std::numeric_limits<double>::epsilon() * (std::abs(trip->energy_at_start) / scale + 1.0);
  answer_.choice.energy_scale = trip->energy_scale = scale;
  answer_.energy_rounding = trip->rounding = rounding;
  // Inside a step, the polynomial is right to only half of the digits of its end.
  const double inside = std::max(0.1 * std::sqrt(question_.tolerance), 10.0 * question_.tolerance);
  trip->felt = std::max(inside, 1e3 * rounding) * scale;
}

/// Looks for features of H that the orbit may meet: kinks, jumps and poles.
void Overview::look_for_features(double scale) {
  features.emplace(question_.graph, question_.energy, *sketch, question_.timed);
  if (!features->none() || features->hides()) trip->features = &*features;
  parts = parts_of(*field.recording());
  // The effect of a kick grows with the phase up to the end of the run: a kick of this size is felt there.
  const double kick = std::max(question_.tolerance / std::max(radians, 1.0), 30.0 * answer_.energy_rounding);
  trip->kick = kick;
  passes.emplace(question_.graph, question_.energy, *sketch, scale, distance->frequency, kick);
  if (passes->none()) return;
  trip->passes = &*passes;
  const Eigen::Index n = field.size();
  const auto& moves = sketch->samples.front().slope;
  const bool diagonal = parts == Parts::nystrom &&
                        (moves.head(n) - sense * metric.cwiseProduct(trip->start.p)).cwiseAbs().maxCoeff() <=
                            1e-9 * moves.head(n).cwiseAbs().maxCoeff();
  if (diagonal) trip->inverse_masses = metric;
}

}  // namespace avi::detail
