#pragma once

/// @file
/// Refuses compilers that know no C++20, that may assume that no number is infinite or NaN, or that add in
/// another order than is written. (Clang does not tell of the last.)

#if __cplusplus < 202002L
#error avi needs C++20: compile it with -std=c++20, or a newer standard.
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error avi must be compiled without -ffast-math (-Ofast, -ffinite-math-only): it could not see infinite or NaN.
#elif defined(__ASSOCIATIVE_MATH__)
#error avi must be compiled without -fassociative-math (-funsafe-math-optimizations): sums could not keep their rounding errors.
#endif
