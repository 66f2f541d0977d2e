#pragma once
#include "avi/autodiff/convolution.hpp"
#include "avi/autodiff/lanes.hpp"

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

/// @file
/// Truncated Taylor series in time, computed one order at a time.
///
/// The Taylor coefficients of a solution of \f$z' = f(z)\f$ follow from \f$z_{k+1} = f_k/(k + 1)\f$, where
/// \f$f_k\f$ needs \f$z_0\f$ to \f$z_k\f$ only. A formula written with Jet is therefore *replayed* once for
/// each order k: the operations come in the same sequence each time, so each finds the slot it wrote at lower
/// orders and adds its coefficient k there. A product costs k + 1 multiplications at order k, hence O(r^2) in
/// all, and the compiler sees straight-line code (recurrences: Jorba and Zou 2005, Proposition 1).

namespace avi {

/// Slots for the series of every intermediate result of a formula. T is double or Lanes<N>.
template <class T, int R>
class JetTape {
 public:
  static constexpr int stride = R + 2;  ///< coefficients 0 to R and one auxiliary number

  JetTape() : JetTape(first_capacity) {}
  /// A copy has room of its own; what is on the tape is scratch and stays behind.
  JetTape(const JetTape& other) : JetTape(other.capacity_) {}
  JetTape& operator=(const JetTape&) = delete;

  /// Begins the replay of order k (used where it is not known at compile time).
  void rewind(int k) {
    next_ = slots_.get();
    end_ = next_ + capacity_;
    order = k;
  }

  /// The next slot. If the tape is full, which can happen at order 0 only, it continues in another block and
  /// order 0 has to be repeated: see outgrown().
  template <int K>
  T* next() {
    if (K <= 0 && order == 0 && next_ == end_) extend();
    return (next_++)->coefficients;
  }

  /// Whether the formula was longer than the tape; if so, the tape has been enlarged and order 0 has to be
  /// replayed. Nothing is allocated once the longest formula has been seen.
  bool outgrown() {
    if (blocks_.empty()) return false;
    blocks_.clear();
    capacity_ *= 2;
    slots_ = std::make_unique_for_overwrite<Slot[]>(capacity_);
    return true;
  }

  int order = 0;  ///< Of the present replay.

 private:
  /// @cond
  struct alignas(sizeof(T) < 64 || alignof(T) > 64 ? alignof(T) : 64) Slot {
    T coefficients[stride];
  };
  /// @endcond

  explicit JetTape(std::size_t slots)
      : capacity_(slots), slots_(std::make_unique_for_overwrite<Slot[]>(slots)) {}
  [[gnu::noinline, gnu::cold]] void extend() {
    blocks_.push_back(std::make_unique_for_overwrite<Slot[]>(capacity_));
    next_ = blocks_.back().get();
    end_ = next_ + capacity_;
    capacity_ *= 2;
  }
  static constexpr std::size_t first_capacity = 64;
  std::size_t capacity_;  // in slots, of all blocks together
  std::unique_ptr<Slot[]> slots_;
  std::vector<std::unique_ptr<Slot[]>> blocks_;  // what order 0 asked for beyond
  Slot *next_ = nullptr, *end_ = nullptr;
};

/// Handle of a series during the replay of order K (K = -1: the order is tape->order). Coefficients 0 to K of
/// a handle are valid. A handle without coefficients is a constant, which no operation stores; sums with 0
/// and products with 0 or 1 cost nothing, so derivatives that vanish identically are never computed.
template <class T, int R, int K>
class Jet {
 public:
  using Tape = JetTape<T, R>;  ///< Where its coefficients live.

  Jet() = default;
  /// A constant.
  Jet(double value) : constant(value) {}  // NOLINT: implicit, so that formulas read as written
  /// The series of these coefficients, which stay where they are; results go to the tape.
  Jet(const T* series, Tape* where) : coefficients(series), tape(where) {}

  const T* coefficients = nullptr;  ///< 0 to K, or none for a constant.
  Tape* tape = nullptr;             ///< For results.
  double constant = 0.0;            ///< The value of a constant.

