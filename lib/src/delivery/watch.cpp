#include "src/delivery/watch.hpp"

#include "avi/core/event.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace avi::detail {

namespace {

// Number of parts of a step, at whose ends g is sampled: more where the samples are not on a smooth curve.
constexpr int fewest_parts = 8, most_parts = 1024;

/// The method as it is after the step, which repeats the step in parts.
struct Repeated {
  static constexpr bool one_step = false;
  std::shared_ptr<const OrbitSteps> pattern;
  std::unique_ptr<OrbitSteps> own{};

  explicit Repeated(std::shared_ptr<const OrbitSteps> steps) : pattern(std::move(steps)) {}
  Repeated(const Repeated& other) : pattern(other.pattern) {}
  Repeated& operator=(const Repeated&) = delete;
  StepReport step(State<dynamic>& z, double h) {
    if (!own) own = pattern->clone();
    return own->step_inside(z, h);
  }
};

/// The states inside a step that the method itself finds.
class Exact {
 public:
  explicit Exact(const Stride& stride)
      : stride_(stride), method_(std::shared_ptr<const OrbitSteps>(stride.method.clone())) {}
  [[nodiscard]] Step<Repeated, State<dynamic>> step() const {
    return {method_, stride_.before, stride_.last, stride_.h};
  }
  [[nodiscard]] Located<State<dynamic>> at(double part) const {
    if (part == 0.0) return {.state = stride_.before, .report = {.evaluations = 0}};
    if (part == stride_.part) return {.state = stride_.last, .report = {.evaluations = 0}};
    return step().part(part);
  }
  [[nodiscard]] const Repeated& method() const { return method_; }

 private:
  const Stride& stride_;
  Repeated method_;
};

}  // namespace

double Watch::at(const double* q, const double* p, double t) {
  if (timed_) formula_.room.arguments()[2 * degrees_] = t;
  formula_.run(q, p, degrees_);
  return formula_.value();
}

/// Whether a step is so short that what is between its ends is rounding, as one over the last digit before a
/// switch.
bool Watch::is_brief(const Stride& stride) {
  return std::abs(stride.last.t - stride.before.t) <= 4.0 * rounding_of_time(stride.before.t, stride.last.t);
}

double Watch::on(const Stride& stride, double part) {
  const Eigen::Index n = stride.before.q.size();
  double t = 0.0;
  inside_.resize(2 * n);
  stride.method.roughly(part, inside_, t);
  return at(inside_.data(), inside_.data() + n, t);
}

double Watch::rounding(const State<dynamic>& z, const State<dynamic>& after) {
  return rounding_of([this](const State<dynamic>& there) { return at(there); }, z, after);
}

/// Doubles the number of samples of g until those in between lie on a cubic through the others. @param soon
/// number of points just after the start, which are on no such grid @return true if they do
bool Watch::refine(const Stride& stride, std::size_t soon) {
  double noise = -1.0;
  for (int parts = fewest_parts;; parts *= 2) {
    const auto value = [&](int k) { return samples_[k == 0 ? 0 : soon + static_cast<std::size_t>(k)].g; };
    double least = value(0), most = least, apart = 0.0;
    for (int k = 1; k <= parts; ++k)
      least = std::min(least, value(k)), most = std::max(most, value(k));
    for (int k = 1; k < parts; k += 2) {
      const double between =
          k == 1 ? (5.0 * value(0) + 15.0 * value(2) - 5.0 * value(4) + value(6)) / 16.0
          : k + 1 == parts
              ? (5.0 * value(parts) + 15.0 * value(parts - 2) - 5.0 * value(parts - 4) + value(parts - 6)) /
                    16.0
              : (9.0 * (value(k - 1) + value(k + 1)) - value(k - 3) - value(k + 3)) / 16.0;
      apart = std::max(apart, std::abs(value(k) - between));
    }
    // A function as fast as the grid may look slow on it, but not off it. One point off the grid in each cell
    // would not do: if a cell holds 13, 21 or 34 periods, its golden section lies near a whole number of
    // them.
    constexpr std::array<double, 5> asides{0.381966, 0.414214, 0.267949, 0.302776, 0.449490};
    constexpr std::array<int, 5> eighths{1, 2, 3, 5, 6};
    for (std::size_t i = 0; i < asides.size(); ++i) {
      const double aside = asides[i], l0 = -aside * (aside - 1.0) * (aside - 2.0) / 6.0,
                   l1 = (aside + 1.0) * (aside - 1.0) * (aside - 2.0) / 2.0,
                   l2 = -(aside + 1.0) * aside * (aside - 2.0) / 2.0,
                   l3 = (aside + 1.0) * aside * (aside - 1.0) / 6.0;
      const int k = eighths[i] * parts / 8;
      const double here = on(stride, stride.part * (k + aside) / parts);
      least = std::min(least, here), most = std::max(most, here);
      const double between = l0 * value(k - 1) + l1 * value(k) + l2 * value(k + 1) + l3 * value(k + 2);
      apart = std::max(apart, std::abs(here - between));
    }
    if (!(apart > 0.1 * (most - least))) return true;
    if (noise < 0.0) noise = rounding(stride.before, stride.last);
    if (!(most - least > 100.0 * noise)) return true;
    if (parts == most_parts) return false;
    std::vector<Sample> finer(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(soon) + 1);
    for (int k = 1; k <= 2 * parts; ++k) {
      const double part = stride.part * k / (2 * parts);
      finer.push_back(k % 2 == 0 ? samples_[soon + static_cast<std::size_t>(k / 2)]
                                 : Sample{part, on(stride, part)});
    }
    samples_ = std::move(finer);
  }
}

