#pragma once
#include "avi/core/outcome.hpp"
#include "avi/core/require.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>

/// @file
/// State: the point in phase space that integrators advance.

namespace avi {

namespace detail {
/// The type of q and p: a Vector<double, n> that can be initialised from numbers in braces, integers
/// included. Entries that are not set are NaN, so that a forgotten one is detected.
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
      require_size(count);
    std::copy(numbers.begin(), numbers.end(), this->data());
  }
  Entries(double number) requires(n == 1) : Entries({number}) {}  // NOLINT: implicit, for {.q = 0.5}
  /// @throws std::invalid_argument unless there are n numbers.
  template <class Derived>
  Entries(const Eigen::MatrixBase<Derived>& other)
      : Vector<double, n>(of_size(other)) {}  // NOLINT: implicit, as Eigen's own
  using Vector<double, n>::operator=;
  /// @throws std::invalid_argument unless there are n numbers.
  template <class Derived>
  Entries& operator=(const Eigen::MatrixBase<Derived>& other) {
    Vector<double, n>::operator=(of_size(other));
    return *this;
  }
  /// @throws std::invalid_argument unless there are n numbers.
  Entries& operator=(std::initializer_list<double> numbers) { return *this = Entries(numbers); }

 private:
  static void require_size(Eigen::Index count) {
    require(count == n, "Number of entries of q or p", count, "", n, ", the dimension of the State");
  }
  /// Returns its argument if the size is right. Without assertions, Eigen would read beyond a vector that is
  /// too short.
  template <class Derived>
  static const Derived& of_size(const Eigen::MatrixBase<Derived>& other) {
    if constexpr (n != dynamic && Derived::SizeAtCompileTime == dynamic) require_size(other.size());
    return other.derived();
  }
};
}  // namespace detail

/// Position q, momentum p (n entries each) and physical time t. The sign convention is \f$\dot q = \partial
/// H/\partial p\f$, \f$\dot p = -\partial H/\partial q\f$; units are those of the problem. Entries that are
/// not set are NaN; poincare() refuses them, and a run ends as non_finite.
template <int n>
struct State {
  static constexpr int dimension = n;  ///< n, or avi::dynamic.
  detail::Entries<n> q = {};           ///< Position, a Vector<double, n>.
  detail::Entries<n> p = {};           ///< Momentum, conjugate to q.
  double t = 0.0;                      ///< Physical time.

  /// True when every entry of q, p and t is finite.
  [[nodiscard]] bool finite() const {
    double none = t - t;  // NaN where one of them is not finite
    for (const auto* x : {&q, &p})
      for (Eigen::Index i = 0; i < x->size(); ++i)
        none += (*x)[i] - (*x)[i];
    return none == 0.0;
  }
  /// True where all numbers are equal.
  [[nodiscard]] bool operator==(const State& other) const {
    return t == other.t && std::equal(q.begin(), q.end(), other.q.begin(), other.q.end()) &&
           std::equal(p.begin(), p.end(), other.p.begin(), other.p.end());
  }
};

/// Checks a start whose dimension is given at run time.
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
/// Entry k of (q, p, t).
template <int n>
double entry(const State<n>& z, Eigen::Index k) {
  return k < z.q.size() ? z.q[k] : k < z.q.size() + z.p.size() ? z.p[k - z.q.size()] : z.t;
}
/// The name of entry k of (q, p, t).
template <int n>
std::string name_of_entry(const State<n>& z, Eigen::Index k) {
  if (k >= z.q.size() + z.p.size()) return "t";
  return k < z.q.size() ? "q[" + std::to_string(k) + "]" : "p[" + std::to_string(k - z.q.size()) + "]";
}
/// Index in (q, p, t) of the first entry that is infinite or NaN; the number of entries where all are finite.
template <int n>
Eigen::Index first_not_finite(const State<n>& z) {
  Eigen::Index k = 0;
  while (k <= z.q.size() + z.p.size() && std::isfinite(entry(z, k)))
    ++k;
  return k;
}
/// A clause that names the first infinite or NaN entry; empty where all are finite.
template <int n>
std::string not_finite(const State<n>& z) {
  const Eigen::Index k = first_not_finite(z);
  if (k > z.q.size() + z.p.size()) return {};
  const double x = entry(z, k);
  return name_of_entry(z, k) + (std::isnan(x) ? " is nan" : x > 0.0 ? " is inf" : " is -inf");
}
/// The report of an explicit step that led to a state with an entry that is not finite.
template <int n>
StepReport lost_at(const State<n>& z, int evaluations = 1) {
  return {.outcome = Outcome::non_finite,
          .evaluations = evaluations,
          .bad_entry = static_cast<int>(first_not_finite(z))};
}
}  // namespace detail

/// Checks a start: dimension and finite entries.
/// @throws std::invalid_argument unless q and p have the same number of entries, at least 1, and all entries
/// and the time are finite.
template <int n>
void require_start(const State<n>& start) {
  require_dimension(start);
  if (!start.finite())
    throw std::invalid_argument("At the start " + detail::not_finite(start) + "; it must be finite.");
}

}  // namespace avi
