#include "beyond/speed/bench/run.hpp"

#include "avi/htvi/htvi.hpp"
#include "avi/transform/euler_b.hpp"
#include "avi/transform/monitors.hpp"

#include <string>

// HTVI of every order with the gamma monitor of Table 1: at run time, and known to the compiler.

namespace {

auto problem() {
  return avi::poincare<2>(avi::Kepler{}, bench::start(), avi::bounded(avi::NormSquared{}, 0.01, 8.0));
}

template <int order>
void at_compile_time(double h) {
  bench::add(
      "htvi" + std::to_string(order), [] { return avi::htvi<order>(problem()); }, h);
}

void register_all() {
  bench::add(
      "euler_b", [] { return avi::euler_b<2>(avi::Kepler{}, bench::start(), avi::NormSquared{}); }, 1e-3);
  for (int r = 0; r <= 7; ++r)
    bench::add(
        "htvi_of_order_" + std::to_string(2 * r + 2),
        [=] { return avi::htvi_of_order<avi::Generating::type2>(r, problem(), avi::gauss(r + 1)); }, 0.1);
  at_compile_time<2>(0.1);
  at_compile_time<4>(0.1);
  at_compile_time<6>(0.1);
  at_compile_time<8>(0.1);
}

}  // namespace

int main(int argc, char** argv) { return bench::main(argc, argv, &register_all); }
