#include "hostile/judge.hpp"

#include "hostile/dice.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

namespace hostile {

const char* name(Verdict verdict) {
  constexpr const char* names[] = {"right", "conditioned", "unsaid",      "beyond",  "WRONG",
                                   "shy",   "said",        "told less",   "refused", "rightly",
                                   "slow",  "CRASH",       "no reference"};
  return names[static_cast<int>(verdict)];
}

bool Truth::good_for(double tolerance) const {
  if (ending != Ending::solved) return false;
  for (std::size_t i = 0; i < end.size(); ++i)
    if (!(doubt[i] <= 0.01L * tolerance * range[i] + rounding[i])) return false;
  return true;
}

Truth truth(const System& system, double most_work) {
  const std::clock_t begin = std::clock();
  Reference reference(system);
  Truth truth;
  const Orbit coarse = reference.run(3e-16L, most_work);
  const Orbit fine = coarse.ending == Ending::solved ? reference.run(1e-17L, 2.0 * most_work) : coarse;
  truth.ending = fine.ending;
  const auto spent = [&] { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; };
  if (truth.ending != Ending::solved) return truth.seconds = spent(), truth;
  const std::size_t size = fine.end.size(), n = size / 2;
  const auto natural = [&](std::size_t i) -> Real {
    return i < n ? system.q_scale[i] : system.p_scale[i - n];
  };
  truth.end = fine.end;
  truth.range.resize(size), truth.doubt.resize(size), truth.rounding.assign(size, Real(0));
  for (std::size_t i = 0; i < size; ++i) {
    // Where an entry does not move, or by less than 1e-8 of itself, its size tells rounding from error.
    const Real far = std::max(std::abs(fine.high[i]), std::abs(fine.low[i]));
    truth.range[i] = std::max({fine.high[i] - fine.low[i], 1e-8L * far, 1e-12L * natural(i)});
    truth.doubt[i] = std::abs(fine.end[i] - coarse.end[i]);
  }
  const auto widen = [&](const Vector& end, const Vector& from, Real factor) {
    for (std::size_t i = 0; i < size; ++i) {
      const Real off = std::abs(end[i] - from[i]);
      truth.rounding[i] = std::max(truth.rounding[i],
                                   std::isfinite(off) ? factor * off : std::numeric_limits<Real>::infinity());
    }
  };
  Dice dice(1, 0);
  for (int run = 0; run < 3; ++run) {
    Vector start = reference.start();
    for (std::size_t i = 0; i < size; ++i)
      start[i] += 1e-15L * dice.between(-1.0, 1.0) *
                  std::max(std::abs(start[i]), std::min(truth.range[i], natural(i)));
    widen(reference.repeat(start, coarse.steps, false).end, coarse.end, 100);
  }
  widen(reference.repeat(reference.start(), coarse.steps, true).end, coarse.end, 10);
  // The end is stored in double precision, and so is the time.
  const Real epsilon = std::numeric_limits<double>::epsilon();
  const Real clock = epsilon * static_cast<Real>(std::max(std::abs(system.t), std::abs(system.t_end)));
  for (std::size_t i = 0; i < size; ++i)
    truth.rounding[i] += 4 * epsilon * std::abs(fine.end[i]) + 4 * clock * std::abs(fine.slope[i]);
  truth.seconds = spent();
  return truth;
}

Judgement judge(const System& system, const Truth& truth, const Answer& answer, double tolerance,
                double seconds) {
  Judgement judgement;
  Verdict& verdict = judgement.verdict;
  if (answer.crashed) return verdict = Verdict::crash, judgement;
  if (answer.too_slow || answer.seconds > seconds) return verdict = Verdict::slow, judgement;
  const bool arrived = answer.returned && answer.ok && answer.t == system.t_end;
  if (truth.ending == Ending::singular && !arrived) return verdict = Verdict::rightly, judgement;
  if (!truth.good_for(tolerance)) return verdict = Verdict::no_reference, judgement;

  const std::size_t size = truth.end.size(), n = size / 2;
  bool hopeless = false;
  Real error = 0, blamed = 0, squares[2] = {0, 0}, ranges[2] = {0, 0};
  for (std::size_t i = 0; i < size; ++i) {
    hopeless |= truth.rounding[i] > 10 * tolerance * truth.range[i];
    if (!arrived) continue;
    const Real is = i < n ? answer.q[i] : answer.p[i - n];
    Real off = std::abs(is - truth.end[i]);
    if (!std::isfinite(off)) off = std::numeric_limits<Real>::infinity();
    const Real natural = i < n ? system.q_scale[i] : system.p_scale[i - n];
    squares[i >= n] += off / natural * (off / natural);
    ranges[i >= n] += truth.range[i] / natural * (truth.range[i] / natural);
    const Real excess = off <= truth.rounding[i] ? 0 : (off - truth.rounding[i]) / truth.range[i];
    if (excess > blamed || (blamed == 0 && off / truth.range[i] > error)) {
      error = off / truth.range[i];
      judgement.entry = static_cast<int>(i);
      judgement.rounding = static_cast<double>(truth.rounding[i] / truth.range[i]);
    }
    blamed = std::max(blamed, excess);
  }
  judgement.error = static_cast<double>(error), judgement.blamed = static_cast<double>(blamed);
  for (int part = 0; part < 2; ++part)
    judgement.norm = std::max(judgement.norm, static_cast<double>(std::sqrt(squares[part] / ranges[part])));

  const double allowed = 100.0 * tolerance;
  if (!arrived)
    verdict = answer.ok ? Verdict::wrong : hopeless ? Verdict::rightly : Verdict::refused;
  else if (!answer.kept && judgement.error <= 10.0 * tolerance)
    verdict = Verdict::shy;
  else if (!answer.kept)
    verdict = judgement.blamed <= 100.0 * std::max(answer.state_error, tolerance) ? Verdict::said
                                                                                  : Verdict::told_less;
  else if (judgement.error <= allowed)
    verdict = Verdict::right;
  else if (judgement.blamed <= allowed)
    verdict = judgement.error <= 1e-2 ? Verdict::conditioned : Verdict::unsaid;
  else
    verdict = judgement.blamed <= 1e-2 ? Verdict::beyond : Verdict::wrong;
  return judgement;
}

}  // namespace hostile
