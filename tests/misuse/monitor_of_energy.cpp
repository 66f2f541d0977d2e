// error: The monitor must be callable as g(q), g(q, p) or g(q, t, p) with vectors of n entries.
int main() {
  const avi::State<1> start{.q = avi::Vector<double, 1>(0.5), .p = avi::Vector<double, 1>(0.0)};
  const auto monitor = [](const auto& q, const auto& t, const auto& p, const auto& p_t) {
    return q * t * p * p_t;
  };
  const auto problem = avi::time_dependent(
      [](const auto& q, const auto& t, const auto& p) { return p[0] * p[0] + t * q[0] * q[0]; }, start,
      monitor);
  return static_cast<int>(problem.size());
}
