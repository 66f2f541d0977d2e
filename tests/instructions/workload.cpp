#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/htvi/htvi.hpp"
#include "avi/optim/minimise.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/solve.hpp"
#include "avi/transform/monitors.hpp"
#include "common/methods/printed_htvi.hpp"

#include <cstdio>
#include <map>
#include <string>

// Fixed work whose instructions are counted (make instructions): HTVI with short formulas and the order known
// to the compiler, and with long ones and the order known at run time; collocation; the two front doors.

namespace {

constexpr double eccentricity = 0.9;

template <class Method>
bool run(Method method, double h, double time) {
  auto z = avi::Kepler::pericentre(eccentricity);
  return avi::integrate(method, z, h, {.time = time}).outcome == avi::Outcome::ok;
}

auto problem() {
  return avi::poincare<2>(avi::Kepler{}, avi::Kepler::pericentre(eccentricity),
                          avi::bounded(avi::NormSquared{}, 0.01, 8.0));
}

/// The row HTVI4, gamma, of Table 1 over ten times its horizon.
bool htvi4() { return run(avi::type2<3, experiment::Authors>(problem(), avi::simpson()), 0.1, 100.0); }

/// Order 16 over five periods, to round-off.
bool htvi16() {
  return run(avi::htvi_of_order<avi::Generating::type2>(7, problem(), avi::gauss(8)), 0.2, 10.0 * M_PI);
}

/// A hundred periods by order 8, the formulas inlined.
bool collocation8() { return run(avi::collocation(problem(), 8), 0.2, 200.0 * M_PI); }

/// The front door over a hundred periods: choosing, two runs side by side, programs in machine code.
bool solve() {
  return avi::solve(avi::Kepler{}, avi::Kepler::pericentre(eccentricity), 200.0 * M_PI, 1e-9).ok();
}

/// Rosenbrock's valley in a hundred dimensions, its gradient by recording, seven pairs.
bool minimise() {
  const auto valley = [](const auto& x) {
    auto sum = 0.0 * x[0];
    for (Eigen::Index i = 0; i + 1 < x.size(); ++i) {
      const auto a = 1.0 - x[i], b = x[i + 1] - x[i] * x[i];
      sum += a * a + 100.0 * b * b;
    }
    return sum;
  };
  return avi::minimise(valley, avi::VectorX::Constant(100, -1.2)).ok();
}

}  // namespace

/// By its C name callgrind finds what to count, without the program's start.
extern "C" [[gnu::noinline]] bool measured(bool (*work)()) { return work(); }

int main(int argc, char** argv) {
  const std::map<std::string, bool (*)()> works{{"htvi4", &htvi4},
                                                {"htvi16", &htvi16},
                                                {"collocation8", &collocation8},
                                                {"solve", &solve},
                                                {"minimise", &minimise}};
  const std::string name = argc == 2 ? argv[1] : "";
  if (name == "--compiler") return std::puts(AVI_COMPILER) < 0;
  if (name == "--list") {
    for (const auto& work : works)
      std::puts(work.first.c_str());
    return 0;
  }
  const auto work = works.find(name);
  if (work == works.end()) return std::fputs("One of --compiler, --list or a name of the list.\n", stderr), 2;
  return measured(work->second) ? 0 : 1;
}
