#include "src/delivery/track.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace avi::detail {

State<dynamic> Track::start(std::size_t k) const {
  const auto n = static_cast<std::size_t>(field_.size());
  const double* z = starts_.data() + 2 * n * k;
  return state_of<dynamic>(times_[k], z, z + n, field_.size());
}

void Track::at(double t, double* z) const {
  const double sense = std::copysign(1.0, h_);
  require(!times_.empty() && sense * (t - times_.front()) >= 0.0 && sense * (t - times_.back()) <= 0.0,
          "Time of a solution", t, "in the run, from ", times_.empty() ? t : times_.front(), " to ",
          times_.empty() ? t : times_.back());
  const auto next =
      std::ranges::lower_bound(times_, sense * t, {}, [&](double time) { return sense * time; });
  const auto k = static_cast<std::size_t>(next - times_.begin());
  State<dynamic> there;
  if (times_[k] == t) {
    there = start(k);
  } else {
    const State<dynamic> before = start(k - 1);
    const std::lock_guard lock(mutex_);
    StepReport report{};
    if (!repeated_ || step_ != k) {
      repeated_.reset();
      std::unique_ptr<OrbitSteps> method = pattern_->clone();
      after_ = before;
      report = method->step(after_, h_);
      if (report.ok()) repeated_ = std::move(method), step_ = k;
    }
    if (report.ok())
      report = land(*repeated_->clone(), candidate_, field_, before, repeated_->size(), after_.t, t, there);
    if (!report.ok())
      throw std::runtime_error("A step inside the run failed as " + std::string(name(report.outcome)) + ".");
  }
  std::copy(there.q.data(), there.q.data() + degrees_, z);
  std::copy(there.p.data(), there.p.data() + degrees_, z + degrees_);
}

}  // namespace avi::detail
