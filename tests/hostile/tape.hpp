#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

/// @file
/// Gradients for the reference: a tape of its own, so that nothing of the library's differentiation is
/// shared.

namespace hostile {

/// A formula of some inputs as a list of operations, with its gradient by the reverse sweep.
class Tape {
 public:
  /// What an entry does with entries a, b and the number c.
  enum class Kind : std::uint8_t {
    input,
    add,         ///< a + b
    subtract,    ///< a - b
    multiply,    ///< a b
    divide,      ///< a / b
    shift,       ///< a + c
    scale,       ///< c a
    reciprocal,  ///< c / a
    power,       ///< a^c
    sqrt,        ///< Those below are functions of a.
    exp,
    log,
    sin,
    cos,
    sinh,
    cosh,
    tanh
  };

  /// A tape of so many inputs.
  explicit Tape(int inputs) : inputs_(inputs) {
    for (int i = 0; i < inputs; ++i)
      write(Kind::input, i, i);
  }

  /// Adds an entry and tells its index.
  int write(Kind kind, int a, int b, double c = 0.0) {
    entries_.push_back({kind, a, b, c});
    return static_cast<int>(entries_.size()) - 1;
  }
  /// Says which entry is the result.
  void finish(int result) { result_ = result; }
  [[nodiscard]] int size() const { return static_cast<int>(entries_.size()); }  ///< Number of entries.

  /// The gradient at z, both of as many numbers as there are inputs; the work is done in numbers X.
  template <class X>
  void gradient(const X* z, X* slope, std::vector<X>& value, std::vector<X>& adjoint) const {
    value.resize(entries_.size());
    adjoint.assign(entries_.size(), X(0));
    for (int i = 0; i < inputs_; ++i)
      value[i] = z[i];
    forward(value);
    adjoint[result_] = X(1);
    backward(value, adjoint);
    for (int i = 0; i < inputs_; ++i)
      slope[i] = adjoint[i];
  }

 private:
  struct Entry {
    Kind kind;
    int a, b;
    double c;
  };

  template <class X>
  void forward(std::vector<X>& value) const {
    using std::cos, std::cosh, std::exp, std::log, std::pow, std::sin, std::sinh, std::sqrt, std::tanh;
    X* v = value.data();
    const int size = this->size();
    for (int i = inputs_; i < size; ++i) {
      const Entry& e = entries_[i];
      const X a = v[e.a], c = e.c;
      switch (e.kind) {
      case Kind::input:
        break;
      case Kind::add:
        v[i] = a + v[e.b];
        break;
      case Kind::subtract:
        v[i] = a - v[e.b];
        break;
      case Kind::multiply:
        v[i] = a * v[e.b];
        break;
      case Kind::divide:
        v[i] = a / v[e.b];
        break;
      case Kind::shift:
        v[i] = a + c;
        break;
      case Kind::scale:
        v[i] = c * a;
        break;
      case Kind::reciprocal:
        v[i] = c / a;
        break;
      case Kind::power:
        v[i] = pow(a, c);
        break;
      case Kind::sqrt:
        v[i] = sqrt(a);
        break;
      case Kind::exp:
        v[i] = exp(a);
        break;
      case Kind::log:
        v[i] = log(a);
        break;
      case Kind::sin:
        v[i] = sin(a);
        break;
      case Kind::cos:
        v[i] = cos(a);
        break;
      case Kind::sinh:
        v[i] = sinh(a);
        break;
      case Kind::cosh:
        v[i] = cosh(a);
        break;
      case Kind::tanh:
        v[i] = tanh(a);
        break;
      }
    }
  }

