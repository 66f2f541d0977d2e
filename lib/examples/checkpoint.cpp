#include <avi/solve.hpp>

#include <cstdio>
#include <filesystem>
#include <string>

// A run that is interrupted, here by a bound on its steps, is kept in a file; what goes on from there has the
// same bits as a run that was not interrupted.

int main() {
  const auto henon_heiles = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) + q[0] * q[0] * q[1] -
           q[1] * q[1] * q[1] / 3.0;
  };
  const avi::State<2> start{.q = {0.0, 0.1}, .p = {0.1, 0.0}};
  const std::string file = (std::filesystem::temp_directory_path() / "avi_example.orbit").string();
  const avi::SolveOptions options{.check = false, .checkpoint = file};

  const auto whole = avi::solve(henon_heiles, start, 30000.0, 1e-8, options);
  avi::SolveOptions bounded = options;
  bounded.steps = whole.run.steps / 2;
  const auto half = avi::solve(henon_heiles, start, 30000.0, 1e-8, bounded);
  std::printf("interrupted: %s\n", half.ok() ? "no" : "yes");
  const auto rest = avi::resume<2>(henon_heiles, file, options);
  std::printf("at the end:  %s\n", rest.ok() ? "yes" : "no");
  std::printf("same bits:   %s\n", rest.state == whole.state ? "yes" : "no");
}