/// Samples g along the step; if the run starts on the event, from where g has left it.
void Watch::sample(const Stride& stride, bool first) {
  samples_.clear();
  const double begin = at(stride.before), end = at(stride.last);
  samples_.push_back({0.0, begin});
  if (first) {
    memory_.level =
        std::abs(begin) <= 1e-3 * std::abs(end - begin) ? rounding(stride.before, stride.last) : 0.0;
    memory_.leaving = std::abs(begin) <= memory_.level;
  }
  if (memory_.leaving)
    for (const double part : {0x1p-26, 0x1p-20, 0x1p-14, 0x1p-8, 0x1p-5})
      samples_.push_back({part * stride.part, on(stride, part * stride.part)});
  const std::size_t soon = samples_.size() - 1;  // number of points just after the start
  for (int k = 1; k < fewest_parts && !is_brief(stride); ++k) {
    const double part = stride.part * k / fewest_parts;
    samples_.push_back({part, on(stride, part)});
  }
  samples_.push_back({stride.part, end});
  smooth_ = is_brief(stride) || refine(stride, soon);
  if (!memory_.leaving) return;
  const auto left =
      std::ranges::find_if(samples_, [&](const Sample& it) { return !(std::abs(it.g) <= memory_.level); });
  memory_.leaving = left == samples_.end();
  samples_.erase(samples_.begin(), left);
}

/// Adds samples just beside those that are zero by chance: these have no sign, and another zero may be near.
void Watch::add_beside_zeros(const Stride& stride) {
  std::vector<Sample> beside;
  for (std::size_t k = 0; k + 1 < samples_.size(); ++k) {
    const Sample &a = samples_[k], &b = samples_[k + 1];
    if ((a.g == 0.0) == (b.g == 0.0)) continue;
    const double from = a.g == 0.0 ? a.part : b.part, part = from + 1e-6 * (a.part + b.part - 2.0 * from);
    beside.push_back({part, on(stride, part)});
  }
  if (beside.empty()) return;
  samples_.insert(samples_.end(), beside.begin(), beside.end());
  std::ranges::sort(samples_, {}, &Sample::part);
}

/// Adds samples between two that do not show the zeros between them.
void Watch::add_turning_points(const Stride& stride, long& evaluations) {
  std::optional<Dips> dips;
  const auto look_here = [&](double variation) {
    if (!dips) {
      noise_ = rounding(stride.before, stride.last);
      const auto exact = [&](double part) {
        const Located<State<dynamic>> there = Exact(stride).at(part);
        evaluations += there.evaluations;
        return there.ok() ? at(there.state) : std::numeric_limits<double>::quiet_NaN();
      };
      dips.emplace([&](double part) { return on(stride, part); }, exact, stride.part, noise_, 300);
    }
    return variation > 100.0 * noise_;
  };
  for (std::size_t k = samples_.size(); k-- > 1;) {  // there may be no samples
    if (!Dips::grazes(samples_, k)) continue;
    if (!look_here(std::max(std::abs(samples_[k - 1].g), std::abs(samples_[k + 1].g)))) continue;
    samples_[k - 1].turns = true;
    samples_.erase(samples_.begin() + static_cast<std::ptrdiff_t>(k));
  }
  add_beside_zeros(stride);
  std::vector<Sample> more;
  for (std::size_t k = 0; k + 1 < samples_.size(); ++k) {
    const Sample &a = samples_[k], &b = samples_[k + 1];
    if (a.g == 0.0 || b.g == 0.0 || !Dips::may_hide(samples_, k)) continue;
    if (look_here(std::max(std::abs(a.g), std::abs(b.g)))) dips->look(a, b, more);
  }
  if (more.empty()) return;
  samples_.insert(samples_.end(), more.begin(), more.end());
  std::ranges::sort(samples_, {}, &Sample::part);
}

/// The state on g = 0 in the straight piece with which a landing ends. @param begin state at the beginning of
/// that piece
State<dynamic> Watch::between(const State<dynamic>& begin, const State<dynamic>& end) {
  const double at_begin = at(begin), at_end = at(end), part = at_begin / (at_begin - at_end);
  State<dynamic> there = begin;
  there.q += part * (end.q - begin.q);
  there.p += part * (end.p - begin.p);
  there.t += part * (end.t - begin.t);
  return at(there) * at_end >= 0.0 ? there : end;
}

