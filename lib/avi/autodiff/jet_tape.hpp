#pragma once
#include "avi/autodiff/lanes.hpp"
#include "avi/autodiff/operation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

/// @file
/// The operations of a formula on truncated Taylor series, one coefficient at a time.

namespace avi {

/// What a slot of a JetTape holds, as a series c of its operands a and b.
enum class SeriesOperation {
  add,       ///< a + b
  subtract,  ///< a - b
  shift,     ///< a + number
  scale,     ///< number a
  multiply,  ///< a b
  square,    ///< a^2
  divide,    ///< a / b, or number / b
  sqrt,      ///< c^2 = a
  power,     ///< a^number: a c' = number c a'
  exp,       ///< c' = c a'
  sin,       ///< c' = b a', with b = cos a
  cos,       ///< c' = -b a', with b = sin a
  sinh,      ///< c' = b a', with b = cosh a
  cosh,      ///< c' = b a', with b = sinh a
  log,       ///< b c' = a', with b = a
  atan,      ///< b c' = a', with b = 1 + a^2
  absolute,  ///< a or -a, by the sign of its value
  sign,      ///< 1 or -1, the sign of a's value
  constant,  ///< number
  value,     ///< Operation `number` at the values of a and b, the same at all times
  integral   ///< c' = b a', 0 at time zero
};

/// A formula on truncated Taylor series, written down as it is first evaluated.
///
/// The Taylor coefficients of a solution of \f$z' = f(z)\f$ follow from \f$z_{k+1} = f_k/(k + 1)\f$, where
/// \f$f_k\f$ needs \f$z_0\f$ to \f$z_k\f$ only. A formula called with Jet computes the coefficients 0 of its
/// intermediate results, each in a slot of the tape, together with the operation that it came from; run()
/// then adds coefficient k to every slot, for k = 1, 2, ... in turn, without calling the formula again. A
/// product costs k + 1 multiplications at order k, hence O(r^2) in all (recurrences: Jorba and Zou 2005,
/// Proposition 1; Neidinger 2013). T is Lanes<N>.
template <class T, int R>
class JetTape {
 public:
  JetTape() { extend(); }
  /// A copy has room of its own; what is written on the tape stays behind, since it refers to other memory.
  JetTape(const JetTape&) : JetTape() {}
  JetTape& operator=(const JetTape&) = delete;

  /// Forgets the formula: the next one is written from the first slot on.
  void clear() { size_ = 0, branched = false; }
  [[nodiscard]] int size() const { return size_; }  ///< Slots written.

  /// Writes an operation, unless it is on the tape, and computes its coefficient 0. Series must stay where
  /// they are. @param a first operand, null for the constant `number` of a quotient
  const T* write(SeriesOperation operation, const T* a, const T* b, double number) {
    for (int i = 0; i < size_; ++i)
      if (const Slot& known = at(i);
          known.operation == operation && known.a == a && (known.b == b || !b) && known.number == number)
        return known.c;
    if (size_ == static_cast<int>(blocks_.size()) * block) extend();
    Slot& slot = at(size_++);
    slot.a = a;
    slot.b = b;
    slot.number = number;
    slot.operation = operation;
    compute<0>(slot, 0);
    if (partner(operation) != operation) slot.b = write(partner(operation), a, nullptr, number);
    return slot.c;
  }

  /// The integral of b a', for a series b that integrand() names later: it may depend on this one.
  const T* integral(const T* a) {
    if (size_ == static_cast<int>(blocks_.size()) * block) extend();
    Slot& slot = at(size_++);
    slot.a = a;
    slot.b = nullptr;
    slot.operation = SeriesOperation::integral;
    slot.number = 0.0;
    compute<0>(slot, 0);
    return slot.c;
  }
  /// Names b of an integral, among the slots from number `first` on.
  void integrand(const T* integral, const T* b, int first) {
    for (int i = first; i < size_; ++i)
      if (at(i).c == integral) at(i).b = b;
  }

  /// Coefficient k of the first `count` slots, whose coefficients 0 to k - 1 are known, as are those up to k
  /// of the series that the formula was called with.
  void run(int k, int count) {
    const bool done = [&]<int... known>(std::integer_sequence<int, known...>) {
      return ((k == known && (run_order<known>(k, count), true)) || ...);
    }
    (std::make_integer_sequence<int, std::min(R, 7) + 1>{});
    if constexpr (R > 7)
      if (!done) run_order<-1>(k, count);
  }

  bool branched = false;  ///< The formula looked at a value: at other points it may be another one.

 private:
  static constexpr int block = 64;
  /// @cond
  struct alignas(sizeof(T) < 64 || alignof(T) > 64 ? alignof(T) : 64) Slot {
    T c[R + 1];
    T auxiliary;  // what every coefficient is multiplied with
    const T *a, *b;
    double number;
    SeriesOperation operation;
  };
  /// @endcond
  [[gnu::noinline, gnu::cold]] void extend() {
    blocks_.push_back(std::make_unique_for_overwrite<Slot[]>(block));
  }

