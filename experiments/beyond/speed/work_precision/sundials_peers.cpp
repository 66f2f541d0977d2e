#include "beyond/speed/work_precision/peer.hpp"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>

namespace experiment::work_precision {
namespace {

template <class P>
int field(double, N_Vector y, N_Vector f, void* self) {
  (*static_cast<FirstOrder<P>*>(self))(N_VGetArrayPointer(y), N_VGetArrayPointer(f));
  return 0;
}

/// A run that fails is an outcome here, not a message.
void silent(int, const char*, const char*, char*, void*) {}

/// What both solvers need, freed at the end.
struct Workspace {
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  SUNNonlinearSolver solver = nullptr;
  void* memory = nullptr;
  void (*release)(void**) = nullptr;

  explicit Workspace(long size) {
    SUNContext_Create(nullptr, &context);
    y = N_VNew_Serial(size, context);
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

/// Steps one at a time up to the horizon; `advance` is CVode or ERKStepEvolve.
template <class P, class Advance, class Watch>
PeerEnd drive(const Workspace& space, FirstOrder<P>& system, std::span<double> y, double t, double horizon,
              Advance advance, int one_step, long step_cap, Watch&& watch) {
  double* values = N_VGetArrayPointer(space.y);
  PeerEnd end;
  while (t < horizon) {
    if (advance(space.memory, horizon, space.y, &t, one_step) < 0 || ++end.steps > step_cap) return end;
    watch(std::span<const double>(values, y.size()));
  }
  std::copy(values, values + y.size(), y.begin());
  end.evaluations = system.evaluations;
  end.ok = true;
  return end;
}

template <class P>
Family adams(const Arena<P>& arena) {
  return peer(arena, "sundials_adams", 12, [](const P& problem, double tolerance, long step_cap) {
    return [=](std::span<double> y, double t, double horizon, auto&& watch) {
      FirstOrder<P> system(problem);
      Workspace space(static_cast<long>(y.size()));
      std::copy(y.begin(), y.end(), N_VGetArrayPointer(space.y));
      space.memory = CVodeCreate(CV_ADAMS, space.context);
      space.release = &CVodeFree;
      CVodeInit(space.memory, &field<P>, t, space.y);
      CVodeSStolerances(space.memory, tolerance, tolerance);
      CVodeSetErrHandlerFn(space.memory, &silent, nullptr);
      CVodeSetUserData(space.memory, &system);
      CVodeSetMaxNumSteps(space.memory, step_cap);
      CVodeSetStopTime(space.memory, horizon);
      space.solver = SUNNonlinSol_FixedPoint(space.y, 0, space.context);
      CVodeSetNonlinearSolver(space.memory, space.solver);
      return drive(space, system, y, t, horizon, &CVode, CV_ONE_STEP, step_cap, watch);
    };
  });
}

template <class P>
Family explicit_runge_kutta(const Arena<P>& arena) {
  return peer(arena, "sundials_erk8", 8, [](const P& problem, double tolerance, long step_cap) {
    return [=](std::span<double> y, double t, double horizon, auto&& watch) {
      FirstOrder<P> system(problem);
      Workspace space(static_cast<long>(y.size()));
      std::copy(y.begin(), y.end(), N_VGetArrayPointer(space.y));
      space.memory = ERKStepCreate(&field<P>, t, space.y, space.context);
      space.release = &ERKStepFree;
      ERKStepSStolerances(space.memory, tolerance, tolerance);
      ERKStepSetTableNum(space.memory, ARKODE_FEHLBERG_13_7_8);
      ERKStepSetErrHandlerFn(space.memory, &silent, nullptr);
      ERKStepSetUserData(space.memory, &system);
      ERKStepSetMaxNumSteps(space.memory, step_cap);
      ERKStepSetStopTime(space.memory, horizon);
      return drive(space, system, y, t, horizon, &ERKStepEvolve, ARK_ONE_STEP, step_cap, watch);
    };
  });
}

}  // namespace

template <class A>
void add_sundials(Scene& scene, const A& arena) {
  scene.families.push_back(adams(arena));
  scene.families.push_back(explicit_runge_kutta(arena));
}

template void add_sundials(Scene&, const KeplerArena&);
template void add_sundials(Scene&, const PerturbedArena&);
template void add_sundials(Scene&, const HenonArena&);
template void add_sundials(Scene&, const EightArena&);
template void add_sundials(Scene&, const ClusterArena&);
template void add_sundials(Scene&, const ChainArena&);

}  // namespace experiment::work_precision
