#pragma once
#include "avi/autodiff/jet_tape.hpp"

/// @file
/// The scalar that writes a formula on a JetTape.

namespace avi {

/// Handle of a truncated Taylor series in time: what a formula is called with so that a JetTape knows it. A
/// handle without coefficients is a constant, which no operation stores; sums with 0 and products with 0 or 1
/// cost nothing, so derivatives that vanish identically are never computed.
template <class T, int R>
class Jet {
  using Op = SeriesOperation;

 public:
  using Tape = JetTape<T, R>;  ///< Where its coefficients live.

  Jet() = default;
  /// A constant.
  Jet(double value) : constant(value) {}  // NOLINT: implicit, so that formulas read as written
  /// The series of these coefficients, which stay where they are; results go to the tape.
  Jet(const T* series, Tape* where) : coefficients(series), tape(where) {}

  const T* coefficients = nullptr;  ///< From 0 on, or none for a constant.
  Tape* tape = nullptr;             ///< For results.
  double constant = 0.0;            ///< The value of a constant.

  [[nodiscard]] bool is_constant() const { return coefficients == nullptr; }  ///< The same at all times.
  [[nodiscard]] bool is(double c) const { return is_constant() && constant == c; }  ///< The constant c.
  /// Coefficient k.
  [[nodiscard]] T operator[](int k) const {
    if (is_constant()) return T(k == 0 ? constant : 0.0);
    return coefficients[k];
  }
  /// Value at time zero, without derivatives. A formula that asks for it is called anew at every point.
  [[nodiscard]] double value() const {
    if (is_constant()) return constant;
    tape->branched = true;
    return value_of(coefficients[0]);
  }
  /// The series of an operation on this one.
  [[nodiscard]] Jet through(Op operation, double number = 0.0) const {
    return {tape->write(operation, coefficients, nullptr, number), tape};
  }
  /// The series of an operation on this one and another.
  [[nodiscard]] Jet with(Op operation, const Jet& b) const {
    return {tape->write(operation, coefficients, b.coefficients, 0.0), tape};
  }

  ///@{

  /// By the rules for series, Cauchy's product where there is one.
  friend Jet operator-(const Jet& a) { return -1.0 * a; }
  friend Jet operator+(const Jet& a, const Jet& b) {
    if (a.is_constant() && b.is_constant()) return Jet(a.constant + b.constant);
    if (a.is(0.0)) return b;
    if (b.is(0.0)) return a;
    if (a.is_constant()) return b.through(Op::shift, a.constant);
    if (b.is_constant()) return a.through(Op::shift, b.constant);
    return a.with(Op::add, b);
  }
  friend Jet operator-(const Jet& a, const Jet& b) {
    if (a.is_constant() || b.is_constant()) return a + (-b);
    return a.with(Op::subtract, b);
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    if (a.is_constant() && b.is_constant()) return Jet(a.constant * b.constant);
    if (a.is_constant()) return b.scaled(a.constant);
    if (b.is_constant()) return a.scaled(b.constant);
    return a.coefficients == b.coefficients ? a.through(Op::square) : a.with(Op::multiply, b);
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    if (b.is_constant()) return a * Jet(1.0 / b.constant);
    if (a.is(0.0)) return a;
    return {b.tape->write(Op::divide, a.coefficients, b.coefficients, a.constant), b.tape};
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

 private:
  [[nodiscard]] Jet scaled(double factor) const {
    if (factor == 0.0) return Jet(0.0);
    if (factor == 1.0) return *this;
    return through(Op::scale, factor);
  }
};

}  // namespace avi
