#pragma once

/// @file
/// Refuses to compile without C++20, with options that assume no number is infinite or NaN, or with options
/// that reorder additions. (Clang does not report the last kind.)

#if __cplusplus < 202002L
#error avi needs C++20: compile it with -std=c++20, or a newer standard.
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error avi must be compiled without -ffast-math (-Ofast, -ffinite-math-only): it could not see infinite or NaN.
#elif defined(__ASSOCIATIVE_MATH__)
#error avi must be compiled without -fassociative-math (-funsafe-math-optimizations): sums could not keep their rounding errors.
#endif
