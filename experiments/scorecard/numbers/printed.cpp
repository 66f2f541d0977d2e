#include "scorecard/numbers/printed.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace scorecard {
namespace {

struct Digits {
  std::string_view mantissa;
  int decimals = 0, exponent = 0;
  bool scientific = false, bound = false;
};

int to_int(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  int value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Digits digits(std::string_view text) {
  Digits d;
  d.bound = text.starts_with('>');
  if (d.bound) text.remove_prefix(1);
  const auto e = text.find_first_of("eE");
  d.mantissa = text.substr(0, e);
  d.scientific = e != std::string_view::npos;
  if (d.scientific) d.exponent = to_int(text.substr(e + 1));
  const auto point = d.mantissa.find('.');
  if (point != std::string_view::npos) d.decimals = static_cast<int>(d.mantissa.size() - point - 1);
  return d;
}

}  // namespace

Printed::Printed(std::string_view text) {
  const Digits d = digits(text);
  const std::string_view number = d.bound ? text.substr(1) : text;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc{} || end != number.data() + number.size())
    throw std::invalid_argument(fmt::format("Published value '{}' is no number.", text));
  unit = std::pow(10.0, d.exponent - d.decimals);
  bound = d.bound;
}

bool Printed::equals(double ours) const {
  if (!std::isfinite(ours)) return false;
  if (bound) return ours > value;
  // Half a unit, and one part in 10^9 of it for the decimal fractions that binary numbers only approach.
  return units_off(ours) <= 0.5 * (1.0 + 1e-9);
}

double Printed::units_off(double ours) const { return std::abs(ours - value) / unit; }

std::string beside(std::string_view printed, double ours) {
  const Digits d = digits(printed);
  if (!std::isfinite(ours)) return "nan";
  if (d.scientific) return fmt::format("{:.{}E}", ours, d.decimals + 2);
  if (ours == std::round(ours) && d.decimals == 0) return fmt::format("{:.0f}", ours);
  return fmt::format("{:.{}f}", ours, d.decimals + 2);
}

}  // namespace scorecard
