#pragma once
#include "avi/core/instructions.hpp"

#include "avi/core/compiler.hpp"

#include <cmath>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// @file
/// Sine, cosine, exponential and logarithm of all numbers of a pack at once.

namespace avi::detail {
/// @cond
inline namespace AVI_INSTRUCTIONS {
/// @endcond

/// Largest |x| for sine(): up to it \f$2x/\pi\f$ rounds to an integer of 19 bits.
inline constexpr double most_angle = 8e5;

/// True where a number of a register is NaN or not between two bounds.
template <class V>
[[gnu::always_inline]] inline bool any_outside(V x, double least, double most) {
#if defined(__AVX512F__)
  if constexpr (sizeof(V) == 64)
    return (_mm512_cmp_pd_mask(__m512d(x), _mm512_set1_pd(most), _CMP_NLE_UQ) |
            _mm512_cmp_pd_mask(__m512d(x), _mm512_set1_pd(least), _CMP_NGE_UQ)) != 0;
#endif
#if defined(__AVX__)
  if constexpr (sizeof(V) == 32) return _mm256_movemask_pd(__m256d((least <= x) & (x <= most))) != 15;
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(V) == 16) return _mm_movemask_pd(__m128d((least <= x) & (x <= most))) != 3;
#endif
  bool all = true;
  for (unsigned i = 0; i < sizeof(V) / 8; ++i)
    all = all && least <= x[i] && x[i] <= most;
  return !all;
}

/// sin(x + quarters pi/2) by the standard library, quarters = 0 or 1.
[[gnu::cold, gnu::noinline]] inline double sine_far_away(double x, int quarters) {
  return quarters == 0 ? std::sin(x) : std::cos(x);
}

/// The type of a register of integers as wide as the register of numbers V. They are unsigned, so that sums
/// wrap round where a NaN or a number out of bounds is processed in vain.
template <class V>
struct UnsignedBeside {
  typedef unsigned long long Type __attribute__((vector_size(sizeof(V))));  ///< The register.
};
template <class V>
using UnsignedOf = typename UnsignedBeside<V>::Type;

/// sin(x + quarters pi/2) of every number of a register with |x| up to most_angle, with an error below one
/// unit in the last place. It uses the polynomials of Sun's fdlibm (k_sin.c, k_cos.c, 1993) for x minus the
/// nearest multiple of pi/2.
///
/// The reduction follows Cody and Waite (Software Manual for the Elementary Functions, 1980): pi/2 is split
/// into pieces of 33 bits. The products of the first three pieces with an integer of 19 bits, and the
/// remainders after subtracting them, have no rounding error wherever most of x cancels.
template <class V>
[[gnu::always_inline]] inline V sine(V x, int quarters) {
  using Integers = UnsignedOf<V>;
  constexpr double round = 0x1.8p52, per_quarter = 0x1.45f306dc9c883p-1;  // 2/pi
  const V shifted = x * per_quarter + round, k = shifted - round;  // its last two bits count quarter turns
  const V first = x - k * 0x1.921fb544p0;
  const V taken = k * 0x1.0b4611a6p-34, second = first - taken;
  const V cut = (first - second) - taken;
  const V taken_last = k * 0x1.3198a2ep-69, r = second - taken_last;  // in [-pi/4, pi/4], but for rounding
  const V low = (cut + ((second - r) - taken_last)) - k * 0x1.b839a252049c1p-104;  // what rounding cut off
  const V z = r * r, square = z * z;
  const V s = 8.33333333332248946124e-03 +
              z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06) +
              z * square * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
  const V cube = z * r;
  const V sine = r - ((z * (0.5 * low - cube * s) - low) + cube * 1.66666666666666324348e-01);
  const V c =
      z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05)) +
      square * square *
          (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
  const V half = 0.5 * z, rest = 1.0 - half;
  const V cosine = rest + (((1.0 - rest) - half) + (z * c - r * low));
  const Integers quadrant = (Integers)shifted + quarters, odd = -(quadrant & 1);
  const Integers size = ((Integers)cosine & odd) | ((Integers)sine & ~odd);
  return (V)(size ^ ((quadrant & 2) << 62));
}

