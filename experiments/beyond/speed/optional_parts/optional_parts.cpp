#include "beyond/speed/optional_parts/parts.hpp"
#include "common/frame.hpp"
#include "common/timing.hpp"

#include <algorithm>

// What every optional part of an HTVI step costs, as a ratio to the same run without it.

int main(int argc, char** argv) {
  using namespace experiment;
  return run(
      argc, argv, "optional_parts", "What every optional part of an HTVI step costs", [](Frame& frame) {
        experiment::Table table = frame.table({"part", "without", "order", "steps", "evaluations_per_step",
                                               "seconds_per_step", "ratio_of_seconds"});
        table.note("problem", "Kepler, e = 0.9, from the pericentre; bounded monitor q^T q");
        table.note("bare",
                   "Type II, stationary, with its Gauss rule, gradient supplied, order chosen at run time");
        table.note("ratio_of_seconds",
                   "time per step over that of the run named in `without`, measured in turns");
        for (const int order : {4, 8}) {
          frame.progress("order " + std::to_string(order), order == 4 ? 0.0 : 0.5);
          std::vector<Part> parts;
          for (auto* list :
               {&parts_of_construction, &parts_of_problem, &parts_of_output, &parts_at_compile_time})
            for (Part& part : list(order))
              parts.push_back(std::move(part));
          std::vector<std::function<void()>> works;
          for (const Part& part : parts)
            works.push_back(part.run);
          const auto seconds = interleaved_least_seconds(works, frame.quick ? 1 : 25);
          // Landings add steps of their own: every run is compared over the same 200.
          const auto per_step = [&](std::size_t i) { return seconds[i] / static_cast<double>(part_steps); };
          for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto bare = std::find_if(parts.begin(), parts.end(),
                                           [&](const Part& other) { return other.name == parts[i].without; });
            table.row(parts[i].name, parts[i].without, order, parts[i].steps,
                      static_cast<double>(parts[i].evaluations) / static_cast<double>(part_steps),
                      experiment::rounded(per_step(i)),
                      experiment::rounded(
                          per_step(i) / per_step(static_cast<std::size_t>(bare - parts.begin())), 4));
          }
        }
        frame.progress("done", 1.0);
        frame.write(table);
      });
}
