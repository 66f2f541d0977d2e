#include "generate/latex.hpp"

#include "common/table.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>
#include <utility>

namespace paper {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Mantissa and exponent as siunitx reads them.
std::string power(const std::string& mantissa, int exponent) {
  return exponent == 0 ? fmt::format("\\num{{{}}}", mantissa)
                       : fmt::format("\\num{{{}e{}}}", mantissa, exponent);
}

std::string scientific(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const auto e = text.find('e');
  return power(text.substr(0, e), std::stoi(text.substr(e + 1)));
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out = replaced(std::string(text), "\\", "\\textbackslash{}");
  for (const char* special : {"_", "%", "&", "#", "$", "{", "}"})
    out = replaced(out, special, std::string("\\") + special);
  return out;
}

std::string latex(std::string_view text) {
  // What is mathematics already stands aside as a mark, \x01, its number in \x02s, \x03, until all is found.
  std::vector<std::string> mathematics;
  std::string out(text);
  const auto set_aside = [&](const std::regex& pattern, auto&& written) {
    std::string kept;
    for (std::smatch match; std::regex_search(out, match, pattern); out = match.suffix()) {
      kept += match.prefix().str() + "\x01" + std::string(mathematics.size(), '\x02') + "\x03";
      mathematics.push_back(written(match));
    }
    out = kept + out;
  };
  static const std::vector<std::pair<std::regex, std::string>> formulas = [] {
    std::vector<std::pair<std::regex, std::string>> list;
    static const std::regex special(R"([.^$|()*+?\[\]{}\\])");
    for (const auto& [plain, tex] : std::initializer_list<std::pair<const char*, const char*>>{
             {"|p^t + H|^-1", "|p^t+H|^{-1}"},
             {"|L|^-1", "|L|^{-1}"},
             {"p~0 - p0", "\\tilde p_0-p_0"},
             {"q~0 - q0", "\\tilde q_0-q_0"},
             {"q~1 - q1", "\\tilde q_1-q_1"},
             {"p^t", "p^t"},
             {"r^t", "r^t"},
             {"q.q", "q^\\top q"},
             {"|grad V| = 1/|q|^2", "|\\nabla V|=1/|q|^2"},
             {"|q|^2", "|q|^2"},
             {"O(t^-p)", "O(t^{-p})"},
             {"P = p^2/p_ring", "P=p^2/\\mathring p"},
             {"p^2/p_ring", "p^2/\\mathring p"},
             {"10^(2/3)", "10^{2/3}"},
             {"f - f*", "f-f^*"},
             {"min(r + 1, s)", "\\min(r+1,s)"},
             {"(q, p)", "(q,p)"},
             {"(q, r)", "(q,r)"},
             {"tol / h", "\\mathit{tol}/h"},
             {"a h and b h", "ah$ and $bh"},
             {"a h", "ah"},
             {"N - 1", "N-1"},
             {"N h", "Nh"},
             {"x - 1", "x-1"}}) {
      const auto edge = [](unsigned char c) { return std::isalnum(c) ? R"(\b)" : ""; };
      list.emplace_back(std::regex(edge(plain[0]) + std::regex_replace(plain, special, R"(\$&)") +
                                   edge(plain[std::string_view(plain).size() - 1])),
                        tex);
    }
    return list;
  }();
  static const std::regex code("`([^`]*)`");
  set_aside(code, [](const std::smatch& m) { return "\\texttt{" + escaped(m[1].str()) + "}"; });
  for (const auto& [pattern, tex] : formulas)
    set_aside(pattern, [&tex = tex](const std::smatch&) { return "$" + tex + "$"; });
  const auto symbol = [](const std::string& name) {
    return name == "p_ring" ? "\\mathring p" : name.size() > 2 ? "\\" + name : name;
  };
  const auto number = [](const std::string& mantissa, const std::string& exponent) {
    return power(mantissa, exponent.empty() ? 0 : std::stoi(exponent));
  };
  static const std::regex value(
      R"(\b(p_ring|delta|gamma|[A-Za-z]) ?= ?(-?\d+(?:\.\d+)?)(?:[eE]([-+]?\d+))?)"),
      written(R"((>?)(\d+(?:\.\d+)?)[eE]([-+]?\d+))"), grouped(R"((^|[^.\d])(\d{5,})(?!\d|\.\d))"),
      negative(R"((^|[ (])(-\d+(?:\.\d+)?))"), raised(R"(\b([A-Za-z])\^(-?\d+(?:\.\d+)?))"),
      letter(R"(\b(p_ring|delta|[CNPefghpqrxy])\b)");
  set_aside(value, [&](const auto& m) { return "$" + symbol(m[1]) + "=" + number(m[2], m[3]) + "$"; });
  set_aside(written, [&](const auto& m) { return (m[1].length() ? "$>$" : "") + number(m[2], m[3]); });
  set_aside(negative, [&](const auto& m) { return m[1].str() + number(m[2], ""); });
  set_aside(grouped, [&](const auto& m) { return m[1].str() + number(m[2], ""); });
  set_aside(raised, [&](const auto& m) { return "$" + m[1].str() + "^{" + m[2].str() + "}$"; });
  set_aside(letter, [&](const auto& m) { return "$" + symbol(m[1]) + "$"; });
  out = escaped(out);
  for (const auto& [from, to] :
       std::initializer_list<std::pair<const char*, const char*>>{{"Stormer-Verlet", "St\\\"ormer--Verlet"},
                                                                  {"Runge-Kutta", "Runge--Kutta"},
                                                                  {"Dormand-Prince", "Dormand--Prince"},
                                                                  {"Bogacki-Shampine", "Bogacki--Shampine"},
                                                                  {"^", "\\textasciicircum{}"},
                                                                  {"<", "$<$"},
                                                                  {">", "$>$"},
                                                                  {"|", "$|$"}})
    out = replaced(out, from, to);
  for (std::size_t i = mathematics.size(); i-- > 0;)
    out = replaced(out, "\x01" + std::string(i, '\x02') + "\x03", mathematics[i]);
  return out;
}

std::string latex_number(double value, std::string_view format) {
  if (std::isnan(value)) return "--";
  if (format == "plain") return fmt::format("\\num{{{}}}", experiment::rounded(value));
  if (format == "int") return fmt::format("\\num{{{:.0f}}}", value);
  if (format == "pct") return fmt::format("\\SI{{{:.1f}}}{{\\percent}}", 100.0 * value);
  int digits = -1;
  const auto parsed = std::from_chars(format.data() + 1, format.data() + format.size(), digits);
  if (parsed.ptr != format.data() + format.size() || digits < 0 ||
      (format[0] != 'f' && format[0] != 'g' && format[0] != 'r'))
    throw std::invalid_argument(
        fmt::format("Number format '{}' is none of int, plain, pct, f<n>, g<n>, r<n>.", format));
  if (format[0] == 'f') return fmt::format("\\num{{{:.{}f}}}", value, digits);
  if (format[0] == 'r')
    return fmt::format("\\num{{{:.0f}}}", std::stod(fmt::format("{:.{}e}", value, digits - 1)));
  if (value != 0.0 && (std::abs(value) < 1e-3 || std::abs(value) >= 1e7)) return scientific(value, digits);
  const int before = value == 0.0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  return fmt::format("\\num{{{:.{}f}}}", value, std::max(0, digits - before));
}

std::string latex_printed(std::string_view printed) {
  const bool bound = printed.starts_with('>');
  if (bound) printed.remove_prefix(1);
  const auto e = printed.find_first_of("eE");
  const std::string mantissa(printed.substr(0, e));
  const int exponent = e == std::string_view::npos ? 0 : std::stoi(std::string(printed.substr(e + 1)));
  return (bound ? "${>}$" : "") + power(mantissa, exponent);
}

std::string display_name(std::string_view name) {
  static const std::map<std::string_view, const char*> names{
      {"HTVI4 none", "HTVI4, none"},
      {"SV", "St\\\"ormer--Verlet"},
      {"stormer_verlet", "St\\\"ormer--Verlet"},
      {"authors", "recovered"},
      {"simpson", "Simpson"},
      {"gauss2", "Gauss, 2"},
      {"gauss4", "Gauss, 4"},
      {"norm_squared", "$q^\\top q$"},
      {"truncation", "truncation error"},
      {"truncation_root", "truncation error, 4th root"},
      {"clone_strang", "cloning, Strang"},
      {"clone_y4", "cloning, Yoshida 4"},
      {"clone_y6", "cloning, Yoshida 6"},
      {"direct", "Direct"},
      {"adaptive", "Adaptive"},
      {"runge_kutta_4", "Runge--Kutta 4"},
      {"dormand_prince", "Dormand--Prince 5(4)"},
      {"bogacki_shampine", "Bogacki--Shampine 3(2)"},
      {"gsl_rk8pd", "GSL rk8pd"},
      {"kepler", "Kepler"},
      {"perturbed_kepler", "quadrupole"},
      {"henon_heiles", "H\\'enon--Heiles"},
      {"collocation4", "collocation 4"},
      {"collocation8", "collocation 8"},
      {"collocation12", "collocation 12"},
      {"collocation16", "collocation 16"},
      {"log_hamiltonian_suzuki4", "LogH Suzuki 4"},
      {"log_hamiltonian_kahan_li6", "LogH KL 6"},
      {"log_hamiltonian_kahan_li8", "LogH KL 8"},
      {"log_hamiltonian_sofroniou_spaletta10", "LogH SS 10"},
      {"verlet_sofroniou_spaletta10", "Verlet SS 10"},
      {"blanes_moan6_nystrom", "RKN BM 6"},
      {"odeint_fehlberg78", "odeint RKF 7(8)"},
      {"odeint_bulirsch_stoer", "odeint BS"},
      {"odeint_dopri5", "odeint DP 5(4)"},
      {"type_2", "Type II"},
      {"type_3", "Type III, proximal"},
      {"binding", "bound copies"},
      {"nag_limit", "NAG, distance to its limit"},
      {"mirror", "mirror map"},
      {"omega", "$\\omega$"},
      {"h", "$h$"},
      {"minimise_m0", "minimise, $m=0$"},
      {"minimise_m7", "minimise, $m=7$"},
      {"lbfgs", "L-BFGS(10), liblbfgs"},
      {"cg_hz", "CG, Hager--Zhang"},
      {"gsl_bfgs2", "GSL bfgs2"},
      {"barzilai_borwein", "Barzilai--Borwein"},
      {"nag_restart", "NAG with restart"},
      {"bregman_restarted", "$p/t$ clock with restart"},
      {"bregman_htvi", "HTVI $(4,1)$, best of 6 steps"},
      {"rmsprop_best", "RMSprop, best of 6 rates"},
      {"gamma_three_quarters", "$\\gamma=3/4$"},
      {"inverse_lagrangian", "inverse Lagrangian"},
      {"kepler_gamma", "Kepler, $g=|q|^2$"},
      {"kepler_gamma_075", "Kepler, $g=|q|^{3/2}$"},
      {"kepler_energy", "Kepler, energy monitor"},
      {"driven_pendulum", "driven pendulum, $g(p)$"},
      {"relativistic", "$\\sqrt{1+p^2}-\\cos q$"},
      {"non_separable", "bead of varying inertia"},
      {"star_cluster", "seven bodies"},
      {"chain64", "chain of 64"},
      {"solar_system", "outer planets"},
      {"nan", "--"}};
  if (const auto known = names.find(name); known != names.end()) return known->second;
  if (name.starts_with("htvi")) return "HTVI" + std::string(name.substr(4));
  return latex(replaced(std::string(name), "_", " "));
}

std::string latex_cell(const std::string& cell, std::string_view format) {
  if (format == "text") return display_name(cell);
  if (format == "raw") return latex(cell);
  if (format == "yes") return cell == "1" ? "yes" : "no";
  const auto value = experiment::number_in(cell);
  return value ? latex_number(*value, format) : display_name(cell);
}

}  // namespace paper