/// Bounds of the argument of exponential(), between which the result is a normal number.
inline constexpr double least_exponent = -708.0, most_exponent = 709.0;

/// exp(x) of every number of a register within these bounds, with an error below one unit in the last place:
/// the rational function of Sun's fdlibm (e_exp.c, 1993) for x minus the nearest multiple of log 2.
template <class V>
[[gnu::always_inline]] inline V exponential(V x) {
  using Integers = UnsignedOf<V>;
  constexpr double round = 0x1.8p52, per_log_2 = 0x1.71547652b82fep0;
  const V shifted = x * per_log_2 + round, k = shifted - round;
  // The first part of log 2 has 33 bits, so that its product with an integer of 11 bits is exact.
  const V high = x - k * 6.93147180369123816490e-01, low = k * 1.90821492927058770002e-10, r = high - low;
  const V z = r * r;
  const V c = r - z * (1.66666666666666019037e-01 +
                       z * (-2.77777777770155933842e-03 +
                            z * (6.61375632143793436117e-05 +
                                 z * (-1.65339022054652515390e-06 + z * 4.13813679705723846039e-08))));
  const V y = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
  return (V)((Integers)y + ((Integers)shifted << 52));  // 2^k y
}

/// Bounds of the argument of logarithm(): the normal numbers.
inline constexpr double least_number = 0x1p-1022, most_number = 0x1.fffffffffffffp1023;

/// log(x) of every number of a register within these bounds, with an error below one unit in the last place:
/// Sun's fdlibm (e_log.c, 1993), with \f$x = 2^k(1+f)\f$ and \f$\sqrt{1/2} < 1+f < \sqrt 2\f$.
template <class V>
[[gnu::always_inline]] inline V logarithm(V x) {
  using Integers = UnsignedOf<V>;
  constexpr unsigned long long root_half = 0x3fe6a09e00000000, one = 0x3ff0000000000000,
                               fraction = 0xfffffffffffff;
  const Integers moved = (Integers)x + (one - root_half);        // positive
  constexpr unsigned long long as_integer = 0x4330000000000000;  // 2^52, whose last bit counts ones
  const V k = (V)(((moved >> 52) & 0xfff) | as_integer) - (0x1p52 + 1023.0);
  const V f = (V)((moved & fraction) + root_half) - 1.0;
  const V s = f / (2.0 + f), z = s * s, w = z * z;
  const V odd =
      w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const V even =
      z * (6.666666666666735130e-01 +
           w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const V half_square = 0.5 * f * f;
  return k * 6.93147180369123816490e-01 -
         ((half_square - (s * (half_square + (odd + even)) + k * 1.90821492927058770002e-10)) - f);
}

/// Exponential and logarithm by the standard library, which takes long to return a zero; that case is handled
/// here.
[[gnu::cold, gnu::noinline]] inline double library_exp(double x) { return x < -746.0 ? 0.0 : std::exp(x); }
[[gnu::cold, gnu::noinline]] inline double library_log(double x) { return std::log(x); }

/// Applies f to every register of a pack; if any number lies outside the bounds, applies far_away to every
/// number instead.
template <class P, class F, class G>
P by_register(const P& x, double least, double most, F f, G far_away) {
  using Register = typename P::Register;
  bool far = false;
  for (int k = 0; k < P::parts; ++k)
    far |= any_outside<Register>(x.part[k], least, most);
  P y = P::by_part([&](int k) -> Register { return f(x.part[k]); });
  if (far) [[unlikely]]
    y = x.each(far_away);
  return y;
}

/// sin(x + quarters pi/2), quarters = 0 or 1, of every number of a Pack; all by the standard library if one
/// is too large. Sine and cosine share one list of operations, so that the compiler finds their common parts.
template <class P>
P turned(const P& x, int quarters) {
  using Register = typename P::Register;
  return by_register(
      x, -most_angle, most_angle, [&](Register v) { return sine<Register>(v, quarters); },
      [&](double v) { return sine_far_away(v, quarters); });
}

/// @cond
}  // namespace AVI_INSTRUCTIONS
/// @endcond
}  // namespace avi::detail
