#pragma once

/// @file
/// Refuses compilers that may assume that no number is infinite or NaN.

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error avi must be compiled without -ffast-math (-Ofast, -ffinite-math-only): it could not see infinite or NaN.
#endif
