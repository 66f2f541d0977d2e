#include "avi/core/integrate.hpp"

namespace avi::detail {

void require_run(double h, const Until& until) {
  require(std::isfinite(h) && h != 0.0, "Step size h", h, "finite and not zero");
  require(!std::isnan(until.time), "End time", until.time, "a number");
  require(until.steps >= 0, "Number of steps", until.steps, "at least 0");
  require(until.seconds > 0.0, "Number of seconds", until.seconds, "positive");
  require(std::isfinite(until.time) || until.steps < std::numeric_limits<long>::max() ||
              std::isfinite(until.seconds),
          "End of the run", "not set", "a time or a number of steps");
}

std::string describe_end(Outcome outcome, double t, long steps, double residual, const std::string& reason,
                         std::span<const double> q, std::span<const double> p) {
  std::string sentence = joined({"The run ended as ", name(outcome), " after ", steps,
                                 steps == 1 ? " step, at t = " : " steps, at t = ", t});
  const auto list = [&](const char* what, std::span<const double> x) {
    for (std::size_t i = 0; i < x.size(); ++i)
      sentence += joined({i == 0 ? what : " ", x[i]});
    if (!x.empty()) sentence += ")";
  };
  if (outcome == Outcome::not_converged) list(", q = (", q), list(", p = (", p);
  if (!reason.empty())
    sentence += ": " + reason;
  else if (outcome == Outcome::not_converged)
    sentence += joined({", with residual ", residual});
  return sentence + ".";
}

}  // namespace avi::detail
