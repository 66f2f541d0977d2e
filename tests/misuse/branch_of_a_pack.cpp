// error: A formula that is evaluated at several points at once cannot branch: instead of `if` or `?:` write
// select(a < b, x, y), min(x, y), max(x, y) or abs(x), without std::.

int main() {
  const avi::Pack<4> x(1.0);
  return x < 2.0 ? 1 : 0;
}
