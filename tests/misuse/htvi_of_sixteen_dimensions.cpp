// error: An HTVI carries 2n + 1 partials at a time: n is at most 15; avi::collocation() takes any.
#include <avi/htvi/htvi.hpp>
#include <avi/problems/chain.hpp>

int main() {
  avi::State<16> z{.q = avi::Vector<double, 16>::Zero(), .p = avi::Vector<double, 16>::Ones()};
  auto method = avi::type2<1>(avi::poincare(experiment::Chain{}, z));
  return method.step(z, 0.1).evaluations;
}
