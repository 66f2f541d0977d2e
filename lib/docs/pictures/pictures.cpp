#include <avi/avi.hpp>
#include <avi/problems/n_body.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string>

// What the pictures of the examples show, as tables of numbers: pictures FOLDER writes FOLDER/<example>.dat;
// blocks of one file are apart by two empty lines. pictures.gp draws them.

namespace {

std::string folder;
bool written = true;

/// One file of numbers.
class Table {
 public:
  explicit Table(const char* name) : file_(folder + "/" + name + ".dat") { file_.precision(10); }
  ~Table() {
    file_.close();
    if (!file_) written = false;
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  template <class... Numbers>
  void row(const Numbers&... numbers) {
    ((file_ << numbers << ' '), ...);
    file_ << '\n';
  }
  void end_block() { file_ << "\n\n"; }

 private:
  std::ofstream file_;
};

const auto centre = [](const auto& q, const auto& p) {
  return 0.5 * p.squaredNorm() - 1.0 / sqrt(q.squaredNorm());
};
const avi::State<2> pericentre{.q = {0.1, 0.0}, .p = {0.0, std::sqrt(19.0)}};

/// The states after each step of one period by order 8, with the largest relative energy error up to then.
template <class Monitor>
void orbit(Table& table, const Monitor& monitor, int steps) {
  double h = 2.0 * std::numbers::pi / steps;  // that which makes `steps` of a period, by false position
  for (int i = 0; i < 40; ++i) {
    auto method = avi::collocation(avi::poincare<2>(centre, pericentre, monitor), 8);
    avi::State<2> z = pericentre;
    if (!avi::integrate(method, z, h, {.steps = steps}).ok()) return;
    h *= std::pow(2.0 * std::numbers::pi / z.t, 0.5);
  }
  auto method = avi::collocation(avi::poincare<2>(centre, pericentre, monitor), 8);
  avi::State<2> z = pericentre;
  const double energy = centre(z.q, z.p);
  double worst = 0.0;
  (void)avi::integrate(method, z, h, {.steps = steps}, [&](const auto& now, long) {
    worst = std::max(worst, std::abs(centre(now.q, now.p) / energy - 1.0));
    table.row(now.q[0], now.q[1], now.t, worst);
  });
  table.end_block();
}

void orbits() {
  Table table("orbit");
  for (int i = 0; i <= 400; ++i) {  // the ellipse
    const double u = 2.0 * std::numbers::pi * i / 400.0;
    table.row(std::cos(u) - 0.9, std::sqrt(0.19) * std::sin(u), u);
  }
  table.end_block();
  orbit(table, avi::Unit{}, 40);
  orbit(table, avi::Gamma{0.75}, 40);
}

/// The path of two coordinates at equal times.
template <class H, int n>
void plane(Table& table, const H& hamiltonian, const avi::State<n>& start, double h, double t_end,
           int points) {
  auto method = avi::collocation(avi::poincare<n>(hamiltonian, start), 8);
  avi::State<n> z = start;
  for (int i = 0; i <= points; ++i) {
    if (i > 0 && !avi::integrate_to(method, z, h, t_end * i / points).ok()) break;
    table.row(z.q[0], z.q[1], z.t);
  }
  table.end_block();
}

void springs() {
  Table table("spring");
  const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 0.0}};
  plane(
      table,
      [](const auto& q, const auto& p) {
        const auto stretch = sqrt(q[0] * q[0] + q[1] * q[1]) - 1.0;
        return 0.5 * p.squaredNorm() + 5.0 * stretch * stretch + q[1];
      },
      start, 0.05, 10.0, 500);
  plane(
      table,
      [](const auto& q, const auto& p) {
        using avi::select;
        const auto stretch = sqrt(q[0] * q[0] + q[1] * q[1]) - 1.0;
        return 0.5 * p.squaredNorm() + 5.0 * select(stretch > 0.0, stretch * stretch, 0.0 * stretch) + q[1];
      },
      start, 0.01, 10.0, 500);
}

void nuclei() {
  Table table("untuned");
  plane(
      table,
      [](const auto& q, const auto& p) {
        const auto x = p[0] + 0.15 * q[1], y = p[1] - 0.15 * q[0];
        const auto left = (q[0] + 1.0) * (q[0] + 1.0) + q[1] * q[1];
        const auto right = (q[0] - 1.0) * (q[0] - 1.0) + q[1] * q[1];
        return 0.5 * (x * x + y * y) - 1.0 / sqrt(left) - 0.5 / sqrt(right);
      },
      avi::State<2>{.q = {0.0, 1.0}, .p = {0.25, 0.1}}, 0.002, 35.0, 2100);
}

void galaxy() {
  Table table("henon_heiles");
  for (const double y : {-0.2, 0.45, 0.3, 0.2, -0.05, 0.05, 0.12, -0.3, 0.55}) {
    const avi::HenonHeiles problem;
    avi::State<2> z = avi::HenonHeiles::on_section(1.0 / 8.0, y, 0.0);
    auto method = avi::collocation(avi::poincare(problem, z), 8);
    auto section =
        avi::on_event(avi::Event{[](const avi::State<2>& now) { return now.q[0]; }, avi::Crossing::rising},
                      [&](const avi::State<2>& point) { table.row(point.q[1], point.p[1]); });
    (void)avi::integrate(method, z, 0.2, {.time = y == -0.2 ? 12000.0 : 2500.0}, section);
    table.end_block();
  }
}

