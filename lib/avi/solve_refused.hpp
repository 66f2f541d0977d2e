#pragma once
#include "avi/solve.hpp"

#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

/// @file
/// Overloads of solve() and resume() for wrong arguments. Each stops the compiler with a sentence that says
/// what is wrong.

namespace avi {

/// @cond
namespace detail {
template <class T>
concept IsState = requires(const T& z) {
  []<int n>(const State<n>&) {}(z);
};
template <class H = void, class Start = void, class End = void, class Tolerance = void,
          class Options = SolveOptions, class... More>
struct SolveCall {
  static constexpr bool h_first = !IsState<H>, start = IsState<Start>,
                        end = std::disjunction_v<std::is_convertible<End, double>,
                                                 std::is_convertible<End, std::vector<double>>>,
                        tolerance = std::is_convertible_v<Tolerance, double>,
                        options = std::disjunction_v<std::is_same<Options, SolveOptions>,
                                                     std::is_convertible<Options, SolveOptions>> &&
                                  sizeof...(More) == 0,
                        right = h_first && start && end && tolerance && options;
};
struct StateInBraces {
  std::vector<double> q, p;
  double t = 0.0;
};
}  // namespace detail

template <class... Arguments>
requires(!detail::SolveCall<Arguments...>::right) Solution<dynamic> solve(const Arguments&...) {
  using Call = detail::SolveCall<Arguments...>;
  static_assert(Call::h_first, "H comes first, then the start: solve(H, start, t_end, tolerance).");
  static_assert(!Call::h_first || Call::start,
                "The start is a State, as avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}}.");
  static_assert(!Call::start || Call::end,
                "After the start comes the end, a number, or a std::vector<double> of times.");
  static_assert(!Call::end || !Call::start || Call::tolerance,
                "After the end comes the tolerance: solve(H, start, t_end, 1e-10).");
  static_assert(!Call::tolerance || !Call::end || !Call::start || Call::options,
                "After the tolerance come SolveOptions, such as {.dense = true}, or nothing.");
  return {};
}
template <class H, class... Rest>
Solution<dynamic> solve(const H&, const detail::StateInBraces&, const Rest&...) {
  static_assert(std::is_void_v<H>,
                "The start is a State, as avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}}.");
  return {};
}
template <class H, class... Rest>
Solution<dynamic> solve(const H&, std::initializer_list<double>, const Rest&...) {
  static_assert(std::is_void_v<H>,
                "The start is a State, as avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 1.0}}.");
  return {};
}
template <class H, int n, class End>
Solution<n> solve(const H&, const State<n>&, const End&, const SolveOptions&) {
  static_assert(std::is_void_v<H>, "After the end comes the tolerance: solve(H, start, t_end, 1e-10).");
  return {};
}
template <class H>
Solution<dynamic> resume(const H&, const std::string&, const SolveOptions& = {}) {
  static_assert(std::is_void_v<H>,
                "resume() is told the number of degrees of freedom: avi::resume<2>(H, file).");
  return {};
}
/// @endcond

}  // namespace avi
