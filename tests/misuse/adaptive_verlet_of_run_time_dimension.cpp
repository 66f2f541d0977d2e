// error: Adaptive Verlet needs a dimension known at compile time.
#include <avi/integrators/adaptive_verlet.hpp>
#include <avi/problems/n_body.hpp>

int main() {
  const avi::NBody<avi::dynamic> bodies(avi::Vector<double, avi::dynamic>::Ones(3));
  const auto monitor = [](const auto&, const auto&) { return 1.0; };
  return experiment::AdaptiveVerlet(bodies, monitor).order();
}
