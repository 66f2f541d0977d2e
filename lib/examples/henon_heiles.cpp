#include <avi/core/event.hpp>
#include <avi/core/integrate.hpp>
#include <avi/htvi/htvi.hpp>
#include <avi/problems/henon_heiles.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

// The model of Henon and Heiles at the energies 1/12 and 1/8: where do orbits cross x = 0 with p_x > 0? On a
// regular orbit the points (y, p_y) of this Poincare section lie on a curve, on a chaotic one they fill an
// area: the number of cells of a 40 x 40 grid that they visit tells the two apart.

int main() {
  std::printf("energy   y(0)    the points   energy error\n");
  for (const auto& orbit : {std::pair{1.0 / 12.0, 0.2}, {1.0 / 8.0, 0.45}, {1.0 / 8.0, -0.2}}) {
    const double energy = orbit.first, y = orbit.second;
    const avi::HenonHeiles galaxy;
    avi::State<2> z = avi::HenonHeiles::on_section(energy, y, 0.0);
    auto method = avi::htvi<12>(avi::poincare(galaxy, z));

    int cells = 0;
    double worst = 0.0;
    bool visited[40][40] = {};
    // x = 0 from below: the states there are as accurate as the run.
    auto section =
        avi::on_event(avi::Event{[](const avi::State<2>& now) { return now.q[0]; }, avi::Crossing::rising},
                      [&](const avi::State<2>& point) {
                        bool& cell = visited[static_cast<int>(20.0 * (point.q[1] + 1.0))]
                                            [static_cast<int>(20.0 * (point.p[1] + 1.0))];
                        cells += !cell;
                        cell = true;
                      });
    const auto energy_error = [&](const avi::State<2>& now, long) {
      worst = std::max(worst, std::abs(galaxy(now.q, now.p) - energy));
    };
    const avi::Run run = avi::integrate(method, z, 0.1, {.steps = 50000}, energy_error, section);
    if (run.outcome != avi::Outcome::ok) {
      std::printf("%s\n", run.message.c_str());
      return 1;
    }
    std::printf("%.4f   %5.2f   %-10s   %s\n", energy, y, cells > 100 ? "fill areas" : "on curves",
                worst < 1e-10 ? "below 1e-10" : "above 1e-10");
  }
}
