#pragma once
#include "avi/autodiff/recorded.hpp"

#include <type_traits>
#include <vector>

/// @file
/// The call that records a function, with a clear message from the compiler where it cannot be made.

namespace avi::detail {

/// True for an argument type that holds plain numbers only: double, or a vector of doubles.
template <class Argument>
constexpr bool is_of_numbers() {
  using A = std::remove_cvref_t<Argument>;
  if constexpr (requires { typename A::Scalar; })
    return std::is_arithmetic_v<typename A::Scalar>;
  else
    return std::is_arithmetic_v<A>;
}
/// Whether a function type has such an argument.
template <class F>
struct TakesNumbers : std::false_type {};
/// @cond
#define AVI_CALLABLE(...)                                                                                    \
  template <class Result, class... Arguments>                                                                \
  struct TakesNumbers<Result __VA_ARGS__> : std::bool_constant<(is_of_numbers<Arguments>() || ...)> {};      \
  template <class Result, class... Arguments>                                                                \
  struct TakesNumbers<Result __VA_ARGS__ noexcept>                                                           \
      : std::bool_constant<(is_of_numbers<Arguments>() || ...)> {};
AVI_CALLABLE((*)(Arguments...))
#undef AVI_CALLABLE
#define AVI_CALLABLE(qualifier)                                                                              \
  template <class Result, class Class, class... Arguments>                                                   \
  struct TakesNumbers<Result (Class::*)(Arguments...) qualifier>                                             \
      : std::bool_constant<(is_of_numbers<Arguments>() || ...)> {};
AVI_CALLABLE()
AVI_CALLABLE(const)
AVI_CALLABLE(noexcept)
AVI_CALLABLE(const noexcept)
#undef AVI_CALLABLE
/// @endcond

/// True where f is not generic but takes vectors of plain numbers. This cannot be tested by a call, because
/// Eigen claims to convert any vector type into any other.
template <class F>
constexpr bool takes_numbers() {
  if constexpr (requires { &F::operator(); })
    return TakesNumbers<decltype(&F::operator())>::value;
  else
    return TakesNumbers<std::decay_t<F>>::value;
}

/// Calls f with recorded vectors. The requirements on f are checked here, with one message for each mistake.
template <class F, class... Vectors>
Recorded recorded_call(const F& f, const Vectors&... x) {
  constexpr bool generic = !takes_numbers<F>();
  static_assert(generic,
                "A function that is recorded must be generic in its scalar: let it take `const auto& q` "
                "(and `const auto& p`) instead of vectors of double.");
  if constexpr (generic) {
    constexpr bool callable = std::is_invocable_v<const F&, const Vectors&...>;
    if constexpr (!callable && sizeof...(x) == 2) {
      using Vec = std::common_type_t<Vectors...>;
      static_assert(callable || !(std::is_invocable_v<const F&, const Vec&, const Recorded&, const Vec&> ||
                                  std::is_invocable_v<const F&, const Vec&, const Vec&, const Recorded&>),
                    "This function takes a third argument: H(q, t, p) becomes a function of (q, p) by "
                    "avi::time_dependent(), and parameters are captured or kept as members.");
    }
    static_assert(callable,
                  "A function that is recorded must be callable as f(x), or H(q, p), with vectors of "
                  "any scalar, and be const.");
    if constexpr (callable) {
      constexpr bool gives_number =
          std::is_convertible_v<std::invoke_result_t<const F&, const Vectors&...>, Recorded>;
      static_assert(gives_number,
                    "A function that is recorded must return one number of its arguments' scalar, "
                    "as `return x[0] * x[0];` does.");
      if constexpr (gives_number) return f(x...);
    }
  }
}

/// Nodes of the gradient that H supplies, first by q, then by p. @throws std::invalid_argument for a gradient
/// of another size.
template <class H, class Vec>
std::vector<int> supplied_gradient(const H& h, const Vec& q, const Vec& p, ExpressionGraph& graph) {
  using Slopes = Vector<Recorded, Vec::SizeAtCompileTime>;
  const Slopes by_q = sized("Number of entries of d_dq", h.d_dq(q, p), q.size()),
               by_p = sized("Number of entries of d_dp", h.d_dp(q, p), q.size());
  std::vector<int> nodes;
  for (const Slopes* slopes : {&by_q, &by_p})
    for (const Recorded& slope : *slopes)
      nodes.push_back(slope.node_in(graph));
  return nodes;
}

}  // namespace avi::detail
