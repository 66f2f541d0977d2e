#pragma once
#include "avi/core/integrate.hpp"
#include "avi/core/state.hpp"

#include <memory>
#include <utility>

/// @file
/// AnyMethod: one type for all methods, chosen at run time.

namespace avi {

/// Any Method for states with n degrees of freedom, behind one type. It serves methods that are chosen at run
/// time, and code that is compiled once for all methods. Its steps equal those of the method inside to the
/// bit. A call of step() costs one extra indirect call; integrate() without observers runs in a loop compiled
/// for the method inside. It has no order: Composition takes the method itself.
template <int n>
class AnyMethod {
 public:
  static constexpr bool one_step = false;  ///< The method inside may remember more than the state.

  /// Stores the method. A copy of an AnyMethod has its own copy of the method.
  template <class M>
  requires(Method<M, State<n>> && !std::is_same_v<M, AnyMethod>) AnyMethod(M method)  // NOLINT: implicit
      : held_(std::make_unique<Held<M>>(std::move(method))) {}
  /// Copies the method. A move also copies, so that an AnyMethod never lacks a method.
  AnyMethod(const AnyMethod& other) : held_(other.held_->copy()) {}
  AnyMethod& operator=(AnyMethod other) { return held_.swap(other.held_), *this; }  ///< Likewise.
  ~AnyMethod() = default;

  /// One step of the method inside.
  StepReport step(State<n>& z, double h) { return held_->step(z, h); }
  /// A run of the method inside, without observers; as avi::integrate().
  [[nodiscard]] Run run(State<n>& z, double h, const Until& until) { return held_->run(z, h, until); }

 private:
  struct Base;

 public:
  /// The time of the problem inside, which may be one of its coordinates.
  class Clock {
   public:
    /// @param method the method inside, which must outlive this object
    explicit Clock(const Base& method) : method_(method) {}
    /// The time of a state, as the problem has it.
    [[nodiscard]] double clock(const Vector<double, n>& q, double t) const { return method_.clock(q, t); }
    /// Sets the time of a state, and of that coordinate.
    void set_time(State<n>& z, double t) const { method_.set_time(z, t); }

   private:
    const Base& method_;
  };
  /// The clock of the problem inside, for runs.
  [[nodiscard]] Clock problem() const { return Clock(*held_); }

 private:
  struct Base {
    virtual ~Base() = default;
    [[nodiscard]] virtual std::unique_ptr<Base> copy() const = 0;
    virtual StepReport step(State<n>& z, double h) = 0;
    virtual Run run(State<n>& z, double h, const Until& until) = 0;
    [[nodiscard]] virtual double clock(const Vector<double, n>& q, double t) const = 0;
    virtual void set_time(State<n>& z, double t) const = 0;
  };
  template <class M>
  struct Held final : Base {
    explicit Held(M its) : method(std::move(its)) {}
    [[nodiscard]] std::unique_ptr<Base> copy() const override { return std::make_unique<Held>(method); }
    StepReport step(State<n>& z, double h) override { return method.step(z, h); }
    Run run(State<n>& z, double h, const Until& until) override { return integrate(method, z, h, until); }
    [[nodiscard]] double clock(const Vector<double, n>& q, double t) const override {
      if constexpr (requires { method.problem().clock(q, t); }) return method.problem().clock(q, t);
      return t;
    }
    void set_time(State<n>& z, double t) const override { detail::set_time(method, z, t); }
    M method;
  };
  std::unique_ptr<Base> held_;
};

/// Runs the method inside, without observers, in a loop compiled for it; see integrate().
template <int n>
[[nodiscard]] Run integrate(AnyMethod<n>& method, State<n>& state, double h, Until until) {
  return method.run(state, h, until);
}

}  // namespace avi
