// error: A formula is recorded once for all arguments, so it cannot branch on them: instead of `if` or `?:`
// write select(a < b, x, y), min(x, y), max(x, y) or abs(x), without std::.
#include <algorithm>

int main() {
  const avi::Recording recording([](const auto& x) { return std::min(x[0], x[1]); }, 2);
  return recording.inputs();
}
