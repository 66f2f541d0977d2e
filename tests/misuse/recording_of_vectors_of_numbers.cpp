// error: A function that is recorded must be generic in its scalar: let it take `const auto& q`
int main() {
  const avi::Recording recording = avi::record<2>(
      [](const avi::Vector<double, 2>& q, const avi::Vector<double, 2>& p) { return q[0] * p[0]; });
  return recording.inputs();
}
