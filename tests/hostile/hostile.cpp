#include "hostile/judge.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>

/// @file
/// The front door's promise, tried on systems drawn at random: what is said to be right is right, the rest is
/// said.

namespace {

using namespace hostile;

struct Line {
  int index;
  System system;
  double tolerance;
  Answer answer;
  Judgement judgement;
};

struct Options {
  int systems = 1000;
  std::uint64_t seed = 1;
  std::vector<double> tolerances{1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  double seconds = 10.0;
  double longest = 300.0;
  double work = 4e8;
  int first = 0;
  int only = -1;
  double spoil = 0.0;
  std::string family, output;
  bool quiet = false;
};

constexpr int kinds = static_cast<int>(Verdict::count);
using Counts = std::array<int, kinds>;

void table(const std::string& title, const std::map<std::string, Counts>& rows) {
  fmt::print("\n{:<18}", title);
  for (int i = 0; i < kinds; ++i)
    fmt::print("{:>13}", name(static_cast<Verdict>(i)));
  for (const auto& [row, counts] : rows) {
    fmt::print("\n{:<18}", row);
    for (const int count : counts)
      fmt::print("{:>13}", count == 0 ? "." : std::to_string(count));
  }
  fmt::print("\n");
}

std::string entry_name(const Line& line) {
  const int n = line.system.n, i = line.judgement.entry;
  return i < n ? fmt::format("q[{}]", i) : fmt::format("p[{}]", i - n);
}

void describe(const Line& line, std::uint64_t seed) {
  const Judgement& found = line.judgement;
  const Answer& answer = line.answer;
  fmt::print("{:<12} --seed {} --only {}: {}, n = {}, {}\n             tolerance {:.0e}: {}{}, says state "
             "{:.1e}, energy {:.1e}; "
             "true {:.1e} in {} (rounding {:.1e}), norm {:.1e}; {} steps, {:.2f} s{}{}\n",
             name(found.verdict), seed, line.index, line.system.family, line.system.n, line.system.note,
             line.tolerance, answer.outcome, answer.kept ? ", kept" : "", answer.state_error,
             answer.energy_error, found.error, entry_name(line), found.rounding, found.norm, answer.steps,
             answer.seconds, answer.message.empty() ? "" : "; ", answer.message);
}

void show(const System& system) {
  fmt::print("{}, n = {}, {}\nt = {:.17g} to {:.17g}, action {:.17g}, energy {:.17g}\n", system.family,
             system.n, system.note, system.t, system.t_end, system.action, system.energy);
  fmt::print("q = {:.17g}\np = {:.17g}\nc = {:.17g}\nk = {}\nunit = {:.17g}\n", fmt::join(system.q, ", "),
             fmt::join(system.p, ", "), fmt::join(system.c, ", "), fmt::join(system.k, ", "),
             fmt::join(system.unit, ", "));
}

// Wrong on purpose, to see that it is noticed.
void spoil(Answer& answer, const Truth& truth, double by) {
  if (by > 0.0 && answer.returned && answer.ok && truth.ending == Ending::solved)
    answer.q[0] += by * static_cast<double>(truth.range[0]) + 2.0 * static_cast<double>(truth.rounding[0]);
}

int go(const Options& options) {
  std::vector<Line> lines;
  std::map<std::string, Counts> by_family, by_tolerance, all;
  std::ofstream tsv;
  if (!options.output.empty()) {
    tsv.open(options.output);
    tsv << "seed\tindex\tfamily\tn\ttolerance\tverdict\treference\toutcome\tkept\tstate_error\tenergy_"
           "error\terror\tblamed\trounding\tnorm\tsteps\t"
           "evaluations\tseconds\tnote\tmessage\n"
        << std::flush;
    if (!tsv) return fmt::print(stderr, "hostile: Cannot write '{}'.\n", options.output), 2;
  }
  double in_reference = 0.0, in_calls = 0.0;
  const int first = options.only >= 0 ? options.only : options.first;
  const int end = options.only >= 0 ? options.only + 1 : options.first + options.systems;
  for (int index = first; index < end; ++index) {
    const System system = draw(options.seed, index, options.longest);
    if (!options.family.empty() && system.family != options.family) continue;
    if (options.only >= 0) show(system);
    const Truth known = truth(system, options.work);
    in_reference += known.seconds;
    if (options.only >= 0 && known.ending != Ending::solved)
      fmt::print("  the reference {}\n",
                 known.ending == Ending::singular ? "meets a singularity" : "would take too long");
    if (options.only >= 0 && known.ending == Ending::solved)
      for (std::size_t i = 0; i < known.end.size(); ++i)
        fmt::print("  {}[{}] ends at {:.17g}, range {:.3g}, doubt {:.1e}, rounding {:.1e} of it\n",
                   i < known.end.size() / 2 ? 'q' : 'p', i % (known.end.size() / 2),
                   static_cast<double>(known.end[i]), static_cast<double>(known.range[i]),
                   static_cast<double>(known.doubt[i] / known.range[i]),
                   static_cast<double>(known.rounding[i] / known.range[i]));
    for (const double tolerance : options.tolerances) {
      Answer answer = call(system, tolerance, options.seconds);
      in_calls += answer.seconds;
      spoil(answer, known, options.spoil);
      const Judgement found = judge(system, known, answer, tolerance, options.seconds);
      const auto verdict = static_cast<std::size_t>(found.verdict);
      for (auto* counts :
           {&by_family[system.family], &by_tolerance[fmt::format("{:.0e}", tolerance)], &all["all"]})
        ++(*counts)[verdict];
      lines.push_back({index, system, tolerance, answer, found});
      if (options.only >= 0) {
        describe(lines.back(), options.seed);
        fmt::print("{}\n", answer.report);
      }
      std::string message = answer.message;
      std::replace(message.begin(), message.end(), '\n', ' ');
      if (tsv.is_open())
        tsv << fmt::format(
                   "{}\t{}\t{}\t{}\t{:.0e}\t{}\t{}\t{}\t{}\t{:.2e}\t{:.2e}\t{:.2e}\t{:.2e}\t{:.2e}\t{:."
                   "2e}\t{}\t{}\t{:.3f}\t{}\t{}\n",
                   options.seed, index, system.family, system.n, tolerance, name(found.verdict),
                   known.ending == Ending::solved     ? "solved"
                   : known.ending == Ending::singular ? "singular"
                                                      : "too long",
                   answer.outcome, answer.kept, answer.state_error, answer.energy_error, found.error,
                   found.blamed, found.rounding, found.norm, answer.steps, answer.evaluations, answer.seconds,
                   system.note, message)
            << std::flush;
    }
    if (!options.quiet && options.only < 0 && ((index + 1) % 10 == 0 || index + 1 == end)) {
      const Counts& so_far = all["all"];
      fmt::print(stderr,
                 "{}/{} systems: {} right, {} wrong, {} refused, {} slow; {:.0f} s in calls, {:.0f} s in the "
                 "reference\n",
                 index + 1, end, so_far[0] + so_far[1], so_far[static_cast<int>(Verdict::wrong)],
                 so_far[static_cast<int>(Verdict::refused)], so_far[static_cast<int>(Verdict::slow)],
                 in_calls, in_reference);
    }
  }

  const auto number = [&](Verdict verdict) { return all["all"][static_cast<std::size_t>(verdict)]; };
  if (options.only < 0) {
    table("family", by_family);
    table("tolerance", by_tolerance);
    table("", all);
    constexpr Verdict worst[] = {Verdict::crash,     Verdict::wrong, Verdict::beyond,
                                 Verdict::told_less, Verdict::slow,  Verdict::refused};
    for (const Verdict verdict : worst) {
      std::vector<const Line*> these;
      for (const Line& line : lines)
        if (line.judgement.verdict == verdict) these.push_back(&line);
      std::stable_sort(these.begin(), these.end(), [](const Line* a, const Line* b) {
        return a->judgement.blamed / a->tolerance > b->judgement.blamed / b->tolerance;
      });
      if (!these.empty())
        fmt::print("\n{}: {}{}\n", name(verdict), these.size(), these.size() > 20 ? ", the worst 20" : "");
      for (std::size_t i = 0; i < std::min<std::size_t>(these.size(), 20); ++i)
        describe(*these[i], options.seed);
    }
    fmt::print("\n{} calls, {:.0f} s; the reference took {:.0f} s\n", lines.size(), in_calls, in_reference);
  }
  if (lines.empty())
    return fmt::print(stderr, "hostile: No system of family '{}' was drawn.\n", options.family), 2;
  if (!tsv) return fmt::print(stderr, "hostile: Cannot write all of '{}'.\n", options.output), 2;
  const double calls = static_cast<double>(lines.size());
  // Who says nothing is never wrong: most of what a reference solves must be promised too.
  const int silent = number(Verdict::shy) + number(Verdict::said) + number(Verdict::told_less);
  int broken = 0;
  for (const Verdict each : {Verdict::wrong, Verdict::beyond, Verdict::unsaid, Verdict::crash, Verdict::slow})
    broken += number(each);
  const bool held = broken == 0 && number(Verdict::refused) <= 0.01 * calls && silent <= 0.1 * calls;
  return held ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Orbits of systems drawn at random: what avi::solve says, and what is true.");
  app.add_option("--systems", options.systems, "How many systems are drawn")->check(CLI::Range(1, 1000000));
  app.add_option("--seed", options.seed, "Of the draw");
  app.add_option("--tolerances", options.tolerances, "Each system is solved at all of them")->delimiter(',');
  app.add_option("--seconds", options.seconds, "Of the processor, after which a call is stopped")
      ->check(CLI::Range(1.0, 1e4));
  app.add_option("--longest", options.longest, "Length of the runs, in characteristic times")
      ->check(CLI::Range(0.3, 1e6));
  app.add_option("--work", options.work, "Operations of a run of the reference");
  app.add_option("--first", options.first, "Number of the first of them")->check(CLI::Range(0, 100000000));
  app.add_option("--only", options.only, "This system of the draw alone, with all that is known about it");
  app.add_option("--family", options.family, "Systems of this family alone");
  app.add_option("--spoil", options.spoil,
                 "Makes each answer wrong by this part of the range, to see that it is noticed");
  app.add_option("--output", options.output, "A file that gets a line for each call");
  app.add_flag("--quiet", options.quiet, "No progress");
  CLI11_PARSE(app, argc, argv);
  return go(options);
}
