#include "src/steps/builds.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

namespace avi::detail {

std::span<const Build> builds() {
#ifdef AVI_THREE_BUILDS
  __builtin_cpu_init();
#define AVI_HAS(instructions) (__builtin_cpu_supports(instructions) != 0)
#endif
  static const Build builds[] = {
#ifdef AVI_THREE_BUILDS
      // The sets of instructions are those of lib/CMakeLists.txt.
      {"v4", gauss_steps_v4, splitting_steps_v4, minimise_v4,
       AVI_HAS("avx512f") && AVI_HAS("avx512dq") && AVI_HAS("avx512vl") && AVI_HAS("fma") && AVI_HAS("bmi2")},
      {"v3", gauss_steps_v3, splitting_steps_v3, minimise_v3, AVI_HAS("avx2") && AVI_HAS("bmi2")},
#endif
      {"portable", gauss_steps_portable, splitting_steps_portable, minimise_portable, true}};
#undef AVI_HAS
  return builds;
}

const Build& build_of(const char* name) {
  const std::string asked = name ? name : "";
  std::string names;
  for (const Build& build : builds()) {
    if (asked.empty() ? build.runs : build.name == asked) {
      if (build.runs) return build;
      throw std::invalid_argument(
          "AVI_INSTRUCTIONS is " + asked +
          ", which this processor does not have; leave it empty for the best it has.");
    }
    names = build.name + (names.empty() ? "" : ", " + names);
  }
  throw std::invalid_argument("AVI_INSTRUCTIONS is " + asked + "; this library is built for " + names +
                              ", of which it must be one.");
}

namespace {

const Build& chosen_build() {
  static const Build& build = build_of(std::getenv("AVI_INSTRUCTIONS"));
  return build;
}

}  // namespace

std::unique_ptr<Stepper> gauss_steps(std::shared_ptr<const Formulas> formulas, int order,
                                     SweepSettings sweeps) {
  return chosen_build().make(std::move(formulas), order, sweeps);
}

std::unique_ptr<Stepper> splitting_steps(std::shared_ptr<const Formulas> formulas) {
  return chosen_build().splitting(std::move(formulas));
}

MinimiserEnd minimise_by_calls(MinimiserCalls& calls, Eigen::Index n, const MinimiseOptions& options) {
  return chosen_build().minimise(calls, n, options);
}

}  // namespace avi::detail
