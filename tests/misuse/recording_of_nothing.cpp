// error: A function that is recorded must return one number of its arguments' scalar
int main() {
  const avi::Recording recording = avi::Recording([](const auto&) {}, 2);
  return recording.inputs();
}
