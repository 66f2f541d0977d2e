#include "avi/optim/recorded_objective.hpp"

#include "avi/autodiff/recording.hpp"

#include <algorithm>
#include <atomic>

namespace avi {

/// The program of f and its gradient, and memory for one call at a time.
struct RecordedObjective::Work {
  explicit Work(const Formula& f) : program(Recording(f).value_and_gradient()), room(program) {}
  double run(Program::Room<double>& in, const double* x, double* gradient) const {
    std::copy_n(x, program.slopes(), in.arguments());
    program.run(in);
    for (int i = 0; i < program.slopes(); ++i)
      gradient[i] = program.slope(in, i);
    return program.value(in);
  }

  Program program;
  Program::Room<double> room;
  std::atomic<bool> in_use = false;
};

RecordedObjective::RecordedObjective(const Formula& f)
    : work_(std::make_shared<Work>(f.with_constants())), n_(f.inputs()) {}

double RecordedObjective::evaluate(const double* x, double* gradient) const {
  if (work_->in_use.exchange(true, std::memory_order_acquire)) {
    Program::Room<double> room(work_->program);
    return work_->run(room, x, gradient);
  }
  struct Release {
    std::atomic<bool>& flag;
    ~Release() { flag.store(false, std::memory_order_release); }
  } const at_the_end{work_->in_use};
  return work_->run(work_->room, x, gradient);
}

}  // namespace avi
