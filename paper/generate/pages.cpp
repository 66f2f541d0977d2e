#include "generate/pages.hpp"

#include "generate/numbers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <regex>
#include <stdexcept>

namespace paper {
namespace {

const std::regex& marked() {
  static const std::regex number(R"((<!--= ([\w.]+) -->)([^<]*)(<!--/-->))");
  return number;
}

}  // namespace

std::string plain_number(double value, std::string_view format) {
  if (format == "int") return fmt::format("{:.0f}", value);
  if (format == "pct") return fmt::format("{:.0f} %", 100.0 * value);
  int digits = -1;
  const auto parsed = std::from_chars(format.data() + 1, format.data() + format.size(), digits);
  if (format.size() < 2 || parsed.ptr != format.data() + format.size() || digits < 0 ||
      (format[0] != 'f' && format[0] != 'g'))
    throw std::invalid_argument(fmt::format("Number format '{}' is none of int, pct, f<n>, g<n>.", format));
  if (format[0] == 'f') return fmt::format("{:.{}f}", value, digits);
  if (value != 0.0 && (std::abs(value) < 1e-3 || std::abs(value) >= 1e6))
    return std::regex_replace(fmt::format("{:.{}e}", value, digits - 1), std::regex("e([+-])0?(\\d)"),
                              value < 1.0 ? "e$1$2" : "e$2");
  // Rounded first, so that 0.0996 with two digits is 0.10.
  const double rounded = std::stod(fmt::format("{:.{}e}", value, digits - 1));
  const int before = rounded == 0.0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(rounded)))) + 1;
  return fmt::format("{:.{}f}", rounded, std::max(0, digits - before));
}

std::map<std::string, std::string> numbers_on(const std::string& page) {
  std::map<std::string, std::string> numbers;
  for (std::sregex_iterator i(page.begin(), page.end(), marked()), end; i != end; ++i)
    numbers[(*i)[2]] = (*i)[3];
  return numbers;
}

std::string with_numbers(const std::string& page, const std::map<std::string, std::string>& texts) {
  std::string out;
  auto rest = page.begin();
  for (std::sregex_iterator i(page.begin(), page.end(), marked()), end; i != end; ++i) {
    const auto found = texts.find((*i)[2]);
    out.append(rest, page.begin() + i->position());
    out += i->str(1) + (found == texts.end() ? i->str(3) : found->second) + i->str(4);
    rest = page.begin() + i->position() + i->length();
  }
  return out.append(rest, page.end());
}

std::map<std::string, std::string> plain_numbers(const scorecard::Results& data,
                                                 const experiment::Table& list) {
  std::map<std::string, std::string> texts;
  for (const auto& row : scorecard::rows(list)) {
    double value = 0.0;
    try {
      value = evaluate(data, row.text("formula"));
    } catch (const std::runtime_error&) {
      continue;  // that experiment has not run
    }
    texts[row.text("name")] = plain_number(value, row.text("format"));
  }
  return texts;
}

}  // namespace paper
