#include "kepler/table.hpp"

int main(int argc, char** argv) {
  return experiment::kepler_table(argc, argv, "kepler_e099", experiment::table2());
}
