#pragma once

/// @file
/// The instruction set for which the current file is compiled.

// Code that depends on the instruction set is placed in an inline namespace of this name. Two files of one
// program compiled with different -m options then do not share functions, of which the linker would keep only
// one.
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
/// Number of doubles in a vector register.
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
