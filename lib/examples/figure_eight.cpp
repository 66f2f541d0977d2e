#include <avi/htvi/htvi.hpp>
#include <avi/htvi/landing.hpp>
#include <avi/problems/n_body.hpp>

#include <cstdio>

// Three equal masses chase each other along one figure-eight curve (Chenciner and Montgomery 2000). After
// each period every body is back where it started, and after a third of it where the next one started.

int main() {
  const auto bodies = avi::FigureEight::problem();
  const avi::State<6> start = avi::FigureEight::start();
  const double energy = bodies(start.q, start.p);

  avi::State<6> z = start;
  auto method = avi::type2<7>(avi::poincare<6>(bodies, z), avi::gauss(4));  // order 8 and more
  const double third = avi::FigureEight::period / 3.0;
  std::printf("  t / T   positions (x, y) of the three bodies\n");
  for (int k = 1; k <= 6; ++k) {
    const avi::Run run = avi::integrate_to(method, z, 0.08, k * third);
    if (run.outcome != avi::Outcome::ok) {
      std::printf("%s\n", run.message.c_str());
      return 1;
    }
    std::printf("%7.3f", k / 3.0);
    for (int i = 0; i < 6; i += 2)
      std::printf("   (%6.3f, %6.3f)", z.q[i] + 0.0, z.q[i + 1] + 0.0);
    std::printf("\n");
  }
  std::printf("back at the start to %.0e, limited by the digits of the start; energy kept to %s\n",
              (z.q - start.q).norm(), std::abs(bodies(z.q, z.p) - energy) < 1e-12 ? "1e-12" : "less");
}
