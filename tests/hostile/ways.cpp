#include "hostile/formulas.hpp"
#include "hostile/system.hpp"

#include "avi/solve.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

/// @file
/// The way of solve() through systems drawn at random - what was chosen, what it cost, every bit of what came
/// out - beside a file of how it was: no rule and no number of the choice changes unseen.

namespace {

using namespace hostile;

constexpr std::uint64_t seed = 20261125;
constexpr int systems = 150;
constexpr std::array<double, 3> tolerances{1e-4, 1e-8, 1e-12};

/// FNV-1a (Fowler, Noll and Vo, 1991), of numbers by their bits.
class Digest {
 public:
  void add(const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      value_ = (value_ ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3U;
  }
  void add(double x) { add(&x, sizeof x); }
  void add(const std::string& text) { add(text.data(), text.size()); }
  template <class State>
  void add_state(const State& z) {
    add(z.t);
    for (Eigen::Index i = 0; i < z.q.size(); ++i)
      add(z.q[i]), add(z.p[i]);
  }
  /// Eight digits.
  [[nodiscard]] std::string text() const {
    return fmt::format("{:08x}", (value_ >> 32U) ^ (value_ & 0xffffffffU));
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

/// Of the functions of this machine's mathematical library: with others, all later digits are others.
std::string functions() {
  Digest all;
  for (int i = 1; i <= 2000; ++i) {
    const double x = i / 211.0;
    for (const double y : {std::exp(-x), std::log(x), std::sin(x), std::cos(x), std::tan(x), std::atan(x),
                           std::tanh(x), std::sinh(x), std::cosh(x), std::cbrt(x), std::pow(x, 1.7),
                           std::log1p(x), std::expm1(x), std::erf(x), std::hypot(x, 1.0), std::atan2(x, 2.0),
                           std::acos(1.0 / (1.0 + x)), std::asin(1.0 / (1.0 + x))})
      all.add(y);
  }
  return all.text();
}

/// Of all numbers of the systems. Compilers may evaluate the arguments of a call in another order, and draw
/// others then, see Dice.
std::string drawn() {
  Digest all;
  for (int index = 0; index < systems; ++index) {
    const System system = draw(seed, index, 30.0);
    for (const auto* numbers : {&system.q, &system.p, &system.c, &system.unit})
      for (const double x : *numbers)
        all.add(x);
    all.add(system.t), all.add(system.t_end);
  }
  return all.text();
}

/// What is asked besides the end, by turns.
struct Wish {
  const char* name;
  void (*of)(avi::SolveOptions&);
  int times;  ///< Output times.
};
constexpr std::array<Wish, 8> wishes{
    Wish{"end", [](avi::SolveOptions&) {}, 0},
    Wish{"times", [](avi::SolveOptions&) {}, 7},
    Wish{"end", [](avi::SolveOptions&) {}, 0},
    Wish{"dense", [](avi::SolveOptions& options) { options.dense = true; }, 0},
    Wish{"unchecked", [](avi::SolveOptions& options) { options.check = false; }, 0},
    Wish{"events",
         [](avi::SolveOptions& options) {
           options.events = {avi::when([](const auto&, const auto& p) { return p[0]; }, {.count = 20})};
         },
         0},
    Wish{"order 8", [](avi::SolveOptions& options) { options.order = 8; }, 0},
    Wish{"fixed", [](avi::SolveOptions& options) { options.monitor = "fixed"; }, 3}};

std::string way(const System& system, const Wish& wish, double tolerance) {
  avi::State<avi::dynamic> start;
  start.q = Eigen::Map<const Eigen::VectorXd>(system.q.data(), system.n);
  start.p = Eigen::Map<const Eigen::VectorXd>(system.p.data(), system.n);
  start.t = system.t;
  avi::SolveOptions options{.sweeps = 2'000'000};
  wish.of(options);
  const auto h = [&system](const auto& q, const auto& p) { return system(q, p); };
  const double span = system.t_end - system.t;
  try {
    avi::Solution<avi::dynamic> found;
    if (wish.times > 0) {
      std::vector<double> times;
      for (int i = 1; i < wish.times; ++i)
        times.push_back(system.t + span * i / wish.times);
      times.push_back(system.t_end);
      found = avi::solve(h, start, times, tolerance, options);
    } else {
      found = avi::solve(h, start, system.t_end, tolerance, options);
    }
    Digest all;
    all.add(found.report());
    all.add_state(found.state);
    for (const auto& state : found.states)
      all.add_state(state);
    for (const auto& event : found.events)
      all.add_state(event.state);
    if (options.dense && found.curve)
      for (const double part : {0.03, 0.31, 0.77})
        all.add_state(found(system.t + part * (found.state.t - system.t)));
    const avi::Choice& choice = found.choice;
    return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{:.2e}\t{:.2e}\t{}", avi::name(found.run.outcome),
                       choice.name, choice.order, choice.trials.size(), found.run.steps,
                       found.run.evaluations + choice.sweeps + choice.check, found.state_error,
                       found.energy_error, all.text());
  } catch (const std::exception& error) {
    Digest all;
    all.add(std::string(error.what()));
    return fmt::format("exception\t\t\t\t\t\t\t\t{}", all.text());
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string file;
  bool write = false;
  CLI::App app("The way of avi::solve through systems drawn at random, beside a file of how it was.");
  app.add_option("file", file, "The file")->required();
  app.add_flag("--write", write, "Writes it anew");
  CLI11_PARSE(app, argc, argv);

  const std::string head = "functions " + functions() + ", systems " + drawn();
  std::vector<std::string> lines{
      head, "system\tfamily\tn\tasked\ttolerance\toutcome\tmonitor\torder\ttrials\tsteps\tsweeps\t"
            "state error\tenergy error\tdigest"};
  std::ifstream before(file);
  std::string line;
  if (!write && std::getline(before, line) && line != head) {
    fmt::print("Mathematical functions have other last digits here, or other systems are drawn: nothing to "
               "compare.\n");
    return 77;
  }
  for (int index = 0; index < systems; ++index) {
    const System system = draw(seed, index, 30.0);
    const Wish& wish = wishes[static_cast<std::size_t>(index) % wishes.size()];
    for (const double tolerance : tolerances)
      lines.push_back(fmt::format("{}\t{}\t{}\t{}\t{:.0e}\t{}", index, system.family, system.n, wish.name,
                                  tolerance, way(system, wish, tolerance)));
  }
  if (write) {
    std::ofstream out(file);
    for (const std::string& each : lines)
      out << each << '\n';
    return out.flush() ? 0 : 1;
  }
  int others = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (!std::getline(before, line)) line = "nothing";
    if (line != lines[i] && ++others <= 20) fmt::print("was: {}\nis:  {}\n", line, lines[i]);
  }
  fmt::print("{} of {} calls go another way than before.\n", others, lines.size() - 2);
  if (others > 0) fmt::print("If that is meant: hostile_ways {} --write\n", file);
  return others == 0 ? 0 : 1;
}
