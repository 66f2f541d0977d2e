// error: THIS_METHOD_IS_ONLY_FOR_VECTORS_OF_A_SPECIFIC_SIZE
#include <Eigen/Geometry>

int main() {
  const Eigen::Vector3d axis{0.0, 0.0, 1.0};
  const avi::State<6> start{.q = {1, 0, 0, 2, 0, 0}, .p = {0, 1, 0, 0, 2, 0}};
  const auto h = [&](const auto& q, const auto& p) {
    return 0.5 * p.squaredNorm() + axis.cross(q.segment(3, 3)).dot(p.segment(3, 3));
  };
  return avi::solve(h, start, 1.0, 1e-6).kept() ? 0 : 1;
}
