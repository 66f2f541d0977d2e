#pragma once
#include "hostile/system.hpp"
#include "hostile/tape.hpp"

#include "common/extrapolation.hpp"

#include <vector>

/// @file
/// The orbit of a system by another way than the library's: extrapolation after Gragg, Bulirsch and Stoer
/// (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.9) in long double, with the
/// gradient of a tape of its own.

namespace hostile {

using Real = long double;
using Vector = std::vector<Real>;

/// How a run of the reference ended.
enum class Ending {
  solved,
  singular,  ///< The steps became too small to go on, or a value infinite.
  too_long   ///< More work than the reference may take.
};

/// An orbit. Vectors hold q, then p.
struct Orbit {
  Ending ending = Ending::solved;
  Vector end;         ///< The last state.
  Vector slope;       ///< Its derivative by t.
  Vector low, high;   ///< Of each entry, over the ends of steps.
  Vector steps;       ///< Their lengths.
  double work = 0.0;  ///< Operations.
};

/// Integrates one system.
class Reference {
 public:
  explicit Reference(const System& system);

  /// From the start, or from another one, with errors of each step below `tolerance` of each entry's range.
  /// @param most operations
  [[nodiscard]] Orbit run(Real tolerance, double most);
  /// With steps given, so that the difference of two runs is that of their starts only. Where `in_double`,
  /// the field is evaluated in double precision.
  [[nodiscard]] Orbit repeat(const Vector& start, const Vector& steps, bool in_double);

  [[nodiscard]] const Vector& start() const { return start_; }   ///< q, then p.
  [[nodiscard]] int operations() const { return tape_.size(); }  ///< Of one evaluation of H.

 private:
  static constexpr int rows = 11;  // order 22

  void field(const Vector& z, Vector& slope);
  [[nodiscard]] Real error(const Vector& z, Real tolerance, const Orbit& orbit) const;
  [[nodiscard]] Real longest(const Orbit& orbit) const;
  void begin(Orbit& orbit, const Vector& start);
  void go_on(Orbit& orbit, Real h);

  Tape tape_;
  int size_;  // 2n
  Vector start_, scale_;
  Vector reach_;  // of each coordinate, n
  Real span_;
  bool in_double_ = false;
  experiment::ExtrapolatedStep<rows, Vector> step_;
  Vector carry_, value_, adjoint_;
  std::vector<double> z_double_, slope_double_, value_double_, adjoint_double_;
};

}  // namespace hostile