void three_bodies() {
  Table table("figure_eight");
  const auto bodies = avi::FigureEight::problem();
  avi::State<6> z = avi::FigureEight::start();
  auto method = avi::collocation(avi::poincare(bodies, z), 16);
  for (int i = 0; i <= 300; ++i) {
    if (i > 0) (void)avi::integrate_to(method, z, 0.2, avi::FigureEight::period * i / 300.0);
    table.row(z.q[0], z.q[1], z.q[2], z.q[3], z.q[4], z.q[5]);
  }
}

/// Pendulums that are pushed or shaken: where they are after each period of the push.
template <class H>
void strobe(Table& table, const H& hamiltonian, double q, double p, double omega, int periods, bool all) {
  avi::State<1> start{.q = avi::Vector<double, 1>(q), .p = avi::Vector<double, 1>(p)};
  const auto problem = avi::time_dependent(hamiltonian, start);
  auto method = avi::collocation(problem, 12);
  avi::State<2> z = avi::extended(problem, start);
  const int parts = all ? 60 : 1;
  for (int k = 1; k <= periods * parts; ++k) {
    if (!avi::integrate_to(method, z, 0.25, k * 2.0 * std::numbers::pi / omega / parts).ok()) break;
    table.row(std::remainder(z.q[0], 2.0 * std::numbers::pi), z.p[0]);
  }
  table.end_block();
}

void pendulums() {
  Table shaken("separatrix");
  const auto gravity = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * (p[0] * p[0]) - (1.0 + 0.1 * cos(2.0 * t)) * cos(q[0]);
  };
  for (int i = 0; i < 26; ++i)
    strobe(shaken, gravity, 0.0, 0.1 * (i + 0.5), 2.0, i > 17 && i < 22 ? 1200 : 200, false);
  Table pushed("driven_pendulum");
  const auto push = [](const auto& q, const auto& t, const auto& p) {
    return 0.5 * (p[0] * p[0]) - cos(q[0]) - 0.3 * (q[0] * cos(2.0 / 3.0 * t));
  };
  strobe(pushed, push, 0.5, 0.0, 2.0 / 3.0, 8, true);
}

void binary() {
  Table table("eccentric_binary");
  const avi::NBody<3> bodies(avi::Vector<double, 3>(0.5, 0.5, 0.01));
  const double v = std::sqrt(0.05 / 1.95), w = std::sqrt(1.0 / 8.0);
  avi::State<6> z;
  z.q << 0.975, 0.0, -0.975, 0.0, 0.0, 8.0;
  z.p << 0.0, 0.25 * v, 0.0, -0.25 * v, -0.01 * w, 0.0;
  const auto closest = [](const auto& q) {
    const auto close = [&](int i, int j) { return pow(avi::NBody<3>::distance_squared(q, i, j), -1.5); };
    return pow(close(0, 1) + close(0, 2) + close(1, 2), -0.5);
  };
  auto method = avi::htvi<8>(avi::poincare<6>(bodies, z, closest));
  double before = 0.0;
  (void)avi::integrate(method, z, 0.2, {.time = 30.0}, [&](const auto& now, long) {
    if (now.t > before) table.row(now.t, now.t - before);
    before = now.t;
  });
}

void eccentric_steps() {
  Table table("kepler");
  auto method = avi::htvi<8>(avi::poincare<2>(centre, pericentre, avi::bounded(avi::Gamma{}, 0.01, 8.0)));
  avi::State<2> z = pericentre;
  double before = 0.0;
  (void)avi::integrate(method, z, 0.2, {.time = 20.0 * std::numbers::pi}, [&](const auto& now, long) {
    if (now.t > before) table.row(now.t, now.t - before);
    before = now.t;
  });
}

void orders() {
  Table table("own_problem");
  const auto quartic = [](const auto& q, const auto& p) {
    const auto square = q.squaredNorm();
    return 0.5 * p.squaredNorm() + 0.25 * square * square + q[0] * q[1];
  };
  const avi::State<2> start{.q = {1.0, 0.0}, .p = {0.0, 0.5}};
  const auto problem = avi::poincare<2>(quartic, start);
  const double energy = quartic(start.q, start.p);
  for (const int nodes : {3, 6}) {
    for (double h = 0.1; h < 0.45; h *= 1.12) {
      auto method = avi::type2<5>(problem, avi::gauss(nodes));
      avi::State<2> z = start;
      double worst = 0.0;
      if (avi::integrate(method, z, h, {.time = 50.0}, [&](const auto& now, long) {
            worst = std::max(worst, std::abs(quartic(now.q, now.p) - energy));
          }).ok())
        table.row(h, worst);
    }
    table.end_block();
  }
}

void valleys() {
  Table table("minimise");
  const auto valley = [](const auto& x) {
    const auto a = 1.0 - x[0], b = x[1] - x[0] * x[0];
    return a * a + 100.0 * b * b;
  };
  for (int i = 0; i <= 80; ++i) {
    for (int k = 0; k <= 80; ++k) {
      const avi::VectorX x = Eigen::Vector2d(-1.6 + 0.04 * i, -0.6 + 0.03 * k);
      table.row(x[0], x[1], std::log10(valley(x) + 1e-3));
    }
    table.row("");
  }
  table.end_block();
  table.row(-1.2, 1.0);
  const auto show = [&](const avi::Progress& now) {
    if (now.exact) table.row(now.x[0], now.x[1]);
    return true;
  };
  (void)avi::minimise(valley, {-1.2, 1.0}, {.relative = 1e-10, .callback = show});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("pictures FOLDER\n", stderr), 2;
  folder = argv[1];
  orbits();
  springs();
  nuclei();
  galaxy();
  three_bodies();
  pendulums();
  binary();
  eccentric_steps();
  orders();
  valleys();
  if (!written) return std::fprintf(stderr, "pictures: Cannot write all of '%s'.\n", folder.c_str()), 2;
}
