#include "beyond/speed/work_precision/peers/peers.hpp"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>

namespace experiment::work_precision {
namespace {

int field(double t, N_Vector y, N_Vector f, void* self) {
  auto& task = *static_cast<Task*>(self);
  return task.equations.field(t, N_VGetArrayPointer(y), N_VGetArrayPointer(f), &task.f);
}

/// An error handler that prints nothing: a failed run is an outcome here, not a message.
void silent(int, const char*, const char*, char*, void*) {}

/// The objects needed by both solvers, released at the end.
struct Workspace {
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  SUNNonlinearSolver solver = nullptr;
  void* memory = nullptr;
  void (*release)(void**) = nullptr;

  explicit Workspace(const Task& task) {
    SUNContext_Create(nullptr, &context);
    y = N_VNew_Serial(static_cast<long>(task.y.size()), context);
    std::copy(task.y.begin(), task.y.end(), N_VGetArrayPointer(y));
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  ~Workspace() {
    if (memory) release(&memory);
    if (solver) SUNNonlinSolFree(solver);
    N_VDestroy(y);
    SUNContext_Free(&context);
  }
};

/// Takes single steps up to the horizon. @param advance CVode or ERKStepEvolve
bool drive(const Workspace& space, Task& task, auto advance, int one_step) {
  const double* values = N_VGetArrayPointer(space.y);
  double t = 0.0;
  while (t < task.equations.horizon)
    if (advance(space.memory, task.equations.horizon, space.y, &t, one_step) < 0 || !task.stepped(values))
      return false;
  std::copy(values, values + task.y.size(), task.y.begin());
  return true;
}

bool adams(Task& task) {
  Workspace space(task);
  space.memory = CVodeCreate(CV_ADAMS, space.context);
  space.release = &CVodeFree;
  CVodeInit(space.memory, &field, 0.0, space.y);
  CVodeSStolerances(space.memory, task.tolerance, task.tolerance);
  CVodeSetErrHandlerFn(space.memory, &silent, nullptr);
  CVodeSetUserData(space.memory, &task);
  CVodeSetMaxNumSteps(space.memory, task.step_cap);
  CVodeSetStopTime(space.memory, task.equations.horizon);
  space.solver = SUNNonlinSol_FixedPoint(space.y, 0, space.context);
  CVodeSetNonlinearSolver(space.memory, space.solver);
  return drive(space, task, &CVode, CV_ONE_STEP);
}

bool explicit_runge_kutta(Task& task) {
  Workspace space(task);
  space.memory = ERKStepCreate(&field, 0.0, space.y, space.context);
  space.release = &ERKStepFree;
  ERKStepSStolerances(space.memory, task.tolerance, task.tolerance);
  ERKStepSetTableNum(space.memory, ARKODE_FEHLBERG_13_7_8);
  ERKStepSetErrHandlerFn(space.memory, &silent, nullptr);
  ERKStepSetUserData(space.memory, &task);
  ERKStepSetMaxNumSteps(space.memory, task.step_cap);
  ERKStepSetStopTime(space.memory, task.equations.horizon);
  return drive(space, task, &ERKStepEvolve, ARK_ONE_STEP);
}

}  // namespace

void add_sundials(Scene& scene, const Equations& equations) {
  scene.families.push_back(peer(equations, "sundials_adams", 12, &adams));
  scene.families.push_back(peer(equations, "sundials_erk8", 8, &explicit_runge_kutta));
}

}  // namespace experiment::work_precision
