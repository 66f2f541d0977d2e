// error: The base must be a method for states of this dimension.
#include <avi/integrators/hairer_soderlind.hpp>
#include <avi/integrators/stormer_verlet.hpp>
#include <avi/problems/kepler.hpp>

int main() {
  experiment::HairerSoderlind method(avi::stormer_verlet<2>(&avi::Kepler::potential_gradient<double>),
                                     experiment::PowerOfRadius{});
  avi::State<3> z{.q = {1.0, 0.0, 0.0}, .p = {0.0, 1.0, 0.0}};
  return method.step(z, 0.1).evaluations;
}
