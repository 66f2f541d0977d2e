#include "avi/solve.hpp"

#include "journey.hpp"

#include <optional>
#include <sstream>

namespace avi {

namespace detail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How far apart two states are: the largest difference of an entry of (q, p), relative to the range through
/// which it moves. What moves by rounding alone does not count.
class Distance {
 public:
  /// With the masses of the bodies, by which momenta and positions of different entries can be compared.
  explicit Distance(VectorX metric) : metric_(std::move(metric)) {}

  double operator()(const State<dynamic>& a, const State<dynamic>& b, const Ranges& ranges) const {
    const Eigen::Index n = a.q.size();
    // In units of the kinetic energy the largest motion of all; a range 1e-14 of it is rounding.
    double of_q = 0.0, of_p = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      of_q = std::max(of_q, (ranges.high[i] - ranges.low[i]) / std::sqrt(metric_[i]));
      of_p = std::max(of_p, (ranges.high[n + i] - ranges.low[n + i]) * std::sqrt(metric_[i]));
    }
    double most = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double root = std::sqrt(metric_[i]);
      most = std::max(most, part(a.q[i] - b.q[i], ranges.high[i] - ranges.low[i], 0.0, rounding * of_q * root));
      // A momentum that hardly changes counts by its size.
      const double size = std::max(std::abs(ranges.high[n + i]), std::abs(ranges.low[n + i]));
      most = std::max(most, part(a.p[i] - b.p[i], ranges.high[n + i] - ranges.low[n + i], 1e-3 * size,
                                 rounding * of_p / root));
    }
    return most;
  }

 private:
  static constexpr double rounding = 1e-14;
  static double part(double difference, double range, double size, double noise) {
    if (difference == 0.0) return 0.0;
    const double scale = std::max({range, size, noise});
    return std::isfinite(difference) ? std::abs(difference) / scale : infinity;
  }
  VectorX metric_;
};

/// The diagonal of H_pp at the start, by two probes with signs: exact where H_pp is diagonal, else near.
VectorX metric_of(const ExpressionGraph& formula, int energy, const VectorX& start) {
  ExpressionGraph graph = formula;
  const int n = graph.inputs() / 2;
  VectorX metric = VectorX::Zero(n);
  const std::vector<int> slope = Reverse(graph).gradient(energy);
  for (int probe = 0; probe < 2; ++probe) {
    std::vector<double> sign(static_cast<std::size_t>(n));
    unsigned bits = 12345u + 777u * static_cast<unsigned>(probe);
    int along = graph.constant(0.0);
    for (int i = 0; i < n; ++i) {
      bits = bits * 1664525u + 1013904223u;
      sign[static_cast<std::size_t>(i)] = bits >> 31 ? 1.0 : -1.0;
      along = graph.binary(bits >> 31 ? Operation::add : Operation::subtract, along, slope[static_cast<std::size_t>(n + i)]);
    }
    RecordedFormula<double> second{Recording(graph, along).gradient(n, n)};
    std::copy(start.data(), start.data() + 2 * n, second.room.arguments());
    second.program.run(second.room);
    for (int i = 0; i < n; ++i)
      metric[i] = std::max(metric[i], sign[static_cast<std::size_t>(i)] * second.partial(i));
  }
  double largest = 0.0;
  for (int i = 0; i < n; ++i)
    if (std::isfinite(metric[i])) largest = std::max(largest, metric[i]);
  for (int i = 0; i < n; ++i)
    if (!(metric[i] > 0.0) || !std::isfinite(metric[i])) metric[i] = largest > 0.0 ? largest : 1.0;
  return metric;
}

/// What the runs up to some time tell about the error of the finer one.
struct Comparison {
  double error = infinity;   ///< Of the finer run at the last mark.
  double growth = 1.0;       ///< Exponent with which errors grow in time.
  double rate = 0.0;         ///< Rate at which they grow exponentially, where they do.
};

/// An orbit that is asked for.
class Orbiter {
 public:
  explicit Orbiter(const Question& question)
      : question_(question), field_(question.graph, question.energy), sense_(question.t_end < question.t ? -1.0 : 1.0) {}

  Answer solve();

 private:
  Journey run(Candidate& candidate, int order, double h, double end, const std::vector<double>& marks,
              double dearest = infinity);
  Comparison compare(const Journey& coarse, const Journey& fine) const;
  double foretold(const Comparison& seen, double from, double to) const;
  Candidate* choose(std::vector<Candidate>& menu, double piece, double aim, int order, double& h);
  void note_trial(const Journey& journey, double error);
  [[nodiscard]] double guess(const Candidate& it, double aim, int order) const;

