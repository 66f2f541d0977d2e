#pragma once
#include "avi/core/integrate.hpp"
#include "avi/core/state.hpp"

#include <memory>
#include <utility>

/// @file
/// One type for every method.

namespace avi {

/// Any Method for states of n degrees of freedom behind one type: for methods that are chosen at run time,
/// and for code that is compiled once for all of them. It steps as the method in it does, to the bit; a call
/// of step() costs one indirect call more, and integrate() without observers runs in a loop that is compiled
/// for the method itself.
template <int n>
class AnyMethod {
 public:
  static constexpr bool one_step = false;  ///< The method in it may remember more than the state.

  /// Takes the method in. A copy of an AnyMethod has a copy of its method.
  template <class M>
  requires(Method<M, State<n>> && !std::is_same_v<M, AnyMethod>) AnyMethod(M method)  // NOLINT: implicit
      : held_(std::make_unique<Held<M>>(std::move(method))) {}
  /// A method of its own; also for a move, so that there is always a method.
  AnyMethod(const AnyMethod& other) : held_(other.held_->copy()) {}
  AnyMethod& operator=(AnyMethod other) { return held_.swap(other.held_), *this; }  ///< Likewise.
  ~AnyMethod() = default;

  /// The method's step.
  StepReport step(State<n>& z, double h) { return held_->step(z, h); }
  /// The method's run without observers, as avi::integrate().
  [[nodiscard]] Run run(State<n>& z, double h, const Until& until) { return held_->run(z, h, until); }

 private:
  struct Base {
    virtual ~Base() = default;
    [[nodiscard]] virtual std::unique_ptr<Base> copy() const = 0;
    virtual StepReport step(State<n>& z, double h) = 0;
    virtual Run run(State<n>& z, double h, const Until& until) = 0;
  };
  template <class M>
  struct Held final : Base {
    explicit Held(M its) : method(std::move(its)) {}
    [[nodiscard]] std::unique_ptr<Base> copy() const override { return std::make_unique<Held>(method); }
    StepReport step(State<n>& z, double h) override { return method.step(z, h); }
    Run run(State<n>& z, double h, const Until& until) override { return integrate(method, z, h, until); }
    M method;
  };
  std::unique_ptr<Base> held_;
};

/// The run of any method, without observers: in the loop of the method itself. See integrate().
template <int n>
[[nodiscard]] Run integrate(AnyMethod<n>& method, State<n>& state, double h, Until until) {
  return method.run(state, h, until);
}

}  // namespace avi
