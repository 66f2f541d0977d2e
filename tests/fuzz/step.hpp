#pragma once
#include "avi/bregman/bregman_htvi.hpp"
#include "avi/bregman/bregman_splitting.hpp"
#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/integrators/coefficient_lists.hpp"
#include "avi/integrators/log_hamiltonian.hpp"
#include "avi/integrators/stormer_verlet.hpp"
#include "avi/optim/run_updates.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"
#include "common/methods/adaptive_verlet.hpp"
#include "common/problems/correlated_quartic.hpp"

#include <cstdint>
#include <cstring>
#include <stdexcept>

/// @file
/// Any numbers as states, steps and parameters: refused, or a run that ends finite and says how.

namespace fuzz {

/// Numbers out of bytes; zero where these have run out.
class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  double real() {
    double value = 0.0;
    take(&value, sizeof value);
    return value;
  }
  int byte() {
    std::uint8_t value = 0;
    take(&value, 1);
    return value;
  }

 private:
  void take(void* to, std::size_t count) {
    if (size_ < count) return;
    std::memcpy(to, data_, count);
    data_ += count;
    size_ -= count;
  }
  const std::uint8_t* data_;
  std::size_t size_;
};

template <class M>
void orbit(M method, const avi::State<2>& start, double h) {
  avi::State<2> z = start, seen = start;
  const avi::Run run =
      avi::integrate(method, z, h, {.steps = 4}, [&](const avi::State<2>& now, long) { seen = now; });
  if (run.steps > 4 || (run.outcome == avi::Outcome::ok) != run.message.empty())
    throw std::logic_error("A run without its end.");
  if (start.finite() && !z.finite()) throw std::logic_error("A run ended with what is not a number.");
  if (start.finite() && (z.q != seen.q || z.p != seen.p || z.t != seen.t))
    throw std::logic_error("A run ended elsewhere than at the last good state.");
}

template <class M>
void descent(const M& method, const avi::VectorX& x0) {
  const experiment::CorrelatedQuartic f(x0.size());
  const avi::Minimisation run = avi::run_updates(f, method, x0, {.iterations = 50});
  if (!(run.last.x.allFinite() && std::isfinite(run.last.value)))
    throw std::logic_error("A minimisation ended at what is not a number.");
  if ((run.outcome == avi::Outcome::ok) != run.message.empty())
    throw std::logic_error("An end without its name.");
}

inline void step(const std::uint8_t* data, std::size_t size) {
  using namespace avi;
  Numbers in(data, size);
  const int which = in.byte() % 9;
  const double h = in.real();
  const State<2> z{.q = {in.real(), in.real()}, .p = {in.real(), in.real()}, .t = in.real()};
  const VectorX x0 = Eigen::Vector2d(z.q);
  const auto bregman = [&](auto method) {
    method.family = BregmanFamily::adaptive(in.real(), in.real(), in.real());
    method.h = h, method.from = {.t = z.p[0], .momentum = z.p[1]};
    descent(method, x0);
  };
  const auto gradient = [](const Vector<double, 2>& q) { return Kepler::potential_gradient(q); };
  try {
    switch (which) {
    case 0:
      return orbit(euler_b<2>(Kepler{}, z, bounded(Gamma{in.real()}, in.real(), in.real())), z, h);
    case 1: {
      const int order = in.byte() % 18 - 1, nodes = in.byte() % 18;
      const auto problem = poincare<2>(Kepler{}, z, Gamma{1.0});
      return orbit(htvi_of_order<Generating::type2>(order, problem, gauss(nodes), {.tolerance = in.real()}),
                   z, h);
    }
    case 2:
      return orbit(stormer_verlet<2>(gradient), z, h);
    case 3:
      return orbit(
          splitting<Summation::compensated>(LogHamiltonian<Kepler>(Kepler{}, z), compositions::kahan_li8), z,
          h);
    case 4: {
      const double c = in.real();
      return orbit(experiment::AdaptiveVerlet(
                       Kepler{}, [c](const auto& q, const auto&) { return c * q.squaredNorm(); }),
                   z, h);
    }
    case 5:
      return bregman(BregmanHtvi{});
    case 6:
      return bregman(BregmanHeavyBall{});
    case 7:
      return bregman(BregmanSplitting{});
    default:
      return orbit(splitting(Separable<Kepler>{}, compositions::kahan_li8), z, h);
    }
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace fuzz
