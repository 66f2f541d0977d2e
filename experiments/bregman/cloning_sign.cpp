#include "common/frame.hpp"

#include "avi/problems/correlated_quartic.hpp"
#include "bregman/printed/cloning_printed.hpp"

// The last equation of phase-space cloning is printed as r~' = +grad_q~ H_2. Both copies start at one point
// and, if each solves the same equations, stay together but for the error of the splitting, O(h^2).

namespace {

/// Root mean square of the entries of q~ - q after `steps` steps of size h.
double distance_of_copies(double sign, double h, long steps) {
  const avi::CorrelatedQuartic f(3, 0.9);
  // Near the minimum, where every step tried resolves the motion.
  avi::ExtendedPoint z{.q = Eigen::Vector3d(1.3, 0.8, 1.5), .t = 1.0, .r = avi::VectorX::Ones(f.size())},
      clone = z;
  const auto stages = avi::merged_stages(avi::CloneComposition::strang);
  for (long k = 0; k < steps; ++k)
    experiment::cloning_printed_step(avi::BregmanFamily::adaptive(4.0, 1.0), f, h, stages, z, clone, sign);
  return std::sqrt((clone.q - z.q).squaredNorm() / f.size());
}

}  // namespace

int main(int argc, char** argv) {
  double fictive_time = 0.05;
  const auto options = [&](CLI::App& app) {
    experiment::add_number(app, "--fictive-time", fictive_time, {.low = 0.01, .high = 1.0},
                           "Fictive time after which the two copies are compared");
  };
  return experiment::run(argc, argv, AVI_SHOWS, options, [&](experiment::Frame& frame) {
    experiment::Table table = frame.table({"sign", "h", "steps", "distance", "order"});
    table.note("distance",
               "root mean square of the entries of q~ - q; order: log2 of its fall when h is halved");
    for (const double sign : {1.0, -1.0}) {
      double before = std::nan("");
      for (long steps = std::lround(fictive_time / 5e-3), level = 0; level < 4; ++level, steps *= 2) {
        const double h = fictive_time / steps;
        const double distance = distance_of_copies(sign, h, steps);
        table.row(sign, h, steps, distance, std::log2(before / distance));
        before = distance;
      }
    }
    frame.write(table);
  });
}
