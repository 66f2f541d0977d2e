#include "beyond/stability/bad_input/tries.hpp"
#include "common/frame.hpp"

#include <map>

// Every entry point of the library against arguments that it cannot use: what was tried, and what it
// answered. Those of HTVI itself are in tests/stability/bad_htvi_input_test.cpp, those of the programs in
// tests/reproduction/front_door_test.cpp.

int main(int argc, char** argv) {
  using namespace experiment;
  return run(argc, argv, "bad_input", "Arguments that no entry point can use, and what each answered",
             [&](Frame& frame) {
               experiment::Table table = frame.table({"part", "argument", "value", "ending", "sentence"});
               Tries tries(table);
               try_optimisation(tries);
               try_dynamics(tries);
               try_problems(tries);
               std::map<std::string, std::pair<long, long>> tally;
               for (std::size_t i = 0; i < table.rows.size(); ++i) {
                 auto& [inputs, refused] = tally[table.text(i, "part")];
                 ++inputs;
                 refused += table.text(i, "ending") == "refused";
               }
               experiment::Table counts = frame.table({"part", "inputs", "refused", "taken"});
               for (const auto& [part, n] : tally)
                 counts.row(part, n.first, n.second, n.first - n.second);
               frame.write(counts, "counts");
               table.note("inputs", table.rows.size());
               frame.write(table);
             });
}
