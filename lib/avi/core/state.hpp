#pragma once
#include "avi/core/require.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>

/// @file
/// The point in phase space that every integrator moves.

namespace avi {

namespace detail {
/// The type of q and p: a Vector<double, n> that is written as its numbers in braces, whole ones among them.
/// Entries that are not given are NaN, so that one that was forgotten is refused.
template <int n>
struct Entries : Vector<double, n> {
  Entries() {
    if constexpr (n != dynamic) this->setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  /// @throws std::invalid_argument unless there are n numbers.
  Entries(std::initializer_list<double> numbers) {
    const auto count = static_cast<Eigen::Index>(numbers.size());
    if constexpr (n == dynamic)
      this->resize(count);
    else
      require(count == n, "Number of entries of q or p", count, "", n, ", the dimension of the State");
    std::copy(numbers.begin(), numbers.end(), this->data());
  }
  Entries(double number) requires(n == 1) : Entries({number}) {}  // NOLINT: implicit, for {.q = 0.5}
  template <class Derived>
  Entries(const Eigen::MatrixBase<Derived>& other)
      : Vector<double, n>(other) {}  // NOLINT: implicit, as Eigen's own
  using Vector<double, n>::operator=;
  /// @throws std::invalid_argument unless there are n numbers.
  Entries& operator=(std::initializer_list<double> numbers) { return *this = Entries(numbers); }
};
}  // namespace detail

/// Position q, momentum p (n entries each) and physical time t. The library uses the sign convention
/// \f$\dot q = \partial H/\partial p\f$, \f$\dot p = -\partial H/\partial q\f$; units are the problem's own.
/// Entries that are not given are NaN, which poincare() and a run refuse.
template <int n>
struct State {
  static constexpr int dimension = n;  ///< n, or avi::dynamic.
  detail::Entries<n> q = {};           ///< Position, a Vector<double, n>.
  detail::Entries<n> p = {};           ///< Momentum, conjugate to q.
  double t = 0.0;                      ///< Physical time.

  /// True when every entry of q, p and t is finite.
  [[nodiscard]] bool finite() const {
    // A loop compiles faster than Eigen's tests; this one is vectorised.
    int finite = std::isfinite(t);
    for (const auto* x : {&q, &p})
      for (Eigen::Index i = 0; i < x->size(); ++i)
        finite &= std::abs((*x)[i]) <= std::numeric_limits<double>::max();
    return finite != 0;
  }
  /// The same numbers.
  [[nodiscard]] bool operator==(const State& other) const {
    return t == other.t && std::equal(q.begin(), q.end(), other.q.begin(), other.q.end()) &&
           std::equal(p.begin(), p.end(), other.p.begin(), other.p.end());
  }
};

/// Refuses a start whose dimension, given at run time, is none.
/// @throws std::invalid_argument unless q and p have the same number of entries, at least 1.
template <int n>
void require_dimension([[maybe_unused]] const State<n>& start) {
  if constexpr (n == dynamic) {
    require(start.q.size() >= 1, "Dimension of q at the start", start.q.size(), "at least 1");
    require(start.p.size() == start.q.size(), "Dimension of p at the start", start.p.size(), "that of q, ",
            start.q.size());
  }
}

namespace detail {
/// The first entry that is infinite or NaN, in words; empty where there is none.
template <int n>
std::string not_finite(const State<n>& z) {
  const auto is = [](double x) {
    return std::string(std::isnan(x) ? " is nan" : x > 0.0 ? " is inf" : " is -inf");
  };
  const auto among = [&](const char* name, const auto& x) -> std::string {
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (!std::isfinite(x[i])) return std::string(name) + "[" + std::to_string(i) + "]" + is(x[i]);
    return {};
  };
  const std::string in_q = among("q", z.q), in_p = among("p", z.p);
  if (!in_q.empty()) return in_q;
  if (!in_p.empty()) return in_p;
  return std::isfinite(z.t) ? "" : "t" + is(z.t);
}
}  // namespace detail

/// Refuses a start that is no point of phase space.
/// @throws std::invalid_argument unless q and p have the same number of entries, at least 1, and all entries
/// and the time are finite.
template <int n>
void require_start(const State<n>& start) {
  require_dimension(start);
  if (!start.finite())
    throw std::invalid_argument("At the start " + detail::not_finite(start) + "; it must be finite.");
}

}  // namespace avi
