#pragma once
#include "src/choice/budget.hpp"
#include "src/choice/distance.hpp"
#include "src/choice/journey.hpp"
#include "src/choice/prepared.hpp"
#include "src/features/bends.hpp"
#include "src/features/separable.hpp"

#include <optional>

/// @file
/// An orbit as it looks before any run along it.

namespace avi::detail {

/// Least number of steps of a sketch that is to pass over nothing.
inline constexpr int parts_of_close_sketch = 2048;

/// An orbit as a sketch of it shows it: how fast it moves, in which units its errors are counted, and what it
/// may meet on the way. Constants of the monitors, the unit of energy errors and the rounding error of H go
/// into the answer.
class Overview {
 public:
  /// Records the field of H, and nothing else yet.
  Overview(const OrbitQuestion& question, Budget& budget, OrbitAnswer& answer)
      : field(field_of(question)), sense(question.t_end < question.t ? -1.0 : 1.0),
        span(std::abs(question.t_end - question.t)), question_(question), budget_(budget), answer_(answer) {}

  /// Makes the sketch and finds all that is below, unless it is late() on the way. @param closely with short
  /// steps, as a sketch of longer ones was blind @param also a later state from which the sketch goes on
  /// @throws std::invalid_argument unless H and its slope are finite at the start
  void make(bool closely, const std::optional<State<dynamic>>& also);
  /// Returns true if the time limit of the call was used up by its preparation, which takes long for an H of
  /// very many operations.
  [[nodiscard]] bool late() const;
  /// Sets the unit of energy errors, the rounding error of H in that unit, and the change of H inside a step
  /// that is not taken for an error of the step.
  void take_unit_of_energy(double scale);

  PointField field;                       ///< Field of H.
  double sense, span;                     ///< Direction of time, 1 or -1, and the time to the end.
  std::optional<Trip> trip;               ///< Constants of all runs.
  std::optional<Sketch> sketch;           ///< A run of low accuracy that stands for the orbit.
  std::optional<Bends> bends;             ///< Narrow bends of H.
  VectorX metric;                         ///< Diagonal of H_pp at the start.
  std::optional<Distance> distance;       ///< Distance of two states.
  std::optional<SharpFeatures> features;  ///< Kinks, jumps and poles that the orbit may meet.
  std::optional<NearPasses> passes;       ///< Light bodies that it may pass.
  Resting resting;                        ///< Energies and forces along the sketch with everything at rest.
  Parts parts = Parts::coupled;           ///< How H separates into parts of q and of p.
  double radians = 0.0;                   ///< Phase of the whole orbit.
  double usual_speed = 0.0;               ///< Mean speed over the sketch.
  double high_speed = 0.0;                ///< A speed that the motion may have at the end.

 private:
  double energy_and_slope(const VectorX& start, VectorX& slope);
  void sketch_from(const VectorX& start, bool closely);
  void follow_the_take_off(Eigen::Index seen);
  [[nodiscard]] bool moves(const Sketch::Sample& sample) const;
  void look_at_bends(const VectorX& start);
  VectorX rounding_of_slopes();
  void put_at_rest(Eigen::Index seen, bool& drifting);
  double mean_motion(const Ranges& ranges, Eigen::Index seen);
  void describe_motion(Eigen::Index seen, bool drifting);
  void look_for_features(double scale);

  const OrbitQuestion& question_;
  Budget& budget_;
  OrbitAnswer& answer_;
};

}  // namespace avi::detail
