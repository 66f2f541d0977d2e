#pragma once
#include "avi/core/ensemble.hpp"
#include "avi/solve.hpp"

#include <cstddef>
#include <exception>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Solver: many orbits of one H, all with one choice of monitor, order and step.

namespace avi {

/// One orbit computed by Solver::ensemble().
template <int n>
struct SolverMember {
  /// The orbit; its outcome is stopped, with the message of the exception, where one was thrown.
  Solution<n> solution;
  std::exception_ptr error = {};  ///< The exception that was thrown, if any.

  /// True where the orbit reached its end.
  [[nodiscard]] bool ok() const { return solution.ok(); }
};

/// Integrates many orbits of one H, all by the same method. The monitor, order and step are chosen once, as
/// solve() would for a sample orbit; this choice takes a good part of the time of a short solve(). Several
/// threads may use one Solver at once.
template <int n>
class Solver {
 public:
  /// Makes the choice for the orbit from `start` to `t_end`. The runs should have similar starts and lengths.
  /// @param options for all runs; with SolveOptions::check each run is compared with one of a longer step,
  /// which makes it 1.8 times as expensive; without it the error of a run remains unknown
  /// @throws std::invalid_argument as solve(), and where nothing could be chosen.
  template <class H>
  Solver(const H& hamiltonian, const State<n>& start, double t_end, double tolerance,
         const SolveOptions& options = {})
      : question_(detail::question_of(hamiltonian, start, t_end, tolerance, options)),
        sample_(detail::choose_for(question_)) {}

  /// The choice used by all runs.
  [[nodiscard]] const Choice& choice() const { return sample_.choice; }
  /// The report on the sample orbit for which the choice was made.
  [[nodiscard]] const SolutionReport& sample() const { return sample_; }

  ///@{

  /// The orbit from `start` to the time t_end, or with the states at several times; see solve().
  /// @throws std::invalid_argument as solve(), and for a start of another dimension.
  [[nodiscard]] Solution<n> run(const State<n>& start, double t_end) const {
    return run(start, t_end, {}, {});
  }
  [[nodiscard]] Solution<n> run(const State<n>& start, const std::vector<double>& times) const {
    detail::require_times(start.t, times);
    return run(start, times.back(), times, {});
  }
  ///@}
  ///@{

  /// The orbits from all starts, computed on several threads. The results are the same to the last bit for
  /// any number of threads. A run that throws ends as Outcome::stopped with the message of the exception, and
  /// the other runs continue. After settings.cancel is requested, runs end as stopped within a twentieth of a
  /// second. SolveOptions::progress is not called.
  /// @throws std::invalid_argument for a negative number of threads, improper times, or a Solver with
  /// SolveOptions::checkpoint, because that file holds one run only; and whatever settings.progress throws.
  [[nodiscard]] std::vector<SolverMember<n>> ensemble(const std::vector<State<n>>& starts, double t_end,
                                                      const EnsembleSettings& settings = {}) const {
    return all(starts, t_end, {}, settings);
  }
  [[nodiscard]] std::vector<SolverMember<n>> ensemble(const std::vector<State<n>>& starts,
                                                      const std::vector<double>& times,
                                                      const EnsembleSettings& settings = {}) const {
    require(!times.empty(), "Number of output times", times.size(), "at least 1");
    detail::require_times(times.front(), times);
    return all(starts, times.back(), times, settings);
  }
  ///@}

 private:
  Solution<n> run(const State<n>& start, double t_end, const std::vector<double>& times,
                  std::function<bool(const SolveProgress&)> progress) const {
    require_dimension(start);
    const auto count = start.q.size();
    require(static_cast<std::size_t>(count) == question_.q.size(), "Dimension of the start", count,
            "that of the Solver, ", question_.q.size());
    detail::OrbitQuestion question = question_;
    question.q.assign(start.q.data(), start.q.data() + count);
    question.p.assign(start.p.data(), start.p.data() + count);
    question.t = start.t;
    question.t_end = t_end;
    question.times = times;
    if (progress) question.options.progress = std::move(progress);
    return detail::solution_of<n>(detail::answer(std::move(question)), static_cast<int>(count));
  }

  std::vector<SolverMember<n>> all(const std::vector<State<n>>& starts, double t_end,
                                   const std::vector<double>& times, const EnsembleSettings& settings) const {
    require(settings.threads >= 0, "Number of threads", settings.threads, "at least 0");
    require(question_.options.checkpoint.empty(), "Checkpoint of an ensemble", question_.options.checkpoint,
            "empty, for a file holds one run");
    std::vector<SolverMember<n>> members;
    members.reserve(starts.size());
    for (const State<n>& start : starts)
      members.push_back({Solution<n>{SolutionReport{}, start}});
    const auto follow = [&](std::size_t i) {
      if (!times.empty()) detail::require_times(starts[i].t, times);
      Solution<n>& solution = members[i].solution;
      bool cancelled = false;
      solution = run(starts[i], t_end, times,
                     [&](const SolveProgress&) { return !(cancelled = settings.cancel.stop_requested()); });
      if (cancelled) solution.run.message = "The ensemble was cancelled during this run.";
    };
    const auto fail = [&](std::size_t i, std::string sentence, std::exception_ptr error) {
      Solution<n>& solution = members[i].solution;
      solution.run.outcome = Outcome::stopped;
      solution.run.message = std::move(sentence);
      solution.state_error = std::numeric_limits<double>::infinity();
      solution.state.q.setConstant(std::numeric_limits<double>::quiet_NaN());
      solution.state.p.setConstant(std::numeric_limits<double>::quiet_NaN());
      members[i].error = std::move(error);
    };
    detail::share_out(starts.size(), settings, follow, fail);
    return members;
  }

  detail::OrbitQuestion question_;
  SolutionReport sample_;
};
/// Deduces n in Solver solver(H, start, t_end, tolerance).
template <class H, int n, class... More>
Solver(const H&, const State<n>&, double, double, const More&...) -> Solver<n>;

}  // namespace avi
