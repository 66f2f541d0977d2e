#pragma once
#include "avi/core/instructions.hpp"

#include "avi/core/finite_math.hpp"

#include <cmath>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// @file
/// Sine and cosine of the numbers of a pack, all at once.

namespace avi::detail {
/// @cond
inline namespace AVI_INSTRUCTIONS {
/// @endcond

/// Largest |x| of sine(): there \f$2x/\pi\f$ rounds to an integer of 19 bits.
inline constexpr double most_angle = 8e5;

/// Some number of a register is beyond most_angle, or NaN.
template <class V>
[[gnu::always_inline]] inline bool out_of_reach(V x) {
  const V square = x * x;
  constexpr double most = most_angle * most_angle;
#if defined(__AVX512F__)
  if constexpr (sizeof(V) == 64)
    return _mm512_cmp_pd_mask(__m512d(square), _mm512_set1_pd(most), _CMP_NLE_UQ) != 0;
#endif
#if defined(__AVX__)
  if constexpr (sizeof(V) == 32) return _mm256_movemask_pd(__m256d(square <= most)) != 15;
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(V) == 16) return _mm_movemask_pd(__m128d(square <= most)) != 3;
#endif
  bool all = true;
  for (unsigned i = 0; i < sizeof(V) / 8; ++i)
    all = all && square[i] <= most;
  return !all;
}

/// The value of the standard library for sin(x + quarters pi/2), quarters = 0 or 1.
[[gnu::cold, gnu::noinline]] inline double sine_far_away(double x, int quarters) {
  return quarters == 0 ? std::sin(x) : std::cos(x);
}

/// sin(x + quarters pi/2) of every number of a register with |x| up to most_angle, to less than one unit in
/// the last place: the polynomials of Sun's fdlibm (k_sin.c, k_cos.c, 1993) at x less the nearest multiple of
/// pi/2.
///
/// The reduction is that of Cody and Waite (Software Manual for the Elementary Functions, 1980): three pieces
/// of pi/2 of 33 bits each, times an integer of 19 bits, and what each of them leaves, are without rounding
/// error wherever most of x cancels.
template <class V>
[[gnu::always_inline]] inline V sine(V x, int quarters) {
  using Integers = decltype(x < x);
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

/// sin(x + quarters pi/2), quarters = 0 or 1, of every number of a Pack; where one is far away, all by the
/// library. Both are computed from one line of operations, so that the compiler finds what they share.
template <class P>
P turned(const P& x, int quarters) {
  using Register = typename P::Register;
  bool far = false;
  for (int k = 0; k < P::parts; ++k)
    far |= out_of_reach<Register>(x.part[k]);
  P y = P::by_part([&](int k) { return sine<Register>(x.part[k], quarters); });
  if (far) [[unlikely]]
    y = x.each([&](double v) { return sine_far_away(v, quarters); });
  return y;
}

/// @cond
}  // namespace AVI_INSTRUCTIONS
/// @endcond
}  // namespace avi::detail
