#include "digest.hpp"
#include "hostile/dice.hpp"
#include "hostile/formulas.hpp"
#include "hostile/system.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/core/integrate.hpp"
#include "avi/optim/minimise.hpp"
#include "avi/solver.hpp"
#include "avi/transform/poincare.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// @file
/// The way of solve(), of a Solver and of minimise() through systems drawn at random - what was chosen, what
/// it cost, every bit of what came out - beside a file of how it was: no rule and no number changes unseen.

namespace {

using namespace hostile;

constexpr std::uint64_t seed = 20261125;
constexpr int systems = 528;
constexpr std::array<double, 3> tolerances{1e-4, 1e-8, 1e-12};

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

/// What is asked of a system, by turns.
constexpr std::array<std::string_view, 22> wishes{
    "end",   "times",  "back",    "dense",   "unchecked", "events",  "order", "fixed",
    "timed", "stop",   "menu",    "given",   "solver",    "minimum", "bound", "fast events",
    "loose", "saddle", "resumed", "by hand", "curves",    "branches"};
constexpr int count = static_cast<int>(wishes.size());

using State = avi::State<avi::dynamic>;

/// Options of a wish; those of the menu differ from system to system.
avi::SolveOptions options_of(std::string_view wish, int index, const System& system) {
  avi::SolveOptions options{.sweeps = 200'000};
  const double q_scale = system.q_scale[0], p_scale = system.p_scale[0], q_start = system.q[0];
  const auto turn = static_cast<std::size_t>(index / count) % 5;
  const auto momentum = [](const auto&, const auto& p) { return p[0]; };
  if (wish == "dense") options.dense = true;
  if (wish == "unchecked" || wish == "resumed") options.check = false;
  if (wish == "bound" || wish == "resumed") options.steps = 40;
  if (wish == "order") options.order = std::array{2, 4, 8, 12, 16}[turn];
  if (wish == "fixed") options.monitor = "fixed";
  if (wish == "menu")
    options.monitor = std::array{"energy", "energy^1.5", "poles", "acceleration", "splitting"}[turn];
  if (wish == "given")
    options.monitor = [p_scale](const auto&, const auto& p) {
      return 1.0 / (1.0 + p[0] * p[0] * (1.0 / (p_scale * p_scale)));
    };
  if (wish == "stop") options.events = {avi::when(momentum, {.direction = -1, .count = 3, .stop = true})};
  if (wish == "events")
    options.events = {avi::when(momentum, {.count = 20}),
                      avi::when([q_start](const auto& q) { return q[0] - q_start; }, {.direction = 1})};
  if (wish == "fast events")
    options.events = {avi::when(
        [q_scale, q_start](const auto& q) { return sin((q[0] - q_start) * (40.0 / q_scale)) - 0.999; },
        {.count = 300})};
  if (wish == "resumed")
    options.checkpoint =
        (std::filesystem::temp_directory_path() /
         fmt::format("avi_ways_{}", std::chrono::steady_clock::now().time_since_epoch().count()))
            .string();
  return options;
}

/// What came of a call, in nine columns. @param energy H as it was solved, of (q, p), where its monitor is to
/// be made for use by hand
std::string described(const avi::Solution<avi::dynamic>& found, const avi::Formula* energy = nullptr,
                      double energy_at_start = 0.0) {
  Digest all;
  all.add(found.report());
  all.add_state(found.state);
  for (const auto& state : found.states)
    all.add_state(state);
  for (const auto& event : found.events)
    all.add_state(event.state);
  if (found.curve) {
    const double begin = found.curve->times().front();
    for (const double part : {0.03, 0.31, 0.77})
      all.add_state(found(begin + part * (found.state.t - begin)));
  }
  const avi::Choice& choice = found.choice;
  for (const avi::SolveTrial& trial : choice.trials)
    for (const double x : {trial.h, trial.time, trial.state_error, static_cast<double>(trial.sweeps)})
      all.add(x);
  for (const auto* weights : {&choice.accelerations, &choice.poles, &choice.drifts})
    for (const double x : *weights)
      all.add(x);
  for (const double x :
       {choice.h, choice.energy_scale, choice.kinetic, choice.solved, choice.time, found.energy_rounding})
    all.add(x);
  if (energy != nullptr && found.ok())
    all.add(avi::monitor_of(choice, *energy, energy_at_start).at(found.state.q, found.state.p));
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{:.2e}\t{:.2e}\t{}", avi::name(found.run.outcome), choice.name,
                     choice.order, choice.trials.size(), found.run.steps,
                     found.run.evaluations + choice.sweeps + choice.check, found.state_error,
                     found.energy_error, all.text());
}

/// The least H in phase space from the start on, or where that ends.
std::string minimum(const System& system, int index, double tolerance) {
  avi::VectorX start(2 * system.n);
  for (int i = 0; i < system.n; ++i)
    start[i] = system.q[i], start[system.n + i] = system.p[i];
  const auto f = [&system](const auto& x) {
    using S = std::decay_t<decltype(x[0])>;
    std::vector<S> q, p;
    for (int i = 0; i < system.n; ++i)
      q.push_back(x[i]), p.push_back(x[system.n + i]);
    return system(q, p);
  };
  const avi::Minimisation found = avi::minimise(f, start,
                                                {.relative = tolerance,
                                                 .memory = index % 3 == 0 ? 0 : 7,
                                                 .evaluations = 3000,
                                                 .check_gradient = index % 2 == 0});
  Digest all;
  all.add(found.message);
  all.add(found.last.value);
  for (const double x : found.last.x)
    all.add(x);
  return fmt::format("{}\t\t\t\t{}\t{}\t\t\t{}", avi::name(found.outcome), found.iterations,
                     found.gradient_evaluations, all.text());
}

/// One degree of freedom, let go here.
State at_rest(double q) {
  State start;
  start.q = avi::VectorX::Constant(1, q);
  start.p = avi::VectorX::Zero(1);
  return start;
}

/// A pendulum that is let go near its highest place, or sent there with nearly the energy to pass it.
std::string saddle(int index, double tolerance) {
  const int turn = index / count;
  const double off = std::pow(10.0, -1 - turn % 8);
  const auto h = [](const auto& q, const auto& p) { return 0.5 * p[0] * p[0] - cos(q[0]); };
  State start = at_rest(turn % 2 == 0 ? std::numbers::pi - off : 0.0);
  if (turn % 2 != 0) start.p[0] = 2.0 + off;
  return described(avi::solve(h, start, 40.0, tolerance));
}

/// Events of a spring: zeros alone, in pairs and in clusters, that touch, that nearly do; jumps and poles.
std::string curves(int index, double tolerance) {
  Dice dice(seed, static_cast<std::uint64_t>(index));
  const auto spring = [](const auto& q, const auto& p) { return 0.5 * (p[0] * p[0] + q[0] * q[0]); };
  avi::SolveOptions options{.sweeps = 200'000};
  for (int kind = 0; kind < 4; ++kind) {
    const double at = dice.between(-0.9, 0.9), apart = dice.decades(1e-9, 0.3),
                 fast = dice.decades(1.0, 60.0),
                 off = dice.chance(0.3) ? 0.0 : dice.sign() * dice.decades(1e-12, 1e-2);
    const auto product = [=](const auto& q) { return (q[0] - at) * (q[0] - at - apart) * (q[0] + at); };
    const auto touching = [=](const auto& q) { return (q[0] - at) * (q[0] - at) + off; };
    const auto wave = [=](const auto& q, const auto& p) { return cos(fast * q[0]) * p[0] - at + off; };
    const auto in_time = [=](const auto&, const auto& t, const auto&) {
      return sin(fast * t) - 1.0 + 1e-3 * off;
    };
    options.events.push_back(kind == 0   ? avi::when(product, {.count = 90})
                             : kind == 1 ? avi::when(touching)
                             : kind == 2 ? avi::when(wave, {.direction = dice.chance(0.5) ? 1 : 0})
                                         : avi::when(in_time));
  }
  const double wall = dice.between(-0.9, 0.9);
  if (index / count % 6 == 4)
    options.events = {avi::when([=](const auto& q) { return avi::select(q[0] < wall, -1.0, 1.0); })};
  if (index / count % 6 == 5)
    options.events = {avi::when([=](const auto& q) { return 1.0 / (q[0] - wall); })};
  return described(avi::solve(spring, at_rest(1.0), 12.0, tolerance, options));
}

/// A spring that is felt beyond a wall, in a band, and in a corner of phase space, some of them narrow.
std::string branches(int index, double tolerance) {
  Dice dice(seed + 1, static_cast<std::uint64_t>(index));
  const double wall = dice.between(-0.5, 0.9), hard = dice.decades(0.1, 1e3), left = dice.between(-0.9, 0.5),
               wide = dice.decades(1e-5, 0.3), high = dice.decades(1e-4, 1.0), fast = dice.between(-0.5, 0.9);
  const double walls = index / count % 3 == 0 ? hard : 0.0, bands = index / count % 3 == 1 ? high : 0.0,
               corners = index / count % 3 == 2 ? 1.0 : 0.0;
  const auto h = [=](const auto& q, const auto& p) {
    const auto beyond = q[0] - wall, in = (q[0] - left) * (left + wide - q[0]) / (wide * wide),
               over = p[0] - fast;
    return 0.5 * (p[0] * p[0] + q[0] * q[0]) +
           walls * avi::select(beyond > 0.0, beyond * beyond * beyond, 0.0) +
           bands * avi::select(in > 0.0, in * in, 0.0) +
           corners * avi::select(over > 0.0, 0.1 * over * over, 0.0);
  };
  return described(avi::solve(h, at_rest(-1.0), 7.0, 100.0 * tolerance, {.sweeps = 200'000}));
}

/// Steps of collocation by hand, some of them longer than can be solved for.
std::string by_hand(const System& system, State start, int index, double tolerance) {
  const auto h = [&system](const auto& q, const auto& p) { return system(q, p); };
  const int order = std::array{2, 4, 8, 12, 16}[static_cast<std::size_t>(index / count) % 5];
  Digest all;
  long sweeps = 0, steps = 0;
  for (const double parts : {300.0, 50.0, 10.0, 2.0}) {
    State z = start;
    auto method = avi::collocation(avi::poincare(h, z), order, {.tolerance = tolerance * 1e-3});
    const avi::Run run = avi::integrate(method, z, (system.t_end - system.t) / parts, {.steps = 12});
    all.add(run.message);
    all.add(static_cast<double>(run.evaluations));
    all.add_state(z);
    sweeps += run.evaluations, steps += run.steps;
  }
  return fmt::format("\t\t{}\t\t{}\t{}\t\t\t{}", order, steps, sweeps, all.text());
}

std::string way(const System& system, int index, std::string_view wish, double tolerance) {
  if (wish == "minimum") return minimum(system, index, tolerance);
  if (wish == "saddle") return saddle(index, 100.0 * tolerance);
  if (wish == "curves") return curves(index, tolerance);
  if (wish == "branches") return branches(index, tolerance);
  if (wish == "loose") tolerance *= 100.0;
  State start;
  start.q = Eigen::Map<const Eigen::VectorXd>(system.q.data(), system.n);
  start.p = Eigen::Map<const Eigen::VectorXd>(system.p.data(), system.n);
  start.t = system.t;
  if (wish == "by hand") return by_hand(system, start, index, tolerance);
  const auto h = [&system](const auto& q, const auto& p) { return system(q, p); };
  const double span = system.t_end - system.t;
  const avi::SolveOptions options = options_of(wish, index, system);
  if (wish == "timed") {
    const auto moving = [&](const auto& q, const auto& t, const auto& p) {
      return system(q, p) * (1.0 + 0.05 * cos((t - system.t) * (20.0 / span)));
    };
    return described(avi::solve(moving, start, system.t_end, tolerance, options));
  }
  const avi::Formula energy = avi::Formula::of_phase(h, system.n);
  const double energy_at_start = energy.at(start.q, start.p);
  const avi::Formula* const known = wish == "given" ? nullptr : &energy;
  if (wish == "times" || wish == "fixed") {
    std::vector<double> times;
    for (int i = 1; i < 7; ++i)
      times.push_back(system.t + span * i / 7);
    times.push_back(system.t_end);
    return described(avi::solve(energy, start, times, tolerance, options), known, energy_at_start);
  }
  if (wish == "solver") {
    const avi::Solver solver(energy, start, system.t_end, tolerance, options);
    start.q *= 1.001;
    return described(solver.run(start, system.t_end), known, energy_at_start);
  }
  if (wish == "resumed") {
    auto found = avi::solve(energy, start, system.t_end, tolerance, options);
    if (found.run.outcome == avi::Outcome::step_limit)
      found = avi::resume<avi::dynamic>(energy, options.checkpoint, {.sweeps = options.sweeps}, system.n);
    std::filesystem::remove(options.checkpoint);
    return described(found, known, energy_at_start);
  }
  const double end = wish == "back" ? system.t - span : system.t_end;
  return described(avi::solve(energy, start, end, tolerance, options), known, energy_at_start);
}

/// The same where it is an exception.
std::string way_or_exception(const System& system, int index, std::string_view wish, double tolerance) {
  try {
    return way(system, index, wish, tolerance);
  } catch (const std::exception& error) {
    Digest all;
    all.add(std::string(error.what()));
    return fmt::format("exception\t\t\t\t\t\t\t\t{}", all.text());
  }
}

/// The columns of a line that do not depend on the last digits of mathematical functions, but for a few
/// calls.
std::string outcome_and_method(const std::string& line) {
  std::size_t end = 0;
  for (int columns = 0; columns < 8 && end != std::string::npos; ++columns)
    end = line.find('\t', end + (columns > 0 ? 1 : 0));
  return line.substr(0, end);
}
/// Number of calls that may have another outcome or method where mathematical functions have other last
/// digits: twice as many as where each start is moved by the last digit.
constexpr int most_others = 20;

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
  bool same_digits = true;
  if (!write && std::getline(before, line)) {
    same_digits = line == head;
    if (!line.ends_with(", systems " + drawn())) {
      fmt::print("Other systems are drawn here: nothing to compare.\n");
      return 77;
    }
  }
  for (int index = 0; index < systems; ++index) {
    const System system = draw(seed, index, 30.0);
    const std::string_view wish = wishes[static_cast<std::size_t>(index) % wishes.size()];
    const bool spring = wish == "curves" || wish == "branches", own = spring || wish == "saddle";
    for (const double tolerance : tolerances)
      lines.push_back(fmt::format("{}\t{}\t{}\t{}\t{:.0e}\t{}", index,
                                  spring ? "spring"
                                  : own  ? "pendulum"
                                         : system.family,
                                  own ? 1 : system.n, wish, tolerance,
                                  way_or_exception(system, index, wish, tolerance)));
  }
  if (write) {
    std::ofstream out(file);
    for (const std::string& each : lines)
      out << each << '\n';
    return out.flush() ? 0 : 1;
  }
  int others = 0;
  const auto compared = [&](const std::string& text) {
    return same_digits ? text : outcome_and_method(text);
  };
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (!std::getline(before, line)) line = "nothing";
    if (compared(line) != compared(lines[i]) && ++others <= 20)
      fmt::print("was: {}\nis:  {}\n", line, lines[i]);
  }
  fmt::print("{} of {} calls go another way than before.\n", others, lines.size() - 2);
  if (!same_digits) {
    fmt::print(
        "Mathematical functions have other last digits here: only outcomes and methods are compared, of "
        "which {} may differ.\n",
        most_others);
    return others <= most_others ? 0 : 1;
  }
  if (others > 0) fmt::print("If that is meant: hostile_ways {} --write\n", file);
  return others == 0 ? 0 : 1;
}