  template <class X>
  void backward(const std::vector<X>& value, std::vector<X>& adjoint) const {
    using std::cos, std::cosh, std::pow, std::sin, std::sinh;
    const X* v = value.data();
    X* d = adjoint.data();
    for (int i = size() - 1; i >= inputs_; --i) {
      const Entry& e = entries_[i];
      const X s = d[i], a = v[e.a], c = e.c;
      switch (e.kind) {
      case Kind::input:
        break;
      case Kind::add:
        d[e.a] += s, d[e.b] += s;
        break;
      case Kind::subtract:
        d[e.a] += s, d[e.b] -= s;
        break;
      case Kind::multiply: {
        const X b = v[e.b];  // read first: a and b may be the same entry
        d[e.a] += s * b, d[e.b] += s * a;
        break;
      }
      case Kind::divide:
        d[e.a] += s / v[e.b], d[e.b] -= s * v[i] / v[e.b];
        break;
      case Kind::shift:
        d[e.a] += s;
        break;
      case Kind::scale:
        d[e.a] += s * c;
        break;
      case Kind::reciprocal:
        d[e.a] -= s * v[i] / a;
        break;
      case Kind::power:
        d[e.a] += s * c * pow(a, c - X(1));
        break;
      case Kind::sqrt:
        d[e.a] += s / (X(2) * v[i]);
        break;
      case Kind::exp:
        d[e.a] += s * v[i];
        break;
      case Kind::log:
        d[e.a] += s / a;
        break;
      case Kind::sin:
        d[e.a] += s * cos(a);
        break;
      case Kind::cos:
        d[e.a] -= s * sin(a);
        break;
      case Kind::sinh:
        d[e.a] += s * cosh(a);
        break;
      case Kind::cosh:
        d[e.a] += s * sinh(a);
        break;
      case Kind::tanh:
        d[e.a] += s * (X(1) - v[i] * v[i]);
        break;
      }
    }
  }

  int inputs_, result_ = 0;
  std::vector<Entry> entries_;
};

/// A number, or an entry of a tape: the scalar with which a formula is called to be written down.
class Number {
 public:
  Number() = default;
  Number(double constant) : constant_(constant) {}                // NOLINT: formulas read as written
  Number(Tape& tape, int entry) : tape_(&tape), entry_(entry) {}  ///< What an entry holds.
  [[nodiscard]] int entry() const { return entry_; }              ///< Its index.

  friend Number operator+(const Number& a, const Number& b) {
    if (!a.tape_ && !b.tape_) return a.constant_ + b.constant_;
    if (!a.tape_) return b.with(Tape::Kind::shift, a.constant_);
    if (!b.tape_) return a.with(Tape::Kind::shift, b.constant_);
    return a.with(Tape::Kind::add, b);
  }
  friend Number operator-(const Number& a, const Number& b) {
    if (!a.tape_ && !b.tape_) return a.constant_ - b.constant_;
    if (!a.tape_) return b.with(Tape::Kind::scale, -1.0).with(Tape::Kind::shift, a.constant_);
    if (!b.tape_) return a.with(Tape::Kind::shift, -b.constant_);
    return a.with(Tape::Kind::subtract, b);
  }
  friend Number operator*(const Number& a, const Number& b) {
    if (!a.tape_ && !b.tape_) return a.constant_ * b.constant_;
    if (!a.tape_) return b.with(Tape::Kind::scale, a.constant_);
    if (!b.tape_) return a.with(Tape::Kind::scale, b.constant_);
    return a.with(Tape::Kind::multiply, b);
  }
  friend Number operator/(const Number& a, const Number& b) {
    if (!a.tape_ && !b.tape_) return a.constant_ / b.constant_;
    if (!a.tape_) return b.with(Tape::Kind::reciprocal, a.constant_);
    if (!b.tape_) return a.with(Tape::Kind::scale, 1.0 / b.constant_);
    return a.with(Tape::Kind::divide, b);
  }
  friend Number operator-(const Number& a) { return -1.0 * a; }
  friend Number pow(const Number& a, double exponent) { return a.with(Tape::Kind::power, exponent); }
  friend Number sqrt(const Number& a) { return a.with(Tape::Kind::sqrt, 0.0); }
  friend Number exp(const Number& a) { return a.with(Tape::Kind::exp, 0.0); }
  friend Number log(const Number& a) { return a.with(Tape::Kind::log, 0.0); }
  friend Number sin(const Number& a) { return a.with(Tape::Kind::sin, 0.0); }
  friend Number cos(const Number& a) { return a.with(Tape::Kind::cos, 0.0); }
  friend Number sinh(const Number& a) { return a.with(Tape::Kind::sinh, 0.0); }
  friend Number cosh(const Number& a) { return a.with(Tape::Kind::cosh, 0.0); }
  friend Number tanh(const Number& a) { return a.with(Tape::Kind::tanh, 0.0); }

 private:
  [[nodiscard]] Number with(Tape::Kind kind, double c) const {
    return {*tape_, tape_->write(kind, entry_, entry_, c)};
  }
  [[nodiscard]] Number with(Tape::Kind kind, const Number& b) const {
    return {*tape_, tape_->write(kind, entry_, b.entry_)};
  }

  Tape* tape_ = nullptr;  // none for a constant
  int entry_ = -1;
  double constant_ = 0.0;
};

}  // namespace hostile
