#include "common/methods/methods.hpp"

#include "avi/collocation/collocation.hpp"
#include "avi/problems/henon_heiles.hpp"
#include "avi/problems/kepler.hpp"
#include "avi/transform/poincare.hpp"

namespace experiment {

Runner collocation(int order, PositionMonitor monitor) {
  return Runner(avi::Kepler{}, [=](const State2& start) {
    PositionMonitor own = monitor;
    own.energy = avi::Kepler{}(start.q, start.p);
    return avi::collocation(avi::poincare<2>(avi::Kepler{}, start, own), order);
  });
}

Runner collocation_henon_heiles(int order) {
  return Runner(avi::HenonHeiles{}, [=](const State2& start) {
    return avi::collocation(avi::poincare<2>(avi::HenonHeiles{}, start), order);
  });
}

}  // namespace experiment
