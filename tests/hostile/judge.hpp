#pragma once
#include "hostile/call.hpp"
#include "hostile/reference.hpp"

/// @file
/// What is true about an orbit, and whether an answer keeps what it promises.

namespace hostile {

/// The verdict on one call.
enum class Verdict {
  right,        ///< The promise is given and kept.
  conditioned,  ///< The promise is given, and broken by no more than rounding errors grow to.
  unsaid,  ///< As before, but an entry is off by over 1 % of its range: nobody could do better, nobody says
           ///< so.
  beyond,  ///< The promise is given and broken, but every entry is right to 1 % of its range.
  wrong,   ///< The promise is given and broken: wrong in silence.
  shy,     ///< The promise is not given, though the state is right to ten times the tolerance.
  said,    ///< The promise is not given, and the error that is told instead is true.
  told_less,     ///< The promise is not given, and the error is over a hundred times what is told instead.
  refused,       ///< No state at the end, though the reference has one.
  rightly,       ///< No state at the end, and no reference, or rounding alone is above the tolerance.
  slow,          ///< More than the seconds allowed.
  crash,         ///< Ended by a signal.
  no_reference,  ///< The reference does not know.
  count
};
/// In tables.
const char* name(Verdict verdict);

/// What the reference knows about the end of an orbit. All vectors hold q, then p.
///
/// An entry of an answer may be wrong by 100 tolerance range, and by what rounding errors do to any method
/// in double precision: 100 times what errors of 1e-15 at the start grow to (of the value or of the
/// natural size of its entry, in three random directions), and 10 times the error of a run of the reference
/// that evaluates the field in double precision (extrapolation magnifies the rounding of the field some
/// thirty times).
struct Truth {
  Ending ending = Ending::solved;
  Vector end;       ///< The state.
  Vector range;     ///< Through which each entry moves; at least 1e-8 of its size.
  Vector doubt;     ///< Difference of two runs of the reference with different tolerances.
  Vector rounding;  ///< Error that no method in double precision can be blamed for.
  double seconds = 0.0;

  /// The reference is as good as a tolerance needs.
  [[nodiscard]] bool good_for(double tolerance) const;
};
Truth truth(const System& system, double most_work);

/// Errors and verdict of an answer.
struct Judgement {
  Verdict verdict = Verdict::no_reference;
  double error = 0.0;     ///< Largest of all entries, relative to their ranges.
  int entry = 0;          ///< Which one.
  double blamed = 0.0;    ///< The largest part of an entry's error that rounding does not explain.
  double norm = 0.0;      ///< Error of q or of p as a vector.
  double rounding = 0.0;  ///< Of that entry, relative to its range.
};
Judgement judge(const System& system, const Truth& truth, const Answer& answer, double tolerance,
                double seconds);

}  // namespace hostile
