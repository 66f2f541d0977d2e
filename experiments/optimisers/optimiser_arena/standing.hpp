#pragma once
#include "common/frame.hpp"
#include "optimisers/optimiser_arena/meter.hpp"

#include <map>

/// @file
/// Who wins: means, profiles and losses.

namespace arena {

/// One problem at one tolerance.
struct Instance {
  std::string problem;
  long dimension = 0;
  std::string group;
  double delta = 0.0;
};

/// The results of all methods on all instances, and what is told of them.
class Standing {
 public:
  /// Takes one result; those of one instance follow each other.
  void add(const Instance& instance, const std::string& method, const Passage& passage);

  /// Writes optimiser_arena_summary (means and failures by method), _profiles (performance and data profiles)
  /// and _losses (where minimise_m7 is not the best).
  void write(const experiment::Frame& frame) const;

 private:
  struct Row {
    Instance instance;
    std::map<std::string, Passage> by_method;
  };
  std::vector<Row> rows_;
  std::vector<std::string> methods_;

  [[nodiscard]] static double best(const Row& row);
  void write_summary(const experiment::Frame& frame) const;
  void write_profiles(const experiment::Frame& frame) const;
  void write_losses(const experiment::Frame& frame) const;
};

}  // namespace arena
