#include "beyond/speed/bench/run.hpp"

#include "avi/htvi/htvi.hpp"
#include "avi/transform/monitors.hpp"

// HTVI4 with every monitor, and what automatic gradients cost. InverseEnergyError is infinite on the
// solution, so that no step can be timed.

namespace {

const avi::Kepler kepler;

template <class G, class H = avi::Kepler>
void htvi4(const char* name, const G& monitor, double h, const H& hamiltonian = {}) {
  bench::add(
      name,
      [=] {
        return avi::type2<3, avi::authors>(avi::poincare<2>(hamiltonian, bench::start(), monitor),
                                           avi::simpson());
      },
      h);
}

void register_all() {
  htvi4("none", avi::Unit{}, 0.0025);
  htvi4("norm_squared", avi::NormSquared{}, 0.1);
  htvi4("norm_squared_bounded", avi::bounded(avi::NormSquared{}, 0.01, 8.0), 0.1);
  htvi4("gamma_three_quarters", avi::Gamma{0.75}, 0.05);
  htvi4("arclength", avi::Arclength<avi::Kepler>{kepler, -0.5}, 0.1);
  htvi4("energy_bounded", avi::bounded(avi::Energy<avi::Kepler>{kepler, 0.5}, 1e-4, 2.0), 0.1);
  htvi4("inverse_lagrangian_bounded", avi::bounded(avi::InverseLagrangian<avi::Kepler>{kepler}, 1e-3, 3.0),
        0.02);
  htvi4("truncation", avi::Truncation<avi::Kepler>{kepler, 0.5, 1.0}, 0.1);
  htvi4("truncation_root", avi::TruncationRoot<avi::Kepler>{kepler, 0.5, 1.0}, 0.02);
  htvi4("norm_squared_automatic_gradient", avi::bounded(avi::NormSquared{}, 0.01, 8.0), 0.1,
        avi::Automatic<avi::Kepler>{kepler});
}

}  // namespace

int main(int argc, char** argv) { return bench::main(argc, argv, &register_all); }