  const Question& question_;
  PointField field_;
  double sense_;
  std::optional<Trip> trip_;
  std::optional<Sketch> sketch_;
  std::optional<Distance> distance_;
  Answer answer_;
};

Journey Orbiter::run(Candidate& candidate, int order, double h, double end, const std::vector<double>& marks,
                     double dearest) {
  return travel(*trip_, field_, candidate, order, h, end, marks, [&](const Journey& journey) {
    return static_cast<double>(journey.run.evaluations) <= dearest && journey.energy_error < 1e6;
  });
}

void Orbiter::note_trial(const Journey& journey, double error) {
  answer_.choice.trials.push_back({.monitor = journey.candidate->name,
                                   .order = journey.order,
                                   .h = journey.h,
                                   .time = std::abs(journey.state.t - question_.t),
                                   .steps = journey.run.steps,
                                   .sweeps = journey.run.evaluations,
                                   .state_error = journey.ok() ? error : infinity,
                                   .outcome = journey.run.outcome});
  answer_.choice.sweeps += journey.run.evaluations;
}

/// The error of a run with step h is (h / coarse h)^order of the coarse one's; half of that is trusted.
double trusted(const Journey& coarse, const Journey& fine) {
  return std::max(1.0, 0.5 * std::pow(coarse.h / fine.h, fine.order));
}

Comparison Orbiter::compare(const Journey& coarse, const Journey& fine) const {
  Comparison seen;
  const std::size_t marks = std::min(coarse.marks.size(), fine.marks.size());
  if (marks == 0) return seen;
  const double ratio = trusted(coarse, fine);
  double early = 0.0, late = 0.0;
  for (std::size_t i = 0; i < marks; ++i) {
    const double apart = (*distance_)(coarse.marks[i], fine.marks[i], fine.ranges);
    (2 * (i + 1) <= marks ? early : late) = std::max(2 * (i + 1) <= marks ? early : late, apart);
  }
  seen.error = std::max(early, late) / ratio;
  if (early > 0.0 && late > 3.5 * early) {
    seen.growth = std::min(3.0, std::log2(late / early));
    if (late > 12.0 * early)
      seen.rate = std::log(late / early) / std::abs(fine.marks[marks - 1].t - fine.marks[(marks - 1) / 2].t);
  }
  return seen;
}

double Orbiter::foretold(const Comparison& seen, double from, double to) const {
  if (!(to > from)) return seen.error;
  return seen.rate > 0.0 ? seen.error * std::exp(std::min(700.0, seen.rate * (to - from)))
                         : seen.error * std::pow(to / from, seen.growth);
}

double Orbiter::guess(const Candidate& it, double aim, int order) const {
  const double radians = std::clamp(6.0 * std::pow(aim, 1.0 / order), 0.05, 2.2);
  // The longest step in radians decides.
  double longest = 0.0;
  for (const Sketch::Sample& sample : sketch_->samples)
    longest = std::max(longest, const_cast<Candidate&>(it).rate(sample.z.data()) * sample.frequency);
  return longest > 0.0 ? radians / longest : infinity;
}

/// The candidate with the least work for the error `aim` at the end of a short piece, and a first step.
Candidate* Orbiter::choose(std::vector<Candidate>& menu, double piece, double aim, int order, double& h) {
  struct Tried {
    Candidate* it;
    Journey journey;
    double cost, wanted;
  };
  const double end = question_.t + sense_ * piece;
  std::vector<Tried> tried;
  std::optional<Journey> reference;
  double of_reference = 0.0, best = infinity;
  Candidate* chosen = nullptr;
  for (Candidate& it : menu) {
    if (trip_->spent(0)) break;
    if (chosen && it.outlook > 2.5 * menu.front().outlook && std::isfinite(best)) break;
    const double longest = piece * it.fictive / sketch_->time;
    double first = std::min(guess(it, aim, order), longest);
    for (int attempt = 0; attempt < 6; ++attempt, first *= 0.4) {
      Journey journey = run(it, order, first, end, {}, std::max(1e3, 4.0 * best / it.operations()));
      if (!journey.ok()) {
        note_trial(journey, infinity);
        if (journey.run.outcome == Outcome::stopped || journey.spent) break;
        continue;
      }
      double error;
      if (!reference) {
        Journey finer = run(it, order, 0.8 * first, end, {});
        if (!finer.ok()) {
          note_trial(finer, infinity);
          continue;
        }
        error = (*distance_)(journey.state, finer.state, finer.ranges);
        of_reference = error / trusted(journey, finer);
        note_trial(finer, of_reference);
        reference = std::move(finer);
      } else {
        error = std::max((*distance_)(journey.state, reference->state, reference->ranges), of_reference);
      }
      note_trial(journey, error);
      const double wanted =
          first * std::clamp(std::pow(0.5 * aim / std::max(error, 1e-300), 1.0 / order), 0.1, 1.5);
      const double cost = static_cast<double>(journey.run.evaluations) * it.operations() * first / wanted;
      if (cost < best) {
        best = cost;
        chosen = &it;
        h = std::min(wanted, longest);
      }
      break;
    }
  }
  return chosen;
}

