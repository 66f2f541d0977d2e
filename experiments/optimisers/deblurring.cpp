#include "common/frame.hpp"
#include "optimisers/optimiser_arena/meter.hpp"

#include "avi/optim/minimise.hpp"

#include <algorithm>

// A picture that was blurred and has noise is restored: minimise |B x - b|^2 / 2 + weight TV(x), with B a
// blur by a Gaussian of three pixels' width, TV the total variation smoothed at 1e-3, and b = B (picture) +
// noise of standard deviation 0.01. 64 x 64 pixels, from x = b. Ours beside a library's L-BFGS, from the same
// start.

namespace {

using namespace experiment;
using avi::VectorX;

constexpr Eigen::Index side = 64;
constexpr double weight = 2e-3;

/// Discs, a bar and a ramp, between 0 and 1.
VectorX picture() {
  VectorX x = VectorX::Zero(side * side);
  for (Eigen::Index i = 0; i < side; ++i)
    for (Eigen::Index j = 0; j < side; ++j) {
      const double u = static_cast<double>(i) / side, v = static_cast<double>(j) / side;
      double& pixel = x[i * side + j];
      if (std::hypot(u - 0.3, v - 0.3) < 0.2) pixel = 1.0;
      if (std::hypot(u - 0.3, v - 0.3) < 0.08) pixel = 0.3;
      if (u > 0.62 && u < 0.9 && v > 0.1 && v < 0.5) pixel = 0.6;
      if (v > 0.6 && v < 0.92 && u > 0.15 && u < 0.85) pixel = std::fmod(5.0 * u, 1.0) < 0.5 ? 0.9 : 0.1;
    }
  return x;
}

/// Rows, then columns, by a Gaussian kernel; pixels outside are 0. Symmetric.
VectorX blur(const VectorX& x) {
  constexpr Eigen::Index reach = 6;
  static const std::array<double, reach + 1> kernel = [] {
    std::array<double, reach + 1> k{};
    double sum = 0.0;
    for (Eigen::Index i = 0; i <= reach; ++i) {
      k[static_cast<std::size_t>(i)] = std::exp(-0.5 * static_cast<double>(i * i) / 2.25);
      sum += (i == 0 ? 1.0 : 2.0) * k[static_cast<std::size_t>(i)];
    }
    for (double& entry : k)
      entry /= sum;
    return k;
  }();
  const auto along = [&](const VectorX& from, Eigen::Index stride, Eigen::Index across) {
    VectorX to = VectorX::Zero(from.size());
    for (Eigen::Index line = 0; line < side; ++line)
      for (Eigen::Index i = 0; i < side; ++i)
        for (Eigen::Index k = std::max<Eigen::Index>(-reach, -i); k <= std::min(reach, side - 1 - i); ++k)
          to[line * across + i * stride] +=
              kernel[static_cast<std::size_t>(std::abs(k))] * from[line * across + (i + k) * stride];
    return to;
  };
  return along(along(x, 1, side), side, 1);
}

double objective(const VectorX& b, const VectorX& x, VectorX& g) {
  const VectorX r = blur(x) - b;
  g = blur(r);
  double f = 0.5 * avi::dot(r, r);
  for (Eigen::Index i = 0; i + 1 < side; ++i)
    for (Eigen::Index j = 0; j + 1 < side; ++j) {
      const Eigen::Index k = i * side + j;
      const double u = x[k + side] - x[k], v = x[k + 1] - x[k], size = std::sqrt(u * u + v * v + 1e-6);
      f += weight * size;
      g[k + side] += weight * u / size;
      g[k + 1] += weight * v / size;
      g[k] -= weight * (u + v) / size;
    }
  return f;
}

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, AVI_SHOWS, [](Frame& frame) {
    const VectorX truth = picture();
    arena::Numbers numbers(1);
    const VectorX b = blur(truth) + 0.01 * numbers.normals(side * side);
    const auto f = [&b](const VectorX& x, VectorX& g) { return objective(b, x, g); };
    const auto distance = [&](const VectorX& x) { return avi::norm(x - truth) / avi::norm(truth); };

    Table table = frame.table({"method", "delta", "iterations", "gradient_evaluations", "converged", "value",
                               "error_before", "error_after", "seconds"});
    table.note("error", "of the picture, |x - truth| / |truth|");
    table.note("value, error_after", "at the end of the run, which goes on to the smaller delta");
    Table curves = frame.table({"method", "gradients", "gradient_ratio", "value"});
    VectorX restored;
    for (const arena::Method& method : arena::all_methods()) {
      if (method.name != "minimise_m7" && method.name != "minimise_m0" && method.name != "lbfgs") continue;
      double first = 0.0, value = 0.0;
      long gradients = 0;
      VectorX last;
      const arena::Problem problem{.name = "deblurring", .x0 = b, .f = [&](const VectorX& x, VectorX& g) {
                                     value = f(x, g);
                                     const double size = avi::norm(g);
                                     if (gradients++ == 0) first = size;
                                     curves.row(method.name, gradients, size / first, value);
                                     last = x;
                                     return value;
                                   }};
      const arena::Passages passages =
          arena::Meter(problem, b, frame.quick ? 200 : 5000).run(method.runs.front());
      if (method.name == "minimise_m7") restored = last;
      for (std::size_t k = 0; k < arena::tolerances.size(); ++k) {
        const arena::Passage& p = passages[k];
        table.row(method.name, arena::tolerances[k], p.iterations, p.gradients, p.converged, value,
                  distance(b), distance(last), p.seconds);
      }
    }
    Table pixels = frame.table({"row", "column", "truth", "blurred", "restored"});
    for (Eigen::Index i = 0; i < side; ++i)
      for (Eigen::Index j = 0; j < side; ++j)
        pixels.row(i, j, truth[i * side + j], b[i * side + j], restored[i * side + j]);
    frame.write(curves, "curves");
    frame.write(pixels, "pixels");
    frame.write(table);
  });
}
