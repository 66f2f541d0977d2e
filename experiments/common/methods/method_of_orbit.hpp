#pragma once
#include "avi/core/any_method.hpp"

#include <functional>

// A function that constructs the method for each orbit of a Hamiltonian.

namespace experiment {

/// A Hamiltonian H, and a function that constructs a method for the orbit through a start. Each run gets a
/// new method, so that nothing remains from an earlier run.
template <int n>
struct MethodOf {
  std::function<double(const avi::State<n>&)> energy;                 ///< H.
  std::function<avi::AnyMethod<n>(const avi::State<n>& start)> make;  ///< Constructs the method.

  /// @param its_method its_method(start) returns a method for the orbit of H through start
  template <class H, class Make>
  MethodOf(const H& hamiltonian, Make its_method)
      : energy([=](const avi::State<n>& z) { return hamiltonian(z.q, z.p); }), make(its_method) {}
};

using State2 = avi::State<2>;
using Method2 = MethodOf<2>;  ///< For two degrees of freedom.

}  // namespace experiment
