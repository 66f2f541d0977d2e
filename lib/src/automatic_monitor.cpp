#include "avi/automatic_monitor.hpp"

#include "orbit_scales.hpp"

namespace avi::detail {

Formula automatic_monitor(const Formula& hamiltonian, const std::vector<double>& q,
                          const std::vector<double>& p) {
  const auto n = static_cast<Eigen::Index>(q.size());
  const Orbit orbit(hamiltonian.with_constants(), {.q = Eigen::Map<const VectorX>(q.data(), n),
                                                   .p = Eigen::Map<const VectorX>(p.data(), n)});
  Curvature curvature(orbit);
  const OrbitScales scales(orbit, curvature);
  const int monitor = curvature_monitor(curvature, scales);
  return {curvature.graph, monitor};
}

}  // namespace avi::detail
