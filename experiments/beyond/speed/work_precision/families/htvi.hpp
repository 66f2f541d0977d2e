#pragma once
#include "beyond/speed/work_precision/scenes/arena.hpp"

#include "avi/htvi/htvi.hpp"
#include "avi/transform/monitors.hpp"

#include <string>

/// @file
/// The stationary HTVI of orders 4 to 16, each with its natural rule.

namespace experiment::work_precision {
/// A problem that knows dV/dq tells it: faster than derivatives taken automatically.
template <class P>
struct Supplied : P {
  template <class S>
  auto d_dq(const avi::Vector<S, P::dimension>& q, const avi::Vector<S, P::dimension>&) const {
    return this->potential_gradient(q);
  }
  template <class S>
  auto d_dp(const avi::Vector<S, P::dimension>&, const avi::Vector<S, P::dimension>& p) const {
    return p;
  }
};

template <class P>
auto supplied(const P& problem) {
  using Vec = avi::Vector<double, P::dimension>;
  if constexpr (avi::SuppliesGradient<P, double, P::dimension> ||
                !requires(Vec q) { problem.potential_gradient(q); })
    return problem;
  else
    return Supplied<P>{problem};
}

/// `coarse` is the coarsest step.
template <class P, class G>
void add_htvi(Scene& scene, const Arena<P>& arena, const std::string& knob, double coarse, const G& monitor) {
  for (const int order : {4, 8, 12, 16})
    scene.families.push_back(
        arena.family("htvi", order, Origin::htvi, knob + " h", geometric(coarse, 0.8, 40),
                     [=](const P& problem, const auto& start) {
                       return avi::htvi_of_order<avi::Generating::type2>(
                           order / 2 - 1, avi::poincare<P::dimension>(supplied(problem), start, monitor),
                           avi::gauss(order / 2));
                     }));
}

}  // namespace experiment::work_precision
