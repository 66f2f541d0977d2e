// error: A function that compares its arguments cannot be recorded: a straight line of operations has no
// branches.
#include <avi/autodiff/recording.hpp>

int main() {
  const avi::Recording recording([](const auto& x) { return x[0] > 0.0 ? x[0] : -x[0]; }, 1);
  return recording.inputs();
}
