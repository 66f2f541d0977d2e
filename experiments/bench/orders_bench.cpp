#include "bench/run.hpp"

#include "avi/adaptive/euler_b.hpp"
#include "avi/adaptive/monitors.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/htvi/value_first.hpp"

#include <string>

// HTVI of every order with the gamma monitor of Table 1: at run time, and known to the compiler.

namespace {

auto problem() {
  return avi::poincare<2>(avi::Kepler{}, bench::start(), avi::bounded(avi::NormSquared{}, 0.01, 8.0));
}

/// The Gauss rule of the order.
avi::Quadrature rule(int order) { return avi::gauss((order + 1) / 2); }

template <int order>
void at_compile_time(double h) {
  bench::add(
      "htvi" + std::to_string(order), [] { return avi::type2<order - 1>(problem(), rule(order)); }, h);
}

void register_all() {
  bench::add(
      "euler_b", [] { return avi::euler_b<2>(avi::Kepler{}, bench::start(), avi::NormSquared{}); }, 1e-3);
  for (int order = 1; order <= 16; ++order)
    bench::add(
        "htvi_of_order_" + std::to_string(order),
        [=] { return avi::htvi_of_order<avi::Generating::type2>(order - 1, problem(), rule(order)); },
        order == 1 ? 0.01 : 0.1);
  at_compile_time<2>(0.1);
  at_compile_time<4>(0.1);
  at_compile_time<6>(0.1);
  at_compile_time<8>(0.1);
  const auto first = [] { return avi::ValueFirst(avi::type2<7>(problem(), rule(8))); };
  bench::add("value_first_htvi8_always_converged", first, 0.002);
  bench::add("value_first_htvi8_never_converged", first, 0.1);
}

}  // namespace

int main(int argc, char** argv) { return bench::main(argc, argv, &register_all); }
