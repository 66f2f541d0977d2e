#include "src/delivery/dips.hpp"

#include <algorithm>
#include <cmath>

namespace avi::detail {

namespace {

constexpr double small = 0.01;  // size relative to its neighbours below which the polynomial may be wrong
constexpr int deepest = 12;

double secant(const std::vector<Sample>& samples, std::size_t k) {
  return (samples[k + 1].g - samples[k].g) / (samples[k + 1].part - samples[k].part);
}

}  // namespace

bool Dips::may_hide(const std::vector<Sample>& samples, std::size_t k) {
  const std::size_t last = samples.size() - 2;
  if (last < 2 || samples[k].turns) return true;
  const Sample &a = samples[k], &b = samples[k + 1];
  const double here = secant(samples, k), one = secant(samples, k == 0 ? 1 : k - 1),
               other = secant(samples, k == 0      ? 2
                                       : k == last ? k - 2
                                                   : k + 1);
  const double most = std::max(std::abs(one), std::abs(other));
  // A parabola turns at most an eighth of its second difference below the lower sample.
  if (a.g * b.g > 0.0 &&
      std::min(std::abs(a.g), std::abs(b.g)) > (b.part - a.part) * std::max(most, std::abs(here)))
    return false;
  // Near zero, a quartic may dip below it although the secants say that it rises all the way.
  if (a.g * b.g > 0.0 && std::min(std::abs(a.g), std::abs(b.g)) < 0.25 * std::abs(b.g - a.g)) return true;
  // A cubic with these secants rises, or falls, all the way, up to a ratio of seven. What lies beside the
  // first and the last interval is not known.
  return !(k > 0 && k < last && one * here > 0.0 && other * here > 0.0 && most <= 3.0 * std::abs(here));
}

bool Dips::grazes(const std::vector<Sample>& samples, std::size_t k) {
  if (k == 0 || k + 1 >= samples.size()) return false;
  const double before = samples[k - 1].g, here = samples[k].g, after = samples[k + 1].g;
  return before * after > 0.0 && std::abs(here) <= small * std::max(std::abs(before), std::abs(after));
}

Dips::Point Dips::point(double x, double g, double delta) {
  // The state at the end of a run is not quite that of the polynomial, from which the slope is taken.
  const double here = x == end_ && end_ < 1.0 ? on(x) : g;
  return {x, g, (on(x + delta) - here) / delta};
}

void Dips::look(const Sample& a, const Sample& b, std::vector<Sample>& more) {
  if (left_ <= 0) return;
  aside_ = std::clamp(1e3 * noise_ / std::max(std::abs(a.g), std::abs(b.g)), 1e-6, 1e-3);
  const double delta = aside_ * (b.part - a.part);
  std::vector<Sample> found;
  split(point(a.part, a.g, delta), point(b.part, b.g, -delta), 0, false, found);
  if (found.empty()) return;
  // Samples beside an end that have its sign say nothing. Of other neighbours with the same sign one is
  // enough, as a zero is looked for as far as the samples beside it.
  std::ranges::sort(found, {}, &Sample::part);
  const auto first = std::ranges::find_if(found, [&](const Sample& it) { return !(it.g * a.g > 0.0); });
  auto end = found.end();
  while (end != first && (end - 1)->g * b.g > 0.0)
    --end;
  const std::size_t before = more.size();
  for (auto it = first; it != end; ++it) {
    if (more.size() == before || !(more.back().g * it->g > 0.0))
      more.push_back(*it);
    else if (it->exact > more.back().exact ||
             (it->exact == more.back().exact && std::abs(it->g) > std::abs(more.back().g)))
      more.back() = *it;
  }
}

/// Looks for zeros where the function turns once between samples of one sign.
void Dips::look_low(const Sample& a, const Sample& b, std::vector<Sample>& more) {
  const double sign = std::copysign(1.0, a.g);
  const auto it = lowest([&](double x) { return sign * on(x); }, a.part, b.part, true);
  const double beside = std::max(std::abs(a.g), std::abs(b.g));
  if (it.f > small * beside) return;
  if (it.f < -small * beside)
    more.push_back({it.x, sign * it.f});
  else
    touch(a, b, {it.x, it.f}, sign, more);
}

void Dips::split(const Point& a, const Point& b, int depth, bool trusted, std::vector<Sample>& more) {
  // The cubic with these values and slopes. Its derivative is a parabola with the Bernstein coefficients
  // `first`, `middle` and `last`.
  const double width = b.x - a.x, first = width * a.slope, last = width * b.slope, rise = b.g - a.g,
               middle = 3.0 * rise - first - last;
  const double most = std::max(std::abs(first), std::abs(last)), sense = std::copysign(1.0, rise);
  const bool at_end = depth == deepest || left_ <= 0;
  const bool one_way = sense * first >= 0.0 && sense * last >= 0.0 && sense * middle >= 0.1 * most;
  // It is nearly straight: no point in the middle is needed.
  if (one_way && std::max(std::abs(first - rise), std::abs(last - rise)) <= 0.4 * std::abs(rise)) return;
  if (a.g * b.g > 0.0) {
    const double sign = std::copysign(1.0, a.g), low = std::min(sign * a.g, sign * b.g);
    const bool falls = sign * first<0.0, rises = sign * last> 0.0;
    // Where it bends the same way throughout, it lies above its tangents.
    const double turn = (last - rise) / (last - first);
    if (trusted && falls && rises && sign * first <= sign * middle && sign * middle <= sign * last &&
        sign * (a.g + turn * first) > 0.2 * low)
      return;
    if (falls && rises && (trusted || at_end)) return look_low({a.x, a.g}, {b.x, b.g}, more);
    if (low > std::max(most, std::abs(rise)) || (trusted && ((!falls && !rises) || one_way))) return;
  } else if (one_way && trusted) {
    return;
  }
  if (at_end) return;
  // Not in the middle, where a sample may have been taken before.
  constexpr double part = 0.4, rest = 1.0 - part;
  const double x = a.x + part * width;
  const Point there = point(x, on(x), aside_ * width);
  more.push_back({x, there.g});
  // Compare the cubic with the function.
  const double off = std::abs(there.g - a.g - part * part * (3.0 - 2.0 * part) * rise -
                              part * rest * (rest * first - part * last)),
               turned = std::abs(width * there.slope - rest * rest * first - 2.0 * part * rest * middle -
                                 part * part * last);
  const bool near = std::max(off, turned) <= 0.02 * std::max(most, std::abs(rise));
  split(a, there, depth + 1, near, more);
  split(there, b, depth + 1, near, more);
}

/// Looks for zeros near the lowest point, where the function is that of the polynomial plus a parabola
/// through its errors.
void Dips::touch(const Sample& a, const Sample& b, const Lowest& there, double sign,
                 std::vector<Sample>& more) {
  const double value = sign * exact_(there.x), error = value - there.f;
  if (value <= 0.0) more.push_back({there.x, sign * value, true});
  if (!(value > 0.0) || (there.f > 0.0 && std::abs(error) < 0.1 * value)) return;
  const double width = b.part - a.part, to = there.x < a.part + 0.5 * width ? 0.25 * width : -0.25 * width;
  const auto error_at = [&](double x) { return sign * (exact_(x) - on(x)); };
  const double one = (error_at(there.x + to) - error) / to,
               two = ((error_at(there.x + 2.0 * to) - error) / (2.0 * to) - one) / to;
  const auto corrected = [&](double x) {
    const double far = x - there.x;
    return sign * on(x) + error + far * (one + (far - to) * two);
  };
  const double low = std::max(a.part, there.x - 0.1 * width), high = std::min(b.part, there.x + 0.1 * width);
  const auto turn = lowest(corrected, low, high, false);
  const double lowest_value = sign * exact_(turn.x);
  if (lowest_value <= 0.0) more.push_back({turn.x, sign * lowest_value, true});
}

}  // namespace avi::detail
