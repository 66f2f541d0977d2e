#pragma once
#include <cmath>
#include <string_view>
#include <vector>

/// @file
/// Symmetric compositions of two flows, by which the cloned Hamiltonian is integrated.

namespace avi {

/// Strang's splitting (order 2) and Yoshida's triple jumps of it (orders 4 and 6).
enum class CloneComposition { strang, yoshida4, yoshida6 };

/// The name in data files: clone_strang, clone_y4, clone_y6.
constexpr std::string_view clone_name(CloneComposition composition) {
  switch (composition) {
  case CloneComposition::strang:
    return "clone_strang";
  case CloneComposition::yoshida4:
    return "clone_y4";
  case CloneComposition::yoshida6:
    return "clone_y6";
  }
  return "unknown";
}

/// Step lengths of B(b_0) A(a_1) B(b_1) ... A(a_m) B(b_m), in units of h: neighbouring B flows are merged.
struct MergedStages {
  std::vector<double> a;  ///< m entries, m = 1, 3, 9.
  std::vector<double> b;  ///< m + 1 entries.
};

/// The triple jump raises the order 2k of a symmetric step to 2k + 2 by the lengths w, 1 - 2w, w with
/// w = 1 / (2 - 2^(1/(2k+1))) (Yoshida 1990).
inline MergedStages merged_stages(CloneComposition composition) {
  std::vector<double> lengths{1.0};
  const auto triple_jump = [&](double order) {
    const double w = 1.0 / (2.0 - std::pow(2.0, 1.0 / (order + 1.0)));
    std::vector<double> jumped;
    for (const double outer : {w, 1.0 - 2.0 * w, w})
      for (const double inner : lengths)
        jumped.push_back(outer * inner);
    lengths = std::move(jumped);
  };
  if (composition != CloneComposition::strang) triple_jump(2.0);
  if (composition == CloneComposition::yoshida6) triple_jump(4.0);
  MergedStages stages{.a = lengths, .b = {0.5 * lengths.front()}};
  for (std::size_t i = 0; i + 1 < lengths.size(); ++i)
    stages.b.push_back(0.5 * (lengths[i] + lengths[i + 1]));
  stages.b.push_back(0.5 * lengths.back());
  return stages;
}

}  // namespace avi
