#include "common/methods/methods.hpp"

#include "avi/htvi/htvi.hpp"
#include "avi/problems/henon_heiles.hpp"

namespace experiment {

Runner htvi_henon_heiles(int r) {
  return Runner(avi::HenonHeiles{}, [=](const State2& start) {
    return avi::htvi_of_order<avi::Generating::type2>(r, avi::poincare<2>(avi::HenonHeiles{}, start),
                                                      avi::gauss((r + 2) / 2));
  });
}

}  // namespace experiment
