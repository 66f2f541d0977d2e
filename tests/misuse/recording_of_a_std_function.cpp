// error: A function that is recorded must be generic in its scalar: let it take `const auto& q`
#include <functional>

int main() {
  const std::function<double(const avi::VectorX&)> f;
  return avi::Recording(f, 2).inputs();
}
