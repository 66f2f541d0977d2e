// error: A function that is recorded must be generic in its scalar: let it take `const auto& q`
int main() {
  const avi::Recording recording = avi::Recording([](const avi::VectorX& x) { return x[0] * x[0]; }, 2);
  return recording.inputs();
}
