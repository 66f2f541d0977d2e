#pragma once
#include "avi/autodiff/recording.hpp"
#include "avi/core/step.hpp"
#include "avi/solve.hpp"
#include "candidates.hpp"
#include "dips.hpp"

#include <string>
#include <vector>

/// @file
/// Events inside the steps of a run.

namespace avi::detail {

/// A step that was taken, by whom, and the part of it that belongs to the run.
struct Stride {
  OrbitSteps& method;            ///< After the step.
  const State<dynamic>& before;  ///< Where it began.
  const State<dynamic>& last;    ///< Where the part ends.
  double h;                      ///< Fictive step, with its sign.
  double part;                   ///< That ends at `last`, in (0, 1].
};

/// An event that was found in a step, or why the search failed.
struct Hit {
  State<dynamic> state;           ///< On g = 0, or beyond it.
  std::size_t index = 0;          ///< Number of the event.
  Outcome outcome = Outcome::ok;  ///< Unless ok, there is no state.
  std::string reason = {};        ///< Then why.
};

/// Follows one event from step to step. It is looked for at several points of the collocation polynomial, so
/// that two events in one step are seen, too; then steps of the method find it, see Step::locate().
class Watch {
 public:
  /// @param degrees n of the states that g is called with
  Watch(const OrbitEvent& event, int degrees, std::size_t index)
      : formula_{Recording(event.g.graph(), event.g.node()).value()}, rules_(event.rules), degrees_(degrees),
        timed_(event.g.inputs() > 2 * degrees), index_(index) {
    if (rules_.stop && rules_.count == 0) rules_.count = 1;
  }

  /// Adds what is in a step, in the order of time, or the failure that ends the search. Counts nothing.
  /// @param first the run begins with this step @return evaluations of the field
  long look(const Stride& stride, bool first, std::vector<Hit>& hits);
  /// One of the events counts. @return the run ends there
  bool take() { return ++memory_.found == rules_.count && rules_.stop; }
  /// All that count have been found.
  [[nodiscard]] bool over() const { return rules_.count > 0 && memory_.found >= rules_.count; }
  /// The memory from step to step, which goes into a checkpoint.
  struct Memory {
    long found = 0;        ///< Events that count.
    double level = 0.0;    ///< |g| that counts as zero where the run starts.
    bool leaving = false;  ///< g has not left it yet.
  };
  [[nodiscard]] Memory& memory() { return memory_; }  ///< See there.

 private:
  double at(const double* q, const double* p, double t);
  double at(const State<dynamic>& z) { return at(z.q.data(), z.p.data(), z.t); }
  double on(const Stride& stride, double part);
  double rounding(const State<dynamic>& z, const State<dynamic>& after);
  [[nodiscard]] bool crosses(double first, double last) const {
    return (first < 0.0 && last >= 0.0 && rules_.direction >= 0) ||
           (first > 0.0 && last <= 0.0 && rules_.direction <= 0);
  }
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
  bool smooth_ = true;  // g in the step, see refine()
  double noise_ = 0.0;  // of g in it, see rounding()
  std::vector<Sample> samples_;
  VectorX inside_;  // (q, p) in the step
};

}  // namespace avi::detail
