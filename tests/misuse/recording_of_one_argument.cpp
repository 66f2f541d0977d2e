// error: A function that is recorded must be callable as f(x), or H(q, p), with vectors of
int main() {
  const avi::Recording recording = avi::record<2>([](const auto& q) { return q[0]; });
  return recording.inputs();
}
