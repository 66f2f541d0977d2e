#include "generate/numbers.hpp"

#include "generate/latex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <regex>
#include <stdexcept>

namespace paper {
namespace {

[[noreturn]] void refuse(std::string_view what, std::string_view term) {
  throw std::invalid_argument(fmt::format("{} in '{}'.", what, term));
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const auto end = std::min(text.find(at), text.size());
    parts.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

double value_of(const scorecard::Results& data, std::string_view term) {
  if (const auto number = experiment::number_in(term)) return *number;
  const auto aggregate_end = term.find(':'), close = term.rfind(']');
  const bool aggregated = aggregate_end < term.find('[');
  if (close == std::string_view::npos) refuse("There is no [...]", term);
  const std::string_view aggregate = aggregated ? term.substr(0, aggregate_end) : "";
  const std::size_t begin = aggregated ? aggregate_end + 1 : 0;
  const auto rows = selected(data, term.substr(begin, close + 1 - begin));
  std::string_view wanted = term.substr(close + 1);
  if (aggregate == "count" || aggregate == "place") {
    if (!wanted.empty()) refuse(fmt::format("{}: takes no column", aggregate), term);
    if (aggregate == "count") return static_cast<double>(rows.size());
    if (rows.empty()) throw std::out_of_range(fmt::format("The data have no row for '{}'.", term));
    return static_cast<double>(rows.front().line() + 1);
  }
  if (!wanted.starts_with('.') || wanted.size() < 2) refuse("There is no column", term);
  wanted.remove_prefix(1);
  const auto value_in = [&](const scorecard::Row& row) {
    const auto sign = wanted.find_first_of(":-");
    const double value = row.number(wanted.substr(0, sign));
    if (sign == std::string_view::npos) return value;
    const double second = row.number(wanted.substr(sign + 1));
    return wanted[sign] == ':' ? value / second : value - second;
  };
  std::vector<double> values;
  for (const auto& row : rows)
    if (const double value = value_in(row); !aggregated || !std::isnan(value)) values.push_back(value);
  if (values.empty()) throw std::out_of_range(fmt::format("The data have no row for '{}'.", term));
  if (!aggregated) return values.front();
  if (aggregate == "max") return std::ranges::max(values);
  if (aggregate == "min") return std::ranges::min(values);
  if (aggregate == "sum") return std::accumulate(values.begin(), values.end(), 0.0);
  if (aggregate == "median") {
    std::ranges::sort(values);
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
  }
  refuse("There is none of max:, min:, sum:, median:, count: and place:", term);
}

}  // namespace

std::vector<scorecard::Row> selected(const scorecard::Results& data, std::string_view text) {
  const auto open = text.find('[');
  if (open == std::string_view::npos || !text.ends_with(']')) refuse("There is no [...]", text);
  auto rows = data.rows(std::string(text.substr(0, open)));
  for (const auto condition : split(text.substr(open + 1, text.size() - open - 2), ',')) {
    const auto sign = condition.find_first_of("=<");
    if (sign == std::string_view::npos) refuse("A condition has neither = nor <", text);
    const auto column = condition.substr(0, sign), wanted = condition.substr(sign + 1);
    std::erase_if(rows, [&](const scorecard::Row& row) {
      if (condition[sign] == '<')
        return !(row.number(column) < experiment::number_in(wanted).value_or(std::nan("")));
      return std::ranges::none_of(split(wanted, '|'),
                                  [&](auto cell) { return scorecard::same(row.text(column), cell); });
    });
  }
  return rows;
}

double evaluate(const scorecard::Results& data, std::string_view formula) {
  static const std::regex term(R"(([^ \[]|\[[^\]]*\])+)");  // between spaces outside brackets
  const std::string text(formula);
  std::vector<std::string> terms;
  for (std::sregex_iterator match(text.begin(), text.end(), term); match != std::sregex_iterator(); ++match)
    terms.push_back(match->str());
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

void check_senses(const scorecard::Results& data, const experiment::Table& list,
                  const experiment::Table& senses) {
  for (const auto& sense : scorecard::rows(senses)) {
    const auto number = scorecard::find(list, {{"name", sense.text("name")}});
    const double value = evaluate(data, number.text("formula"));
    if (!(value > sense.number("least") && value < sense.number("most")))
      throw std::runtime_error(fmt::format(
          "The data give {} = {:.4g}, but the text says \"{}\": it has to be between {} and {}.",
          sense.text("name"), value, sense.text("sentence"), sense.text("least"), sense.text("most")));
  }
}

void refuse_drift(const experiment::Table& advice) {
  for (const auto& row : scorecard::rows(advice))
    if (row.number("drift") > 0.05)
      throw std::runtime_error(fmt::format(
          "The unit of time moved by {:.0f} % while {} (e = {}, {}) was measured: its costs are refused. "
          "Remove "
          "build/data/work_precision.tsv and run `make build/data/work_precision.tsv` on a quiet machine.",
          100.0 * row.number("drift"), row.text("problem"), row.text("eccentricity"), row.text("horizon")));
}

std::string numbers_tex(const scorecard::Results& data, const experiment::Table& list) {
  std::string out = "% Made by paper_numbers from build/data and paper/numbers.tsv.\n";
  for (const auto& row : scorecard::rows(list)) {
    const std::string& formula = row.text("formula");
    std::string text;
    if (formula.starts_with("head:")) {
      const auto colon = formula.find(':', 5);
      for (const auto& [key, value] : data(formula.substr(5, colon - 5)).head)
        if (key == formula.substr(colon + 1)) text = escaped(value);
      if (text.empty()) throw std::out_of_range(fmt::format("The data have no head for '{}'.", formula));
    } else {
      text = latex_number(evaluate(data, formula), row.text("format"));
    }
    out += fmt::format("\\defval{{{}}}{{{}}}\n", row.text("name"), text);
  }
  return out;
}

}  // namespace paper
