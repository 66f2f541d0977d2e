#pragma once
#include "avi/collocation/gauss_step.hpp"
#include "avi/core/require.hpp"

#include <memory>
#include <type_traits>
#include <variant>

/// @file
/// Gauss collocation of a Poincare-transformed Hamiltonian.

namespace avi {

/// s-stage Gauss collocation of Hamilton's equations of \f$\bar H\f$ in fictive time. It has order 2s and is
/// symplectic and symmetric for any H and any monitor; see \ref gauss_collocation. With \f$z = (q, p)\f$ and
/// the field f of \f$\bar H\f$, \f[ z_i = z_0 + h \sum_j a_{ij} f(z_j), \qquad z(h) = z_0 + h \sum_j b_j
/// f(z_j), \qquad t(h) = t_0 + h \sum_j b_j\, g(z_j). \f] It is the Galerkin Hamiltonian variational
/// integrator of Leok and Zhang (2011): HTVI evaluates the action on a Taylor curve, collocation on the
/// polynomial that makes the action stationary.
///
/// All stages are evaluated at once, one in each lane of a Pack. They are found by fixed-point sweeps down to
/// round-off, starting from the polynomial of the last step. A sweep computes new momenta first and uses them
/// for the positions (as IRKGaussLegendre does; Antonana, Makazaga and Murua 2017). Steps are summed with
/// about twice the digits of a double, as long as each begins where the last one ended.
/// @tparam largest_order from 2 to 32: higher orders are neither allowed nor compiled
template <class Problem, int largest_order = 16>
class Collocation {
  static_assert(largest_order >= 2 && largest_order <= 2 * GaussRule::most,
                "The largest order of collocation is from 2 to 32.");

 public:
  static constexpr int n = Problem::dimension;  ///< Dimension of the problem, or avi::dynamic.
  static constexpr bool symplectic = true;      ///< For every h.
  static constexpr bool symmetric = true;       ///< A step -h undoes a step h.

  /// Builds the method; collocation() deduces the types.
  /// @throws std::invalid_argument for an order that is odd or out of [2, largest_order], or an improper
  /// setting.
  Collocation(const Problem& problem, int order, SweepSettings settings = {})
      : problem_(problem), order_(order), steps_(make(problem, order, settings)) {}
  Collocation(const Collocation&) = default;  ///< Also used for a move, so the source can still step.
  Collocation& operator=(const Collocation&) = default;  ///< Likewise.

  /// Advances z by the fictive step h, which may be negative or 0. Unless the step ends as ok, z is
  /// unchanged. The report counts evaluations of the field at all stages: those of the sweeps, and one that
  /// ends the step.
  /// @throws std::invalid_argument where n is avi::dynamic and z has another size.
  StepReport step(State<n>& z, double h) {
    if constexpr (n == dynamic) {
      const Eigen::Index size = problem_.size(), other = z.q.size() != size ? z.q.size() : z.p.size();
      require(other == size, "Dimension of the state", other, "that of the problem, ", size,
              ", for q and p alike");
    }
    if (h == 0.0) return {.evaluations = 0};  // the next step still continues from the last one
    return with(steps_, [&](auto& steps) { return steps.step(z, h); });
  }

  [[nodiscard]] int order() const { return order_; }  ///< 2s.
  /// The problem that is integrated.
  [[nodiscard]] const Problem& problem() const { return problem_; }

  /// The collocation polynomial of the last step at the fraction c in [0, 1]. It has degree s, with error
  /// O(h^(s+1)) inside the step and O(h^(2s+1)) at its ends.
  [[nodiscard]] State<n> polynomial(double c, double) const {
    return with(steps_, [&](const auto& steps) { return steps.polynomial(c); });
  }

  /// How well the last step is resolved, for each entry: \f$|\sum_j P_{s-1}(2c_j - 1)\, L_j|\f$ with the
  /// increments \f$L_j = h b_j f_j\f$ and Legendre polynomials P. The last term of the collocation polynomial
  /// is this number times \f$\pm\frac12 (P_s - P_{s-2})(2c - 1)\f$ at the fraction c (times c where s = 1),
  /// so nowhere in the step is that term larger. Zero before the first step. Allocates no memory.
  /// @param q,p the n numbers of each are written here
  void tail(double* q, double* p) const {
    with(steps_, [&](const auto& steps) { steps.tail(q, p); });
  }

 private:
  // The narrowest pack that holds all stages is the fastest: 4 lanes are 1.6 times as fast as 8.
  using AnySteps = std::conditional_t<
      largest_order <= 8, std::variant<GaussStep<n, 4>>,
      std::conditional_t<largest_order <= 16, std::variant<GaussStep<n, 4>, GaussStep<n, 8>>,
                         std::variant<GaussStep<n, 4>, GaussStep<n, 8>, GaussStep<n, 16>>>>;
  static AnySteps make(const Problem& problem, int order, SweepSettings settings) {
    const GaussRule& rule = detail::collocation_rule(order, largest_order, settings);
    // Constructed in place: a move would be compiled for each width.
    if constexpr (largest_order > 16)
      if (order > 16)
        return AnySteps(std::in_place_index<2>, field<16>(problem), problem.size(), rule, settings);
    if constexpr (largest_order > 8)
      if (order > 8)
        return AnySteps(std::in_place_index<1>, field<8>(problem), problem.size(), rule, settings);
    return AnySteps(std::in_place_index<0>, field<4>(problem), problem.size(), rule, settings);
  }
  template <int w>
  static std::unique_ptr<StageField<n, w>> field(const Problem& problem) {
    return std::make_unique<FieldOf<Problem, w>>(problem);
  }
  /// Calls use(steps) with the GaussStep of the current width; compiles faster than std::visit.
  template <std::size_t i = 0, class Any, class Use>
  static decltype(auto) with(Any& any, const Use& use) {
    if constexpr (i + 1 < std::variant_size_v<AnySteps>)
      if (any.index() != i) return with<i + 1>(any, use);
    return use(*std::get_if<i>(&any));
  }

  Problem problem_;
  int order_;
  AnySteps steps_;
};

/// Gauss collocation of order 2, 4, ... 16 for a problem from poincare() or time_dependent(). Orders up to 32
/// are available as collocation<32>(problem, order).
/// @throws std::invalid_argument for an order that is odd or out of [2, largest_order], or an improper
/// setting.
template <int largest_order = 16, class Problem>
Collocation<Problem, largest_order> collocation(const Problem& problem, int order,
                                                SweepSettings settings = {}) {
  return {problem, order, settings};
}

}  // namespace avi