  [[nodiscard]] bool is_constant() const { return coefficients == nullptr; }  ///< The same at all times.
  [[nodiscard]] bool is(double c) const { return is_constant() && constant == c; }  ///< The constant c.
  /// The order of this replay.
  [[nodiscard]] int order() const {
    if constexpr (K >= 0)
      return K;
    else
      return tape->order;
  }
  /// Coefficient k.
  [[nodiscard]] T operator[](int k) const {
    if (is_constant()) return T(k == 0 ? constant : 0.0);
    return coefficients[k];
  }
  /// Value at time zero, without derivatives: what comparisons look at.
  [[nodiscard]] double value() const { return is_constant() ? constant : value_of(coefficients[0]); }

  ///@{

  /// Coefficient k of the result, by Cauchy's product where there is one.
  friend Jet operator-(const Jet& a) { return -1.0 * a; }
  friend Jet operator+(const Jet& a, const Jet& b) {
    if (a.is_constant() && b.is_constant()) return Jet(a.constant + b.constant);
    if (a.is(0.0)) return b;
    if (b.is(0.0)) return a;
    const Jet& s = a.is_constant() ? b : a;
    const int k = s.order();
    T* c = s.slot();
    if (a.is_constant() || b.is_constant()) {
      const double shift = a.is_constant() ? a.constant : b.constant;
      c[k] = k == 0 ? s.coefficients[0] + shift : s.coefficients[k];
    } else {
      c[k] = a.coefficients[k] + b.coefficients[k];
    }
    return Jet(c, s.tape);
  }
  friend Jet operator-(const Jet& a, const Jet& b) {
    if (a.is_constant() || b.is_constant()) return a + (-b);
    const int k = a.order();
    T* c = a.slot();
    c[k] = a.coefficients[k] - b.coefficients[k];
    return Jet(c, a.tape);
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    if (a.is_constant() && b.is_constant()) return Jet(a.constant * b.constant);
    if (a.is_constant()) return b.scaled(a.constant);
    if (b.is_constant()) return a.scaled(b.constant);
    const int k = a.order();
    T* c = a.slot();
    if (a.coefficients == b.coefficients)
      c[k] = Convolution::square(a.coefficients, k);
    else
      c[k] = Convolution::sum(a.coefficients, b.coefficients, k, 0, k);
    return Jet(c, a.tape);
  }
  /// b c = a, solved for c_k.
  friend Jet operator/(const Jet& a, const Jet& b) {
    if (b.is_constant()) return a * Jet(1.0 / b.constant);
    if (a.is(0.0)) return a;
    const int k = b.order();
    T* c = b.slot();
    if (k == 0) c[R + 1] = 1.0 / b.coefficients[0];
    c[k] = (a[k] - Convolution::sum(b.coefficients, c, k, 1, k)) * c[R + 1];
    return Jet(c, b.tape);
  }
  Jet& operator+=(const Jet& b) { return *this = *this + b; }
  Jet& operator-=(const Jet& b) { return *this = *this - b; }
  Jet& operator*=(const Jet& b) { return *this = *this * b; }
  Jet& operator/=(const Jet& b) { return *this = *this / b; }
  ///@}

  ///@{

  /// Of the values at time zero.
  friend bool operator<(const Jet& a, const Jet& b) { return a.value() < b.value(); }
  friend bool operator>(const Jet& a, const Jet& b) { return a.value() > b.value(); }
  friend bool operator<=(const Jet& a, const Jet& b) { return a.value() <= b.value(); }
  friend bool operator>=(const Jet& a, const Jet& b) { return a.value() >= b.value(); }
  ///@}

  [[nodiscard]] T* slot() const { return tape->template next<K>(); }  ///< The tape's next slot.

 private:
  using Convolution = detail::Convolution<T, K>;

  [[nodiscard]] Jet scaled(double factor) const {
    if (factor == 0.0) return Jet(0.0);
    if (factor == 1.0) return *this;
    const int k = order();
    T* c = slot();
    c[k] = factor * coefficients[k];
    return Jet(c, tape);
  }
};

}  // namespace avi