  Slot& at(int i) { return blocks_[i / block][i % block]; }
  /// The function that is, up to its sign, the derivative of this one, as this one is its.
  static SeriesOperation partner(SeriesOperation operation) {
    using enum SeriesOperation;
    if (operation == sin || operation == cos) return operation == sin ? cos : sin;
    if (operation == sinh || operation == cosh) return operation == sinh ? cosh : sinh;
    return operation;  // none
  }
  /// Compiled once for each low order: its sums are straight lines. @tparam known the order, or -1
  template <int known>
  [[gnu::noinline]] void run_order(int k, int count) {
    for (auto it = blocks_.begin(); count > 0; ++it, count -= block)
      for (Slot *slot = it->get(), *end = slot + std::min(count, block); slot != end; ++slot)
        compute<known>(*slot, k);
  }
  template <int known>
  [[gnu::always_inline]] static void compute(Slot& slot, int order) {
    const int k = known >= 0 ? known : order;
    using std::atan, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh, std::sqrt;
    using Op = SeriesOperation;
    T* const c = slot.c;
    const T *const a = slot.a, *const b = slot.b;
    switch (slot.operation) {
    case Op::add:
      c[k] = a[k] + b[k];
      break;
    case Op::subtract:
      c[k] = a[k] - b[k];
      break;
    case Op::shift:
      c[k] = k == 0 ? a[0] + slot.number : a[k];
      break;
    case Op::scale:
      c[k] = slot.number * a[k];
      break;
    case Op::multiply:
      c[k] = convolution(a, b, k, 0, k);
      break;
    case Op::square:
      c[k] = convolution_square(a, k);
      break;
    case Op::divide:
      if (k == 0) slot.auxiliary = 1.0 / b[0];
      c[k] = ((a ? a[k] : T(k == 0 ? slot.number : 0.0)) - convolution(b, c, k, 1, k)) * slot.auxiliary;
      break;
    case Op::sqrt:
      if (k == 0) {
        c[0] = sqrt(a[0]);
        slot.auxiliary = 0.5 / c[0];
      } else {
        c[k] = (a[k] - convolution(c, c, k, 1, k - 1)) * slot.auxiliary;
      }
      break;
    case Op::power:
      if (k == 0) {
        c[0] = avi::power(a[0], slot.number);
        slot.auxiliary = 1.0 / a[0];
      } else {
        c[k] = convolution_weighted(a, c, k, slot.number + 1.0, -k) * slot.auxiliary;
      }
      break;
    case Op::exp:
    case Op::sin:
    case Op::cos:
    case Op::sinh:
    case Op::cosh:
      if (k == 0)
        c[0] = slot.operation == Op::exp    ? exp(a[0])
               : slot.operation == Op::sin  ? sin(a[0])
               : slot.operation == Op::cos  ? cos(a[0])
               : slot.operation == Op::sinh ? sinh(a[0])
                                            : cosh(a[0]);
      else
        c[k] = convolution_weighted(a, slot.operation == Op::exp ? c : b, k,
                                    slot.operation == Op::cos ? -1.0 : 1.0, 0.0);
      break;
    case Op::log:
    case Op::atan:
      if (k == 0) {
        c[0] = slot.operation == Op::log ? log(a[0]) : atan(a[0]);
        slot.auxiliary = 1.0 / b[0];
      } else {
        c[k] = T(0.0);  // so that the sum ends at j = k - 1
        c[k] = (a[k] - convolution_weighted(c, b, k, 1.0, 0.0)) * slot.auxiliary;
      }
      break;
    case Op::absolute:
      if (k == 0) slot.number = value_of(a[0]) < 0.0 ? -1.0 : 1.0;
      c[k] = slot.number < 0.0 ? -1.0 * a[k] : a[k];
      break;
    case Op::constant:
      c[k] = T(k == 0 ? slot.number : 0.0);
      break;
    case Op::value:
      c[k] = k == 0 ? function(static_cast<Operation>(slot.number), a[0], b ? b[0] : a[0]) : T(0.0);
      break;
    case Op::integral:
      c[k] = k == 0 ? T(0.0) : convolution_weighted(a, b, k, 1.0, 0.0);
      break;
    case Op::sign:
      c[k] = T(k > 0 ? 0.0 : value_of(a[0]) < 0.0 ? -1.0 : 1.0);
      break;
    }
  }

  [[gnu::noinline]] static T function(Operation operation, const T& a, const T& b) {
    T result(0.0);
    detail::with_operation(operation, [&]<Operation known>() { result = detail::apply<known>(a, b); });
    return result;
  }

  // Inlined where k is known, which -O2 alone would not do: the sums become straight lines, twice as fast.

  /// Sum over j = from..to of a_j b_(k-j).
  [[gnu::always_inline]] static T convolution(const T* a, const T* b, int k, int from, int to) {
    ProductSum<T> s;
    for (int j = from; j <= to; ++j)
      s.add(a[j], b[k - j]);
    return s.result();
  }
  /// Coefficient k of a^2: each pair once, doubled.
  [[gnu::always_inline]] static T convolution_square(const T* a, int k) {
    ProductSum<T> s;
    for (int j = 0; 2 * j < k; ++j)
      s.add(a[j], a[k - j], 2.0);
    if (k % 2 == 0) s.add(a[k / 2], a[k / 2]);
    return s.result();
  }
  /// Sum over j = 1..k of (slope j + shift) a_j b_(k-j) / k.
  [[gnu::always_inline]] static T convolution_weighted(const T* a, const T* b, int k, double slope,
                                                       double shift) {
    ProductSum<T> s;
    for (int j = 1; j <= k; ++j)
      s.add(a[j], b[k - j], slope * j + shift);
    return (1.0 / k) * s.result();
  }

  std::vector<std::unique_ptr<Slot[]>> blocks_;
  int size_ = 0;
};

}  // namespace avi
