// error: This function takes a third argument: H(q, t, p) becomes a function of (q, p) by
int main() {
  const avi::Recording recording =
      avi::record<2>([](const auto& q, const auto& t, const auto& p) { return q[0] * p[0] * t; });
  return recording.inputs();
}
