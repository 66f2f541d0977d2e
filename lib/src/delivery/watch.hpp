#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/core/step.hpp"
#include "avi/solve.hpp"
#include "src/choice/candidates.hpp"
#include "src/delivery/dips.hpp"

#include <string>
#include <vector>

/// @file
/// Events inside the steps of a run.

namespace avi::detail {

/// A step that was taken, its method, and the part of it that belongs to the run.
struct Stride {
  OrbitSteps& method;            ///< Method after the step.
  const State<dynamic>& before;  ///< State at the beginning of the step.
  const State<dynamic>& last;    ///< State at the end of the part.
  double h;                      ///< Fictive step, with its sign.
  double part;                   ///< Part of the step that ends at `last`, in (0, 1].
};

/// An event that was found in a step, or why the search failed.
struct Hit {
  State<dynamic> state;           ///< State on g = 0, or beyond it.
  std::size_t index = 0;          ///< Number of the event.
  Outcome outcome = Outcome::ok;  ///< Outcome of the search; unless ok, there is no state.
  std::string reason = {};        ///< Reason for a failure.
};

/// The search for one event, step by step. g is sampled at several points of the collocation polynomial, so
/// that two events in one step are seen, too; steps of the method then find its zero, see Step::locate().
class Watch {
 public:
  /// Begins the search for an event. @param degrees number of degrees of freedom of the states that g is
  /// called with
  Watch(const OrbitEvent& event, int degrees, std::size_t index)
      : formula_{Recording(event.g.graph(), event.g.node()).value()}, rules_(event.rules), degrees_(degrees),
        timed_(event.g.inputs() > 2 * degrees), index_(index) {
    if (rules_.stop && rules_.count == 0) rules_.count = 1;
  }

  /// Adds the events in a step, in the order of time, or the failure that ends the search. Does not count
  /// them. @param first whether the run begins with this step @return evaluations of the field
  long look(const Stride& stride, bool first, std::vector<Hit>& hits);
  /// Counts an event. @return true if the run ends there
  bool take() { return ++memory_.found == rules_.count && rules_.stop; }
  /// Returns true if all events that count have been found.
  [[nodiscard]] bool over() const { return rules_.count > 0 && memory_.found >= rules_.count; }
  /// The memory from step to step, which goes into a checkpoint.
  struct Memory {
    long found = 0;        ///< Number of events counted so far.
    double level = 0.0;    ///< Largest |g| that counts as zero where the run starts.
    bool leaving = false;  ///< Whether g has not left that level yet.
  };
  [[nodiscard]] Memory& memory() { return memory_; }  ///< Memory of this search.

 private:
  double at(const double* q, const double* p, double t);
  double at(const State<dynamic>& z) { return at(z.q.data(), z.p.data(), z.t); }
  double on(const Stride& stride, double part);
  double rounding(const State<dynamic>& z, const State<dynamic>& after);
  [[nodiscard]] bool crosses(double first, double last) const {
    return (first < 0.0 && last >= 0.0 && rules_.direction >= 0) ||
           (first > 0.0 && last <= 0.0 && rules_.direction <= 0);
  }
  static bool is_brief(const Stride& stride);
  void sample(const Stride& stride, bool first);
  bool refine(const Stride& stride, std::size_t soon);
  void add_beside_zeros(const Stride& stride);
  void add_turning_points(const Stride& stride, long& evaluations);
  State<dynamic> between(const State<dynamic>& begin, const State<dynamic>& end);
  Hit locate(const Stride& stride, std::size_t k, long& evaluations, bool& none);

  RecordedFormula<double> formula_;
  EventRules rules_;
  int degrees_;
  bool timed_;
  std::size_t index_;
  Memory memory_;
  bool smooth_ = true;  // g is smooth in the step, see refine()
  double noise_ = 0.0;  // rounding error of g in the step, see rounding()
  std::vector<Sample> samples_;
  VectorX inside_;  // (q, p) in the step
};

}  // namespace avi::detail
