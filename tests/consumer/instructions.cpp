// A part of a program: compiled with several -m options, its packs must not share a function
// (instructions.sh).
#include <avi/autodiff/dual_number.hpp>
#include <avi/autodiff/pack.hpp>
#include <avi/autodiff/recording.hpp>
#include <avi/optim/sweep.hpp>

double part(double x) {
  const auto f = [](const auto& y) {
    return sin(y[0]) * pow(y[0], 1.5) + min(y[0], exp(y[0])) / atan2(y[0], y[1]);
  };
  const avi::Program program = avi::Recording(f, 2).value_and_gradient();
  avi::Program::Room<avi::Pack<8>> room(program);
  room.arguments()[0] = room.arguments()[1] = avi::Pack<8>(x);
  program.run(room);
  const avi::Vector<avi::DualNumber<2>, 2> lanes(avi::DualNumber<2>::variable(x, 0),
                                                 avi::DualNumber<2>::variable(x, 1));
  double numbers[9] = {};
  const auto sums = avi::sweep<1>(9, [&](auto at, auto& sum) {
    at.set(numbers, at(numbers) + x);
    sum[0] += at(numbers);
  });
  return avi::sum(program.slope(room, 0)) + f(lanes).partial(0) + sums[0];
}
