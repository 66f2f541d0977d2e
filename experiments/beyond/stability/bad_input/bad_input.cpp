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
               struct Tally {
                 long inputs = 0, refused = 0, taken = 0;
               };
               std::map<std::string, Tally> tally;
               for (std::size_t i = 0; i < table.rows.size(); ++i) {
                 Tally& n = tally[table.text(i, "part")];
                 ++n.inputs;
                 n.refused += table.text(i, "ending") == "refused";
                 n.taken += table.text(i, "ending") == "taken";
               }
               experiment::Table counts = frame.table({"part", "inputs", "refused", "taken", "named"});
               for (const auto& [part, n] : tally)
                 counts.row(part, n.inputs, n.refused, n.taken, n.inputs - n.refused - n.taken);
               table.note("ending",
                          "refused with that sentence; or, where only the run can find it out, its outcome");
               frame.write(counts, "counts");
               table.note("inputs", table.rows.size());
               frame.write(table);
             });
}
