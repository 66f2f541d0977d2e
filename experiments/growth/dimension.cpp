#include "growth/axes.hpp"

#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"

#include <cmath>
#include <limits>
#include <memory>

// Degrees of freedom, their number known at run time.

namespace experiment {

namespace {

constexpr int any = avi::dynamic;
template <class S>
using Vec = avi::Vector<S, any>;

/// Masses on a line between walls, coupled by springs with a quadratic term in their force (Fermi, Pasta,
/// Ulam and Tsingou), with their gradient.
struct Chain {
  template <class Q, class P>
  auto operator()(const Q& q, const P& p) const {
    const auto spring = [](const auto& x) { return 0.5 * (x * x) + 0.25 * (x * x * x); };
    auto sum = spring(q[0]) + spring(-q[q.size() - 1]);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      sum += 0.5 * (p[i] * p[i]);
      if (i + 1 < q.size()) sum += spring(q[i + 1] - q[i]);
    }
    return sum;
  }
  template <class S>
  Vec<S> d_dq(const Vec<S>& q, const Vec<S>&) const {
    const auto force = [](const auto& x) { return x + 0.75 * (x * x); };
    Vec<S> slope(q.size());
    S left = force(q[0]);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const S right = force(i + 1 < q.size() ? S(q[i + 1] - q[i]) : S(-q[i]));
      slope[i] = left - right;
      left = right;
    }
    return slope;
  }
  template <class S>
  Vec<S> d_dp(const Vec<S>&, const Vec<S>& p) const {
    return p;
  }
};

avi::State<any> plucked(int masses) {
  avi::State<any> z{.q = Vec<double>(masses), .p = Vec<double>::Zero(masses)};
  for (int i = 0; i < masses; ++i)
    z.q[i] = 0.3 * std::sin(M_PI * (i + 1) / (masses + 1));
  return z;
}

template <class H>
void survey(Axis& axis, const std::string& name, const H& hamiltonian, double power,
            const std::vector<int>& sizes) {
  constexpr long steps = 2;
  for (const int n : sizes) {  // multiples of 7: 2 n partials fill their chunks
    const auto start = plucked(n);
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
  survey(axis, "gradient supplied", Chain{}, 2.0,
         quick ? std::vector{7, 14, 28} : std::vector{7, 14, 21, 28, 42, 56, 84});
  survey(axis, "gradient automatic", avi::Automatic<Chain>{}, 3.0,
         quick ? std::vector{7, 14, 28} : std::vector{7, 14, 21, 28});
  return axis;
}

}  // namespace experiment
