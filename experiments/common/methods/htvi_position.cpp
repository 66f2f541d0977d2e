#include "common/methods/methods.hpp"

#include "avi/htvi/htvi.hpp"
#include "avi/problems/kepler.hpp"

namespace experiment {

Runner htvi(int r, PositionMonitor monitor) {
  return Runner(avi::Kepler{}, [=](const State2& start) {
    PositionMonitor own = monitor;
    own.energy = avi::Kepler{}(start.q, start.p);
    return avi::htvi_of_order<avi::Generating::type2>(r, avi::poincare<2>(avi::Kepler{}, start, own),
                                                      avi::gauss((r + 2) / 2));
  });
}

}  // namespace experiment
