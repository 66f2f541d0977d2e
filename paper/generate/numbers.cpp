#include "generate/numbers.hpp"

#include "generate/latex.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace paper {
namespace {

[[noreturn]] void refuse(std::string_view what, std::string_view term) {
  throw std::invalid_argument(fmt::format("{} in '{}'.", what, term));
}

std::optional<double> plain_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// column=cell, or column<number.
struct Condition {
  std::string column, cell;
  bool below = false;
  [[nodiscard]] bool holds(const experiment::Table& table, std::size_t row) const {
    if (!below) return scorecard::same(table.text(row, column), cell);
    return table.number(row, column) < plain_number(cell).value_or(std::nan(""));
  }
};

struct Reference {
  std::string aggregate, stem, column;
  std::vector<Condition> where;
};

Reference parse(std::string_view term) {
  Reference ref;
  std::string_view rest = term;
  for (const char* aggregate : {"max", "min", "sum", "count"})
    if (rest.starts_with(std::string(aggregate) + ":")) {
      ref.aggregate = aggregate;
      rest.remove_prefix(ref.aggregate.size() + 1);
    }
  const auto open = rest.find('['), close = rest.rfind(']');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open)
    refuse("There is no [...]", term);
  ref.stem = rest.substr(0, open);
  std::string_view conditions = rest.substr(open + 1, close - open - 1);
  while (!conditions.empty()) {
    const auto comma = std::min(conditions.find(','), conditions.size());
    const std::string_view condition = conditions.substr(0, comma);
    const auto sign = condition.find_first_of("=<");
    if (sign == std::string_view::npos) refuse("A condition has neither = nor <", term);
    ref.where.push_back({std::string(condition.substr(0, sign)), std::string(condition.substr(sign + 1)),
                         condition[sign] == '<'});
    conditions.remove_prefix(std::min(comma + 1, conditions.size()));
  }
  rest.remove_prefix(close + 1);
  if (ref.aggregate == "count") {
    if (!rest.empty()) refuse("count: takes no column", term);
  } else if (!rest.starts_with('.') || rest.size() < 2) {
    refuse("There is no column", term);
  } else {
    ref.column = rest.substr(1);
  }
  return ref;
}

double value_of(const scorecard::Results& data, std::string_view term) {
  if (const auto number = plain_number(term)) return *number;
  const Reference ref = parse(term);
  const experiment::Table& table = data(ref.stem);
  double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (!std::ranges::all_of(ref.where, [&](const Condition& c) { return c.holds(table, i); })) continue;
    ++count;
    if (ref.column.empty()) continue;
    const auto sign = ref.column.find_first_of(":-");
    double value = table.number(i, ref.column.substr(0, sign));
    if (sign != std::string::npos) {
      const double second = table.number(i, ref.column.substr(sign + 1));
      value = ref.column[sign] == ':' ? value / second : value - second;
    }
    if (ref.aggregate.empty()) return value;
    if (std::isnan(value)) continue;
    least = std::min(least, value), most = std::max(most, value), sum += value;
  }
  if (ref.aggregate == "count") return count;
  if (ref.aggregate.empty() || most < least)
    throw std::out_of_range(fmt::format("The data have no row for '{}'.", term));
  return ref.aggregate == "max" ? most : ref.aggregate == "min" ? least : sum;
}

/// Splits at spaces outside brackets.
std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> found(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '[') - (c == ']');
    if (c == ' ' && depth == 0)
      found.emplace_back();
    else
      found.back() += c;
  }
  return found;
}

}  // namespace

double evaluate(const scorecard::Results& data, std::string_view formula) {
  const auto terms = words(formula);
  if (terms.size() % 2 == 0) refuse("An operator has no second term", formula);
  double result = value_of(data, terms[0]);
  for (std::size_t i = 1; i < terms.size(); i += 2) {
    const double next = value_of(data, terms[i + 1]);
    if (terms[i] == "/")
      result /= next;
    else if (terms[i] == "*")
      result *= next;
    else if (terms[i] == "+")
      result += next;
    else if (terms[i] == "-")
      result -= next;
    else
      refuse("Unknown operator", formula);
  }
  return result;
}

std::string numbers_tex(const scorecard::Results& data, const experiment::Table& list) {
  std::string out = "% Made by paper_numbers from build/data and paper/numbers.tsv.\n";
  for (std::size_t i = 0; i < list.rows.size(); ++i) {
    const std::string &name = list.text(i, "name"), &formula = list.text(i, "formula");
    std::string text;
    if (formula.starts_with("head:")) {
      const auto colon = formula.find(':', 5);
      for (const auto& [key, value] : data(formula.substr(5, colon - 5)).head)
        if (key == formula.substr(colon + 1)) text = escaped(value);
      if (text.empty()) throw std::out_of_range(fmt::format("The data have no head for '{}'.", formula));
    } else {
      text = latex_number(evaluate(data, formula), list.text(i, "format"));
    }
    out += fmt::format("\\defval{{{}}}{{{}}}\n", name, text);
  }
  return out;
}

}  // namespace paper
