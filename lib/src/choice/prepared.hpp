#pragma once
#include "src/choice/candidates.hpp"

#include <algorithm>
#include <memory>
#include <string>

/// @file
/// Programs and formulas that are made of H once, for a whole call and for all runs of a Solver.

namespace avi::detail {

/// The field of H and the formulas of the monitor that was chosen.
struct Prepared {
  PointField field;                          ///< Field of H, forwards in time; each run copies it.
  std::shared_ptr<const Formulas> formulas;  ///< Formulas with two parameters, see EnergyAtStart, or none.

  /// The formulas for an orbit of this energy. @param kinetic see Choice
  [[nodiscard]] std::shared_ptr<const Formulas> formulas_at(double energy, double kinetic) const {
    return formulas->parameters.empty() ? formulas
                                        : formulas->with(EnergyAtStart::parameters(energy, kinetic));
  }
};

/// The monitor of this name, outside the menu, with prepared formulas or with its own. @param prepared the
/// prepared formulas, or null @param constants those of the monitors
inline Candidate candidate_of(const std::string& name, const OrbitQuestion& question, double energy,
                              const Choice& constants, const Prepared* prepared) {
  return prepared ? candidate(name, question, prepared->formulas_at(energy, constants.kinetic))
                  : candidate(name, question, energy, constants);
}

/// The start, (q, p) as one vector.
inline VectorX stacked_start(const OrbitQuestion& question) {
  VectorX z(static_cast<Eigen::Index>(2 * question.q.size()));
  std::ranges::copy(question.p, std::ranges::copy(question.q, z.data()).out);
  return z;
}

/// The field of H, copied from the prepared one if there is one.
inline PointField field_of(const OrbitQuestion& question) {
  PointField field = question.prepared ? question.prepared->field
                                       : PointField(question.graph, question.energy, question.gradient);
  field.timed = question.timed;
  field.switches = question.switches;
  field.has_kinks = question.kinks != nullptr;
  if (question.barriers) field.barriers = *question.barriers;
  return field;
}

}  // namespace avi::detail
