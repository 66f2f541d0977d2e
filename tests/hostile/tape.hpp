#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

/// @file
/// Gradients for the reference: a tape of its own, so that nothing of the library's differentiation is
/// shared.

namespace hostile {

// clang-format off
/// each(name, y, what the slope s by y adds to those by a and b): y of entries a, b and the number c.
#define HOSTILE_OPERATIONS(each)                          \
  each(add, a + b, (to_a += s, to_b += s))                \
  each(subtract, a - b, (to_a += s, to_b -= s))           \
  each(multiply, a * b, (to_a += s * b, to_b += s * a))   \
  each(divide, a / b, (to_a += s / b, to_b -= s * y / b)) \
  each(shift, a + c, to_a += s)                           \
  each(scale, c * a, to_a += s * c)                       \
  each(reciprocal, c / a, to_a -= s * y / a)              \
  each(power, pow(a, c), to_a += s * c * pow(a, c - X(1)))
/// Those that have the name of a function of a alone.
#define HOSTILE_FUNCTIONS(each)               \
  each(sqrt, sqrt(a), to_a += s / (X(2) * y)) \
  each(exp, exp(a), to_a += s * y)            \
  each(log, log(a), to_a += s / a)            \
  each(sin, sin(a), to_a += s * cos(a))       \
  each(cos, cos(a), to_a -= s * sin(a))       \
  each(sinh, sinh(a), to_a += s * cosh(a))    \
  each(cosh, cosh(a), to_a += s * sinh(a))    \
  each(tanh, tanh(a), to_a += s * (X(1) - y * y))
// clang-format on

/// A formula of some inputs as a list of operations, with its gradient by the reverse sweep.
class Tape {
 public:
#define NAME(name, value, back) name,
  /// What an entry does.
  enum class Kind : std::uint8_t { input, HOSTILE_OPERATIONS(NAME) HOSTILE_FUNCTIONS(NAME) };
#undef NAME

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
  void forward(std::vector<X>& values) const {
    using std::cos, std::cosh, std::exp, std::log, std::pow, std::sin, std::sinh, std::sqrt, std::tanh;
    X* v = values.data();
    const int size = this->size();
    for (int i = inputs_; i < size; ++i) {
      const Entry& e = entries_[i];
      const X a = v[e.a], b = v[e.b], c = e.c;
#define FORWARD(name, value, back)                                                                           \
  case Kind::name:                                                                                           \
    v[i] = value;                                                                                            \
    break;
      switch (e.kind) {
      case Kind::input:
        break;
        HOSTILE_OPERATIONS(FORWARD)
        HOSTILE_FUNCTIONS(FORWARD)
      }
#undef FORWARD
    }
  }

  template <class X>
  void backward(const std::vector<X>& values, std::vector<X>& adjoint) const {
    using std::cos, std::cosh, std::pow, std::sin, std::sinh;
    const X* v = values.data();
    X* d = adjoint.data();
    for (int i = size() - 1; i >= inputs_; --i) {
      const Entry& e = entries_[i];
      const X s = d[i], y = v[i], a = v[e.a], b = v[e.b], c = e.c;
      X &to_a = d[e.a], &to_b = d[e.b];
#define BACKWARD(name, value, back)                                                                          \
  case Kind::name:                                                                                           \
    back;                                                                                                    \
    break;
      switch (e.kind) {
      case Kind::input:
        break;
        HOSTILE_OPERATIONS(BACKWARD)
        HOSTILE_FUNCTIONS(BACKWARD)
      }
#undef BACKWARD
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
#define FUNCTION(name, value, back)                                                                          \
  friend Number name(const Number& a) { return a.with(Tape::Kind::name, 0.0); }
  HOSTILE_FUNCTIONS(FUNCTION)
#undef FUNCTION

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
