// error: A function that turns its arguments into numbers cannot be recorded: make it generic in its
// scalar, or, where the compiler knows the dimension, supply d_dq(q, p) and d_dp(q, p).
#include <avi/autodiff/recording.hpp>

int main() {
  const avi::Recording recording([](const auto& x) { return x[0] * static_cast<double>(x[0]); }, 1);
  return recording.inputs();
}
