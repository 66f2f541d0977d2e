#include "gauss_builds.hpp"

#include <cstdlib>
#include <string>
#include <utility>

namespace avi::detail {

namespace {

/// The build that this processor is fastest with, or the one that the environment variable AVI_INSTRUCTIONS
/// names. @throws std::invalid_argument where that one will not do.
MakeGaussSteps* chosen_build() {
#ifdef AVI_THREE_BUILDS
  __builtin_cpu_init();
#endif
  struct Build {
    const char* name;
    MakeGaussSteps* make;
    bool runs;  // on this processor
  };
  const Build builds[] = {
#ifdef AVI_THREE_BUILDS
      // Those of lib/CMakeLists.txt.
      {"v4", gauss_steps_v4,
       __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi2")},
      {"v3", gauss_steps_v3, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")},
#endif
      {"portable", gauss_steps_portable, true}};
  const char* const asked = std::getenv("AVI_INSTRUCTIONS");
  if (asked == nullptr || *asked == 0) {
    for (const Build& build : builds)
      if (build.runs) return build.make;
  }
  std::string names;
  for (const Build& build : builds) {
    if (build.name == std::string(asked)) {
      if (build.runs) return build.make;
      throw std::invalid_argument("AVI_INSTRUCTIONS is " + std::string(asked) +
                                  ", but this processor does not have these instructions.");
    }
    names = build.name + (names.empty() ? "" : ", " + names);
  }
  throw std::invalid_argument("AVI_INSTRUCTIONS is " + std::string(asked) +
                              "; it must be one of those that this library is built for: " + names + ".");
}

}  // namespace

std::unique_ptr<GaussSteps> gauss_steps(std::shared_ptr<const Formulas> formulas, int order,
                                        SweepBounds bounds) {
  static MakeGaussSteps* const make = chosen_build();
  return make(std::move(formulas), order, bounds);
}

}  // namespace avi::detail
