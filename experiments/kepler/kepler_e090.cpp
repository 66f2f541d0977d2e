#include "kepler/table.hpp"

int main(int argc, char** argv) {
  return experiment::kepler_table(argc, argv, AVI_SHOWS, experiment::table1());
}
