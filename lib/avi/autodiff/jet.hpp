#pragma once
#include "avi/autodiff/jet_tape.hpp"

#include <cmath>
#include <compare>
#include <utility>

/// @file
/// The scalar that writes a formula on a JetTape.

namespace avi {

/// Handle of a truncated Taylor series in time: what a formula is called with so that a JetTape knows it. A
/// handle without coefficients is a constant, which no operation stores; sums with 0 and products with 0 or 1
/// cost nothing, so derivatives that vanish identically are never computed.
template <class T, int R>
class Jet : Scalar<Jet<T, R>> {
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
  ///@}

  ///@{

  /// Of the values at time zero.
  friend bool operator<(const Jet& a, const Jet& b) { return a.value() < b.value(); }
  friend bool operator>(const Jet& a, const Jet& b) { return a.value() > b.value(); }
  friend bool operator<=(const Jet& a, const Jet& b) { return a.value() <= b.value(); }
  friend bool operator>=(const Jet& a, const Jet& b) { return a.value() >= b.value(); }
  ///@}

  ///@{

  /// Of the series; of a constant, the constant.
  friend Jet sqrt(const Jet& a) { return a.function(Op::sqrt, std::sqrt); }
  friend Jet pow(const Jet& a, double alpha) {
    if (alpha == 0.0) return Jet(1.0);
    if (alpha == 1.0) return a;
    if (alpha == 2.0) return a * a;
    return a.is_constant() ? Jet(power(a.constant, alpha)) : a.through(Op::power, alpha);
  }
  friend Jet exp(const Jet& a) { return a.function(Op::exp, std::exp); }
  friend Jet log(const Jet& a) { return a.is_constant() ? Jet(std::log(a.constant)) : a.with(Op::log, a); }
  friend Jet sin(const Jet& a) { return a.function(Op::sin, std::sin); }
  friend Jet cos(const Jet& a) { return a.function(Op::cos, std::cos); }
  friend Jet tan(const Jet& a) { return sin(a) / cos(a); }
  friend Jet sinh(const Jet& a) { return a.function(Op::sinh, std::sinh); }
  friend Jet cosh(const Jet& a) { return a.function(Op::cosh, std::cosh); }
  friend Jet tanh(const Jet& a) {
    if (a.is_constant()) return Jet(std::tanh(a.constant));
    // The quotient that does not overflow: (1 - u) / (1 + u), u = exp(-2 |a|), up to the sign of a.
    const double sign = a.value() < 0.0 ? -1.0 : 1.0;
    const Jet u = exp((-2.0 * sign) * a);
    return sign * ((1.0 - u) / (1.0 + u));
  }
  friend Jet atan(const Jet& a) {
    return a.is_constant() ? Jet(std::atan(a.constant)) : a.with(Op::atan, a * a + 1.0);
  }
  friend Jet abs(const Jet& a) { return a.function(Op::absolute, std::abs); }
  /// @cond
#define AVI_own(name)
#define AVI_by_slope(name)                                                                                   \
  friend Jet name(const Jet& a) {                                                                            \
    if (a.is_constant()) return Jet(std::name(a.constant));                                                  \
    return by_slopes<1>(Operation::name, a, a, [](int, const Jet& x, const Jet&, const Jet& f) {             \
      return detail::slopes::slope_of_##name(x, f);                                                          \
    });                                                                                                      \
  }
#define AVI_ONE(name, pack, series, ...) AVI_##series(name)
#define AVI_TWO(name, ...)                                                                                   \
  friend Jet name(const Jet& a, const Jet& b) {                                                              \
    if (a.is_constant() && b.is_constant()) return Jet(std::name(a.constant, b.constant));                   \
    return by_slopes<2>(Operation::name, a, b, [](int k, const Jet& x, const Jet& y, const Jet& f) {         \
      return k == 0 ? detail::slopes::slopes_of_##name<0>(x, y, f)                                           \
                    : detail::slopes::slopes_of_##name<1>(x, y, f);                                          \
    });                                                                                                      \
  }
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
#undef AVI_own
#undef AVI_by_slope
  /// @endcond
  /// Written down: a look at the value would have the formula called anew for every expansion.
  friend Jet sign_of(const Jet& a) { return a.function(Op::sign, avi::sign_of); }
  ///@}

 private:
  /// A function f of a, or of a and b, by \f$f' = f_a a' + f_b b'\f$. @param slope called as
  /// slope(0 or 1, a, b, f)
  template <int operands, class Slope>
  static Jet by_slopes(Operation operation, const Jet& a, const Jet& b, Slope slope) {
    Tape& tape = a.is_constant() ? *b.tape : *a.tape;
    const T *const x = a.series(tape), *const y = b.series(tape);
    const int first = tape.size();
    const auto integral = [&](const Jet& z) {
      return z.is_constant() ? Jet(0.0) : Jet(tape.integral(z.coefficients), &tape);
    };
    const Jet along[] = {integral(a), operands == 2 ? integral(b) : Jet(0.0)};
    const Jet f =
        Jet(tape.write(Op::value, x, y, static_cast<double>(operation)), &tape) + (along[0] + along[1]);
    for (const int k : {0, 1})
      if (!along[k].is_constant())
        tape.integrand(along[k].coefficients, slope(k, a, b, f).series(tape), first);
    return f;
  }
  /// Coefficients, which a constant gets here.
  [[nodiscard]] const T* series(Tape& where) const {
    return is_constant() ? where.write(Op::constant, nullptr, nullptr, constant) : coefficients;
  }
  [[nodiscard]] Jet scaled(double factor) const {
    if (factor == 0.0) return Jet(0.0);
    if (factor == 1.0) return *this;
    return through(Op::scale, factor);
  }
  /// A function of this series, or of a constant.
  [[nodiscard]] Jet function(Op operation, double (*f)(double)) const {
    return is_constant() ? Jet(f(constant)) : through(operation);
  }
};

}  // namespace avi
