// error: x0 must be a vector of Eigen, numbers in braces, or an array of double.
#include <list>

// A start whose numbers do not lie in one piece.
int main() {
  const auto f = [](const auto& x) { return x[0] * x[0]; };
  return avi::minimise(f, std::list<double>{1.0}).ok();
}