/// Finds the zero between the samples k and k + 1 of the step, by steps of the method. It may lie beside
/// them, as the polynomial of a step is not quite equal to its states. @param none set if there is no zero:
/// only the polynomial had one
Hit Watch::locate(const Stride& stride, std::size_t k, long& evaluations, bool& none) {
  const Sample &low = samples_[k], &high = samples_[k + 1];
  const double lowest = low.exact ? low.part : samples_[std::max<std::size_t>(k, 1) - 1].part,
               highest = high.exact ? high.part : samples_[std::min(k + 2, samples_.size() - 1)].part;
  const double sign = std::copysign(1.0, high.g == 0.0 ? -low.g : high.g);
  const double place = bracketed_root([&](double part) { return sign * on(stride, part); }, low.part,
                                      sign * low.g, high.part, sign * high.g, 0.0)
                           .x;
  const Exact exact(stride);
  const auto there = [&](double part) {
    Located<State<dynamic>> found = exact.at(part);
    evaluations += found.evaluations;
    return found;
  };
  Hit hit{.state = stride.before, .index = index_};
  const auto fail = [&](const Located<State<dynamic>>& found) {
    hit.state = stride.method.polynomial(low.part);  // zeros before it count
    hit.outcome = found.report.outcome;
    hit.reason = found.reason.empty() ? "a step to g = 0 failed" : found.reason;
    return hit;
  };
  // Where time is far from zero, the interval is wide enough for the clock to have numbers beside the zero:
  // the change of g over them tells a zero from a jump.
  const double tick = rounding_of_time(stride.before.t, stride.last.t) * stride.part /
                      std::abs(stride.last.t - stride.before.t);
  for (double width = std::max(1e-5, 32.0 * tick);; width *= 40.0) {
    const double from = std::max(lowest, place - width), to = std::min(highest, place + width);
    Located<State<dynamic>> end = there(to);
    const Located<State<dynamic>> begin = there(from);
    if (!end.ok()) return fail(end);
    if (!begin.ok()) return fail(begin);
    double at_end = at(end.state);
    const double at_begin = at(begin.state);
    const bool widest = from == lowest && to == highest;
    if (sign * at_begin < 0.0 && sign * at_end >= 0.0) {
      if (to == stride.part && stride.part < 1.0) {
        Located<State<dynamic>> landed = exact.step().part(to);
        evaluations += landed.evaluations;
        if (!landed.ok()) return fail(landed);
        if (sign * at(landed.state) < 0.0) {
          hit.state = between(landed.state, end.state);
          return hit;
        }
        end = std::move(landed);
        at_end = at(end.state);
      }
      if (at_end == 0.0) {
        hit.state = end.state;
        return hit;
      }
      const Step<Repeated, State<dynamic>> step{exact.method(), stride.before, end.state, to * stride.h};
      Located<State<dynamic>> found = step.locate(
          from / to, at_begin, [&](const State<dynamic>& z) { return at(z); }, 0.0);
      evaluations += found.evaluations;
      if (!found.ok()) return fail(found);
      hit.state = std::move(found.state);
      return hit;
    }
    if (widest) break;
  }
  none = true;
  return hit;
}

long Watch::look(const Stride& stride, bool first, std::vector<Hit>& hits) {
  if (over()) return 0;
  long evaluations = 0, found = memory_.found;
  sample(stride, first);
  // An event may still come just before g becomes nan.
  const auto undefined = std::ranges::find_if(samples_, [](const Sample& it) { return std::isnan(it.g); });
  std::optional<double> ends;
  if (undefined != samples_.end()) ends = undefined->part;
  samples_.erase(undefined, samples_.end());
  for (int k = 0; k < 40 && ends && !samples_.empty(); ++k) {
    const double part = 0.5 * (samples_.back().part + *ends), g = on(stride, part);
    if (std::isnan(g))
      ends = part;
    else
      samples_.push_back({part, g});
  }
  if (!is_brief(stride)) add_turning_points(stride, evaluations);
  int changes = 0;
  for (std::size_t k = 1; k < samples_.size(); ++k)
    changes += samples_[k - 1].g * samples_[k].g < 0.0 ? 1 : 0;
  if (!smooth_ && changes > 8) {  // a jump changes the sign once
    hits.push_back({stride.before, index_, Outcome::not_converged,
                    "g of the event changes its sign more often in a step than can be told apart"});
    return evaluations;
  }
  for (std::size_t k = 0; k + 1 < samples_.size(); ++k) {
    if (!crosses(samples_[k].g, samples_[k + 1].g)) continue;
    bool none = false;
    Hit hit = locate(stride, k, evaluations, none);
    if (none) continue;
    hits.push_back(std::move(hit));
    if (hits.back().outcome != Outcome::ok || ++found == rules_.count) return evaluations;
  }
  if (ends) {
    const State<dynamic> there = stride.method.polynomial(*ends);
    hits.push_back({there, index_, Outcome::non_finite, joined({"g of the event is nan at t = ", there.t})});
  }
  return evaluations;
}

}  // namespace avi::detail
