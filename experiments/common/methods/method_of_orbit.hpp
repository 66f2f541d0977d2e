#pragma once
#include "avi/core/any_method.hpp"

#include <functional>

// A method for every orbit of a Hamiltonian.

namespace experiment {

/// H, and a method for the orbit through a start: made anew each time, so that nothing is left over from
/// another run.
template <int n>
struct MethodOf {
  std::function<double(const avi::State<n>&)> energy;                 ///< H.
  std::function<avi::AnyMethod<n>(const avi::State<n>& start)> make;  ///< The method.

  /// `its_method(start)` is a method for the orbit of H through start.
  template <class H, class Make>
  MethodOf(const H& hamiltonian, Make its_method)
      : energy([=](const avi::State<n>& z) { return hamiltonian(z.q, z.p); }), make(its_method) {}
};

using State2 = avi::State<2>;
using Method2 = MethodOf<2>;  ///< In the plane.

}  // namespace experiment
