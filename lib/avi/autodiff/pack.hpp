#pragma once
#include "avi/autodiff/partials.hpp"
#include "avi/autodiff/vector_functions.hpp"
#include "avi/core/instructions.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <type_traits>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// @file
/// Pack: several numbers that go through one formula side by side.

namespace avi {

namespace detail {
/// @cond
inline namespace AVI_INSTRUCTIONS {
/// @endcond
/// Absolute values of the numbers in a register, as integers: the order of these is the order of the absolute
/// values.
template <class R>
[[gnu::always_inline]] inline auto magnitude(R x) {
  return (decltype(x < x))x & 0x7fffffffffffffff;
}
/// @cond
}  // namespace AVI_INSTRUCTIONS
/// @endcond
}  // namespace detail

/// @cond
inline namespace AVI_INSTRUCTIONS {
/// @endcond

/// w doubles, w = 2, 4, 8 or 16, as one scalar. Every operation applies to each of them: with vector
/// instructions where the machine has them, otherwise with the same bits. A formula that is generic in its
/// scalar is thus evaluated at w points for little more than the cost of one. It cannot branch on a value,
/// because the w values may need different branches; the result of a comparison can only be used in select().
/// A Partials<Pack<w>, n> holds w values with their gradients.
template <int w>
class Pack : Scalar<Pack<w>> {
 public:
  static constexpr int width = w;                                   ///< Numbers in the pack.
  static constexpr int lanes = std::min(w, detail::machine_lanes);  ///< Numbers in a register.
  /// A register of the machine. Its weak alignment allows it to lie anywhere, also in Eigen vectors, and
  /// costs nothing where memory is better aligned.
  using Register = typename detail::Simd<lanes, 16>::type;
  static constexpr int parts = w / lanes;  ///< Registers in the pack.
  /// A register's worth of numbers in an array of doubles, of any alignment.
  using InMemory [[gnu::vector_size(8 * lanes), gnu::aligned(8), gnu::may_alias]] = double;

  Register part[parts];  ///< The numbers.

  /// The result of comparing two packs: a mask for each number.
  struct Condition {
    /// All bits set where the comparison holds, none where not.
    using Mask = decltype(Register{} < Register{});
    Mask part[parts];  ///< Masks, register by register.

    /// The condition whose register k is f(k).
    template <class F>
    [[nodiscard]] static Condition by_part(F f) {
      Condition c;
      for (int k = 0; k < parts; ++k)
        c.part[k] = f(k);
      return c;
    }
    /// A condition has no single truth value, so packs cannot branch: this conversion stops the compiler.
    template <std::same_as<bool> B>
    operator B() const {  // NOLINT: implicit, so that this sentence is what the compiler says
      static_assert(!std::is_same_v<B, B>,
                    "A formula that is evaluated at several points at once cannot branch: instead of `if` or "
                    "`?:` write select(a < b, x, y), min(x, y), max(x, y) or abs(x), without std::.");
      return {};
    }
    ///@{

    /// Number by number.
    friend Condition operator&&(const Condition& a, const Condition& b) {
      return by_part([&](int k) { return a.part[k] & b.part[k]; });
    }
    friend Condition operator||(const Condition& a, const Condition& b) {
      return by_part([&](int k) { return a.part[k] | b.part[k]; });
    }
    friend Condition operator!(const Condition& a) {
      return by_part([&](int k) { return ~a.part[k]; });
    }
    friend Pack choose(const Condition& c, const Pack& x, const Pack& y) {
      return Pack::by_part(
          [&](int k) { return (Register)((c.part[k] & (Mask)x.part[k]) | (~c.part[k] & (Mask)y.part[k])); });
    }
    ///@}
  };

  Pack() = default;
  // The copy is written out, and unrolled also at -O2, so that it consists of register moves. Without this,
  // collocation of order 16 takes twice as long.
  /// Register by register.
  Pack(const Pack& other) {
#pragma GCC unroll 16
    for (int k = 0; k < parts; ++k)
      part[k] = other.part[k];
  }
  /// Register by register.
  Pack& operator=(const Pack& other) {
#pragma GCC unroll 16
    for (int k = 0; k < parts; ++k)
      part[k] = other.part[k];
    return *this;
  }
  /// A pack of w copies of one number.
  Pack(double value) {  // NOLINT: implicit, so that formulas read as written
#pragma GCC unroll 16
    for (int k = 0; k < parts; ++k)
      part[k] = value - Register{};
  }

  /// Number i (0-based).
  [[nodiscard]] double operator[](int i) const { return part[i / lanes][i % lanes]; }
  void set(int i, double value) { part[i / lanes][i % lanes] = value; }  ///< Sets number i (0-based).

  /// The pack of the w numbers that start at `numbers`, anywhere in memory.
  [[nodiscard]] static Pack load(const double* numbers) {
    return by_part(
        [&](int k) -> Register { return *reinterpret_cast<const InMemory*>(numbers + k * lanes); });
  }
  /// Stores the w numbers at `numbers` and beyond.
  void store(double* numbers) const {
#pragma GCC unroll 16
    for (int k = 0; k < parts; ++k)
      *reinterpret_cast<InMemory*>(numbers + k * lanes) = part[k];
  }
  /// The first (k = 0) or last (k = 1) half of the numbers; w is at least 4.
  [[nodiscard]] Pack<w / 2> half(int k) const {
    if constexpr (parts > 1)
      return Pack<w / 2>::by_part([&](int j) { return part[k * parts / 2 + j]; });
    else
      return Pack<w / 2>::load(reinterpret_cast<const double*>(part) + k * w / 2);
  }
  /// Applies f to each number.
  template <class F>
  [[nodiscard]] Pack each(F f) const {
    Pack y;
    for (int i = 0; i < w; ++i)
      y.set(i, f((*this)[i]));
    return y;
  }
  /// The same for a function of the standard library that has overloads for other types.
  [[nodiscard]] Pack each(double (*f)(double)) const { return each<double (*)(double)>(f); }
  /// Applies f to each pair of numbers.
  template <class F>
  [[nodiscard]] static Pack each(F f, const Pack& a, const Pack& b) {
    Pack y;
    for (int i = 0; i < w; ++i)
      y.set(i, f(a[i], b[i]));
    return y;
  }
  /// The pack whose register k is f(k).
  template <class F>
  [[nodiscard]] static Pack by_part(F f) {
    Pack y;
#pragma GCC unroll 16
    for (int k = 0; k < parts; ++k)
      y.part[k] = f(k);
    return y;
  }

  ///@{

  /// Number by number.
  friend Pack operator-(const Pack& a) {
    return by_part([&](int k) { return -a.part[k]; });
  }
  friend Pack operator+(const Pack& a, const Pack& b) {
    return by_part([&](int k) -> Register { return a.part[k] + b.part[k]; });
  }
  friend Pack operator-(const Pack& a, const Pack& b) {
    return by_part([&](int k) -> Register { return a.part[k] - b.part[k]; });
  }
  friend Pack operator*(const Pack& a, const Pack& b) {
    return by_part([&](int k) -> Register { return a.part[k] * b.part[k]; });
  }
  friend Pack operator/(const Pack& a, const Pack& b) {
    return by_part([&](int k) -> Register { return a.part[k] / b.part[k]; });
  }
  ///@}

  ///@{

  /// Functions of each number. Square root, sine and cosine (up to |x| = 8e5), the exponential (where the
  /// result is a normal number) and the logarithm (of normal numbers) use vector instructions; they are right
  /// to one unit in the last place, with the same bits on every machine. Outside these ranges, and for all
  /// other functions, the standard library is called for each number.
  friend Pack sqrt(const Pack& x) {
#if defined(__AVX512F__)
    if constexpr (lanes == 8)
      return by_part([&](int k) -> Register { return _mm512_maskz_sqrt_pd(0xff, __m512d(x.part[k])); });
#endif
#if defined(__AVX__)
    if constexpr (lanes == 4)
      return by_part([&](int k) -> Register { return _mm256_sqrt_pd(__m256d(x.part[k])); });
#endif
#if defined(__SSE2__)
    if constexpr (lanes == 2)
      return by_part([&](int k) -> Register { return _mm_sqrt_pd(__m128d(x.part[k])); });
#endif
    return x.each(std::sqrt);
  }
  friend Pack sin(const Pack& x) { return detail::turned(x, 0); }
  friend Pack cos(const Pack& x) { return detail::turned(x, 1); }
  friend Pack exp(const Pack& x) {
    return detail::by_register(x, detail::least_exponent, detail::most_exponent,
                               detail::exponential<Register>, detail::library_exp);
  }
  friend Pack log(const Pack& x) {
    return detail::by_register(x, detail::least_number, detail::most_number, detail::logarithm<Register>,
                               detail::library_log);
  }
  friend Pack abs(const Pack& x) {
    return by_part([&](int k) { return (Register)detail::magnitude(x.part[k]); });
  }
  friend Pack sign_of(const Pack& x) { return x.each(avi::sign_of); }
  /// The larger absolute value of each pair of numbers; NaN where either is NaN, because its bits exceed
  /// those of all others.
  friend Pack max_abs(const Pack& a, const Pack& b) {
    return by_part([&](int k) {
      const auto x = detail::magnitude(a.part[k]), y = detail::magnitude(b.part[k]);
      return (Register)(x > y ? x : y);
    });
  }
  /// Each number to a constant power, as power() of a double; exponents that are multiples of 1/4 are also
  /// computed from roots and products. Negative ones down to -7/4 share the reciprocal of the root, so that a
  /// distance, its usual powers and their slopes cost a single division.
  friend Pack pow(const Pack& x, double exponent) {
    const double four = 4.0 * exponent;
    if (!(std::abs(four) <= 32.0) || four != static_cast<double>(static_cast<int>(four)))
      return x.each([&](double v) { return std::pow(v, exponent); });
    const int m = static_cast<int>(std::abs(four));
    const bool shares = four < 0.0 && four > -8.0 && m % 4;
    Pack y(1.0), factor = x;
    if (m % 4) {
      const Pack root = sqrt(x);
      if (shares)
        factor = 1.0 / root;
      else if (m % 4 > 1)
        y = root;
      if (m % 2) y *= sqrt(root);
    }
    for (int k = shares ? (m + 1) / 2 : m / 4; k > 0; k /= 2, factor *= factor)
      if (k % 2) y *= factor;
    return four < 0.0 && !shares ? 1.0 / y : y;
  }
  ///@}

  /// @cond
#define AVI_side_by_side(name)
#define AVI_one_by_one(name)                                                                                 \
  friend Pack name(const Pack& x) { return x.each(std::name); }
#define AVI_ONE(name, pack, ...) AVI_##pack(name)
#define AVI_TWO(name, ...)                                                                                   \
  friend Pack name(const Pack& a, const Pack& b) {                                                           \
    return each([](double x, double y) { return std::name(x, y); }, a, b);                                   \
  }
  AVI_FUNCTIONS(AVI_ONE, AVI_TWO)
#undef AVI_ONE
#undef AVI_TWO
#undef AVI_one_by_one
#undef AVI_side_by_side
  /// @endcond

  ///@{

  /// Compares each pair of numbers.
  friend Condition operator<(const Pack& a, const Pack& b) {
    return Condition::by_part([&](int k) { return a.part[k] < b.part[k]; });
  }
  friend Condition operator>(const Pack& a, const Pack& b) { return b < a; }
  friend Condition operator<=(const Pack& a, const Pack& b) {
    return Condition::by_part([&](int k) { return a.part[k] <= b.part[k]; });
  }
  friend Condition operator>=(const Pack& a, const Pack& b) { return b <= a; }
  ///@}
};

/// Sum of the numbers of a pack: the two halves are added repeatedly, in the same order on every machine.
template <int w>
double sum(const Pack<w>& x) {
  if constexpr (w == 2) return x[0] + x[1];
  if constexpr (w > 2) return sum(Pack<w / 2>(x.half(0) + x.half(1)));
}

/// The largest absolute value of the numbers, NaN where one is NaN. It is found by halves, without branches.
template <int w>
double largest(const Pack<w>& x) {
  if constexpr (w == 2) return max_abs(x, Pack<2>(x[1]))[0];
  if constexpr (w > 2) return largest(max_abs(x.half(0), x.half(1)));
}

/// @cond
}  // namespace AVI_INSTRUCTIONS
/// @endcond
}  // namespace avi
