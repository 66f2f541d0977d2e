#include "common/frame.hpp"

// main() of every experiment; its folder's CMakeLists.txt says what it shows and which longer run it knows.

int main(int argc, char** argv) {
  bool longer = false;
  std::vector<experiment::Option> options;
#ifdef AVI_LONGER
  options.push_back({AVI_LONGER, &longer, AVI_LONGER_TEXT});
#endif
  return experiment::run(argc, argv, AVI_SHOWS, options, [&](experiment::Frame& frame) {
    frame.longer = longer;
    experiment::conduct(frame);
  });
}
