#include "scorecard/numbers/printed.hpp"

#include "common/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace scorecard {

Printed::Printed(std::string_view text) : bound(text.starts_with('>')) {
  const std::string_view number = text.substr(bound ? 1 : 0);
  const auto whole = experiment::number_in(number);
  if (!whole) throw std::invalid_argument(fmt::format("Published value '{}' is no number.", text));
  value = *whole;
  const auto e = number.find_first_of("eE");
  scientific = e != std::string_view::npos;
  const std::string_view mantissa = number.substr(0, e);
  if (const auto point = mantissa.find('.'); point != std::string_view::npos)
    decimals = static_cast<int>(mantissa.size() - point) - 1;
  unit = std::pow(10.0, (scientific ? std::stoi(std::string(number.substr(e + 1))) : 0) - decimals);
}

bool Printed::equals(double ours) const {
  if (!std::isfinite(ours)) return false;
  if (bound) return ours > value;
  // Half a unit, and one part in 10^9 of it for the decimal fractions that binary numbers only approach.
  return units_off(ours) <= 0.5 * (1.0 + 1e-9);
}

double Printed::units_off(double ours) const { return std::abs(ours - value) / unit; }

std::string beside(std::string_view printed, double ours) {
  const Printed p(printed);
  if (!std::isfinite(ours)) return "nan";
  if (!p.scientific && p.decimals == 0 && ours == std::round(ours)) return fmt::format("{:.0f}", ours);
  // Two digits more than printed; more where these stand half way between two printed numbers.
  const auto with = [&](int more) {
    return p.scientific ? fmt::format("{:.{}E}", ours, p.decimals + more)
                        : fmt::format("{:.{}f}", ours, p.decimals + more);
  };
  for (int more = 2; more <= 6; ++more) {
    const double shown = std::abs(*experiment::number_in(with(more))) / p.unit;
    if (std::abs(shown - std::floor(shown) - 0.5) > 1e-6) return with(more);
  }
  return with(2);
}

}  // namespace scorecard
