// error: A time-dependent problem needs its dimension at compile time.
#include <avi/adaptive/time_dependent.hpp>

struct Driven {
  template <class Q, class S, class P>
  S operator()(const Q& q, const S& t, const P& p) const {
    return p[0] * p[0] + q[0] * t;
  }
};

int main() { return static_cast<int>(avi::time_dependent<avi::dynamic>(Driven{}).size()); }