Answer Orbiter::solve() {
  const int n = field_.size();
  VectorX start(2 * n);
  std::copy(question_.q.begin(), question_.q.end(), start.data());
  std::copy(question_.p.begin(), question_.p.end(), start.data() + n);
  VectorX slope(2 * n);
  const double energy = field_(start, slope);
  if (!std::isfinite(energy) || !start.allFinite())
    throw std::invalid_argument("The energy at the start is not finite; an orbit needs one that is.");
  answer_.tolerance = question_.tolerance;
  answer_.q = question_.q, answer_.p = question_.p, answer_.t = question_.t;
  const double span = std::abs(question_.t_end - question_.t);
  if (span == 0.0) return answer_;
  for (double& x : answer_.q) x = std::numeric_limits<double>::quiet_NaN();
  for (double& x : answer_.p) x = std::numeric_limits<double>::quiet_NaN();

  distance_.emplace(metric_of(question_.graph, question_.energy, start));
  field_.sense = sense_;
  sketch_.emplace(field_, start, span);
  field_.sense = 1.0;
  const Sketch& sketch = *sketch_;
  // Means over the sketch: kinetic energy, and half of p q'.
  double work = 0.0, kinetic = 0.0;
  {
    const VectorX rest = VectorX::Zero(n);
    VectorX dz(2 * n);
    for (const Sketch::Sample& sample : sketch.samples) {
      const double here = field_(sample.z, dz);
      work += sample.h * 0.5 * std::abs(sample.z.tail(n).dot(dz.head(n)));
      kinetic += sample.h * (here - field_.energy(sample.z.data(), rest.data()));
    }
    work /= std::max(sketch.time, 1e-300), kinetic /= std::max(sketch.time, 1e-300);
  }
  const double scale = work > 0.0 && std::isfinite(work) ? work : energy != 0.0 ? std::abs(energy) : 1.0;
  answer_.choice.energy_scale = scale;
  answer_.energy_rounding = std::numeric_limits<double>::epsilon() * (std::abs(energy) / scale + 1.0);
  State<dynamic> z{.q = start.head(n), .p = start.tail(n), .t = question_.t};
  trip_.emplace(Trip{question_.graph, question_.energy, z, energy, scale, sense_, question_.options});

  std::vector<Candidate> menu =
      candidates(question_.graph, question_.energy, energy, start, sketch, kinetic);

  // Radians of the whole, of the part over which two runs are compared, and of a short trial.
  const double per_time = sketch.radians / std::max(sketch.time, 1e-300);
  const double radians = per_time * span;
  const double compared = radians <= 110.0 ? span : std::min(span, std::max(sketch.time_of(48.0), 0.06 * span));
  const double piece = std::min(compared, sketch.time_of(24.0));
  answer_.choice.time = piece;
  const double aim = std::max(question_.tolerance * compared / span, 1e-15);
  const int order = aim > 1e-8 ? 8 : 16;
  double h = 0.0;
  const double piece_aim = std::max(aim * piece / compared, 1e-15);
  Candidate* it = choose(menu, piece, piece_aim, order, h);
  const auto fail = [&](Outcome outcome, std::string message) {
    answer_.run.outcome = outcome;
    answer_.run.message = std::move(message);
    answer_.state_error = infinity;
    return answer_;
  };
  if (!it) {
    return fail(Outcome::not_converged, "No run came through the first part of the orbit: it may meet a singularity of H.");
  }
  // Two runs over the part that is compared, with shorter steps until they agree.
  std::vector<double> marks;
  if (compared < span)
    for (int k = 1; k <= 4; ++k)
      marks.push_back(question_.t + sense_ * compared * 0.25 * k);
  else
    marks = {question_.t_end};
  const double there = marks.back();
  const auto total = [&](const Journey& fine, const Comparison& seen) {
    const bool hidden = fine.energy_error <= 100.0 * answer_.energy_rounding;
    return std::max(foretold(seen, compared, span) / question_.tolerance,
                    hidden ? 0.0 : fine.energy_error / (3.0 * question_.tolerance));
  };
  std::optional<Journey> coarse, fine;
  Comparison seen;
  double error = infinity, before = infinity;
  const double longest = compared * it->fictive / sketch.time;
  double next = std::min(1.25 * h, longest);
  for (int round = 0; round < 12; ++round) {
    Journey journey = run(*it, order, next, there, marks);
    if (!journey.ok()) {
      note_trial(journey, infinity);
      if (journey.spent) {
        fine = std::move(journey);
        break;
      }
      next *= 0.6;
      if (fine && next < 0.3 * fine->h) break;
      continue;
    }
    coarse = std::move(fine);
    fine = std::move(journey);
    if (!coarse) {
      note_trial(*fine, infinity);
      next = 0.8 * fine->h;
      continue;
    }
    seen = compare(*coarse, *fine);
    before = error;
    error = total(*fine, seen);
    note_trial(*fine, seen.error);
    if (error <= 1.0) break;
    // Shorter steps no longer help: rounding, or chaos that magnifies it.
    if (error > 0.5 * before && round > 3) break;
    next = fine->h * std::clamp(std::pow(0.4 / error, 1.0 / order), 0.35, 0.85);
  }
  if (!fine) return fail(Outcome::not_converged, "No step size brought a run to the end.");
  Journey whole = *fine;
  if (compared < span && fine->ok()) {
    answer_.choice.sweeps += 0;
    for (int restart = 0;; ++restart) {
      const double limit = 3.0 * question_.tolerance;
      whole = travel(*trip_, field_, *it, order, fine->h * std::pow(0.8, restart), question_.t_end, {},
                     [&](const Journey& journey) {
                       return restart == 6 || journey.energy_error <= std::max(limit, 3.0 * fine->energy_error) ||
                              journey.energy_error <= 100.0 * answer_.energy_rounding;
                     });
      if (whole.ok() || whole.spent || restart == 6) break;
      note_trial(whole, infinity);
    }
  } else {
    answer_.choice.sweeps -= fine->run.evaluations;
    if (!answer_.choice.trials.empty()) answer_.choice.trials.pop_back();
  }
  answer_.choice.name = it->name;
  answer_.choice.order = order;
  answer_.choice.h = whole.h;
  answer_.run = whole.run;
  answer_.energy_error = whole.energy_error;
  answer_.state_error = coarse ? foretold(seen, compared, span) : infinity;
  if (!whole.ok()) {
    answer_.state_error = infinity;
    answer_.run.message = describe_end(whole.run.outcome, whole.state, whole.run.steps, 0.0);
  }
  if (seen.rate > 0.0)
    answer_.note += "Neighbouring orbits move apart exponentially here: the state at the end depends on more digits than the tolerance has. ";
  std::copy(whole.state.q.begin(), whole.state.q.end(), answer_.q.begin());
  std::copy(whole.state.p.begin(), whole.state.p.end(), answer_.p.begin());
  answer_.t = whole.state.t;
  return answer_;
}

}  // namespace

