#include <avi/collocation/collocation.hpp>
#include <avi/core/integrate_to.hpp>
#include <avi/problems/n_body.hpp>
#include <avi/transform/poincare.hpp>

#include <cmath>
#include <cstdio>

// Three equal masses chase each other along one figure-eight curve (Chenciner and Montgomery 2000). After
// each period every body is back where it started, and after a third of it where the next one started.

/// To three digits, without a sign of zero.
double rounded(double x) { return std::round(1e3 * x) / 1e3 + 0.0; }

int main() {
  const auto bodies = avi::FigureEight::problem();
  const avi::State<6> start = avi::FigureEight::start();
  const double energy = bodies(start.q, start.p);

  avi::State<6> z = start;
  auto method = avi::collocation(avi::poincare(bodies, z), 16);
  const double third = avi::FigureEight::period / 3.0;
  std::printf("  t / T   positions (x, y) of the three bodies\n");
  for (int k = 1; k <= 6; ++k) {
    const avi::Run run = avi::integrate_to(method, z, 0.2, k * third);
    if (run.outcome != avi::Outcome::ok) {
      std::printf("%s\n", run.message.c_str());
      return 1;
    }
    std::printf("%7.3f", k / 3.0);
    for (int i = 0; i < 6; i += 2)
      std::printf("   (%6.3f, %6.3f)", rounded(z.q[i]), rounded(z.q[i + 1]));
    std::printf("\n");
  }
  std::printf("back at the start to %.0e, limited by the digits of the start; energy kept to %s\n",
              (z.q - start.q).norm(), std::abs(bodies(z.q, z.p) - energy) < 1e-12 ? "1e-12" : "less");
}
