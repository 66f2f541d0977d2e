// error: A formula is recorded without values, so its arguments and what is computed from them cannot be
// turned into numbers: make it generic in its scalar, and instead of a branch write select(a < b, x, y)

int main() {
  const avi::Recording recording([](const auto& x) { return x[0] * static_cast<double>(x[0]); }, 1);
  return recording.inputs();
}