Answer answer(const Question& question) {
  require_finite("Time of the start", question.t);
  require(std::isfinite(question.t_end), "End time", question.t_end, "finite");
  require(question.tolerance >= 1e-13 && question.tolerance <= 1e-2, "Tolerance", question.tolerance,
          "in [1e-13, 1e-2]");
  require(question.options.seconds >= 0.0, "Bound on seconds", question.options.seconds, "at least 0");
  require(question.options.sweeps >= 1, "Bound on sweeps", question.options.sweeps, "at least 1");
  return Orbiter(question).solve();
}

}  // namespace detail

std::string SolutionReport::report() const {
  std::ostringstream text;
  text.precision(3);
  if (!ok()) text << run.message << "\n";
  text << run.steps << " steps, " << run.evaluations << " sweeps: monitor " << choice.name << ", order "
       << choice.order << ", h = " << choice.h << "; chosen in " << choice.sweeps << " sweeps of "
       << choice.trials.size() << " trials.\n";
  text << "State at the end: error about " << state_error << ", tolerance " << tolerance
       << "; largest energy error " << energy_error << " of the scale " << choice.energy_scale << ".\n";
  if (!note.empty()) text << note << "\n";
  for (const SolveTrial& trial : choice.trials)
    text << "  " << trial.monitor << ", order " << trial.order << ": h = " << trial.h << " for " << trial.time
         << ", " << trial.steps << " steps, " << trial.sweeps << " sweeps, error " << trial.state_error << ", "
         << name(trial.outcome) << "\n";
  return text.str();
}

}  // namespace avi
