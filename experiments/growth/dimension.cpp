#include "growth/axes.hpp"

#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/problems/chain.hpp"

#include <cmath>
#include <limits>
#include <memory>

// Degrees of freedom, their number known at run time.

namespace experiment {

namespace {

constexpr int any = avi::dynamic;

template <class H>
void survey(Axis& axis, const std::string& name, const H& hamiltonian, double power,
            const std::vector<int>& sizes) {
  constexpr long steps = 2;
  for (const int n : sizes) {  // multiples of 7: 2 n partials fill their chunks
    const auto start = avi::Chain::plucked(n);
    const auto method =
        avi::htvi_of_order<avi::Generating::type2>(3, avi::poincare<any>(hamiltonian, start), avi::gauss(2));
    const auto shared = std::make_shared<std::decay_t<decltype(method)>>(method);
    const auto run = [=] {
      auto z = start;
      return avi::integrate(*shared, z, 0.05, {.steps = steps});
    };
    const avi::Run done = run();
    axis.runs.push_back({"dimension", name, static_cast<double>(n), done.steps, done.evaluations,
                         std::nan(""), [=] { run(); }, static_cast<double>(done.evaluations)});
  }
  axis.expected.push_back({"dimension", name, std::nan(""), power, 14.0, 1e3});
}

}  // namespace

Axis along_dimension(bool quick) {
  Axis axis;
  // 2 n / 7 expansions, each of formulas of length n; an automatic gradient goes n / 2 times through them.
  survey(axis, "gradient supplied", avi::Chain{}, 2.0,
         quick ? std::vector{7, 14, 28} : std::vector{7, 14, 21, 28, 42, 56, 84});
  survey(axis, "gradient automatic", avi::Automatic<avi::Chain>{}, 3.0,
         quick ? std::vector{7, 14, 28} : std::vector{7, 14, 21, 28});
  return axis;
}

}  // namespace experiment
