#pragma once
#include "avi/autodiff/recording.hpp"

#include "src/autodiff/machine_code.hpp"

#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

/// @file
/// A transformed problem as programs, so that every Hamiltonian with every monitor is of one type.

namespace avi::detail {

/// The machine code of some programs for several kinds of packs, each made once.
class CodeStore {
 public:
  /// Returns the code for a target, made at the first call; null where none can be made.
  std::shared_ptr<const MachineCode> of(std::span<const Program* const> programs,
                                        const MachineTarget& target) {
    const std::lock_guard lock(mutex_);
    for (const Entry& entry : entries_)
      if (entry.lanes == target.lanes && entry.avx512 == target.avx512) return entry.code;
    entries_.push_back({target.lanes, target.avx512, MachineCode::of(programs, target)});
    return entries_.back().code;
  }

 private:
  struct Entry {
    int lanes;
    bool avx512;
    std::shared_ptr<const MachineCode> code;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

/// The programs of \f$\bar H = g\,(H - H_0)\f$, made once and shared by all methods that run on them. Their
/// arguments are (q, p), then the parameters.
struct Formulas {
  Program forces;                       ///< Program of \f$\partial\bar H/\partial q\f$.
  Program velocities;                   ///< Program of \f$\partial\bar H/\partial p\f$.
  Program rate;                         ///< Program of g; empty where `unit`.
  bool unit = false;                    ///< Whether g = 1.
  Eigen::Index n = 0;                   ///< Number of degrees of freedom.
  std::vector<double> parameters = {};  ///< Values of the parameters.
  /// Machine code of the forces, the velocities and, unless `unit`, the rate, for any values of the
  /// parameters; null if there are too few evaluations for code to pay.
  std::shared_ptr<CodeStore> code = std::make_shared<CodeStore>();

  /// Makes the programs of \f$\bar H\f$ and g, nodes of one graph of (q, p) and so many parameters.
  /// @param energy node of H @param supplied nodes of its gradient, if H supplies its own
  static Formulas of(ExpressionGraph graph, int transformed, int rate, int energy = -1,
                     const std::vector<int>& supplied = {}, int parameters = 0);
  /// Makes the programs of H with g = 1.
  static Formulas fixed(const Recording& recording, int parameters = 0);
  /// The same programs with other values of the parameters.
  [[nodiscard]] std::shared_ptr<const Formulas> with(std::vector<double> values) const {
    Formulas other = *this;
    other.parameters = std::move(values);
    return std::make_shared<const Formulas>(std::move(other));
  }
};

}  // namespace avi::detail
