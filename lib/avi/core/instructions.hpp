#pragma once

/// @file
/// The instruction set that this file is compiled for.

// What depends on it lies in an inline namespace of this name: two files of a program that are compiled with
// different -m options then do not share a function, of which the linker would keep one.
/// @cond
#if defined(__AVX512F__)
#define AVI_INSTRUCTIONS avx512
#elif defined(__AVX2__)
#define AVI_INSTRUCTIONS avx2
#elif defined(__AVX__)
#define AVI_INSTRUCTIONS avx
#else
#define AVI_INSTRUCTIONS basic
#endif
/// @endcond

namespace avi::detail {
/// @cond
inline namespace AVI_INSTRUCTIONS {
/// @endcond
/// Doubles in a vector register.
#if defined(__AVX512F__)
inline constexpr int machine_lanes = 8;
#elif defined(__AVX__)
inline constexpr int machine_lanes = 4;
#else
inline constexpr int machine_lanes = 2;
#endif
/// @cond
}  // namespace AVI_INSTRUCTIONS
/// @endcond
}  // namespace avi::detail
