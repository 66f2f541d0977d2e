// error: avi must be compiled without -ffast-math (-Ofast, -ffinite-math-only): it could not see infinite or
#undef __FINITE_MATH_ONLY__
#define __FINITE_MATH_ONLY__ 1  // as -ffast-math does
#include <avi/core/outcome.hpp>

int main() { return static_cast<int>(avi::Outcome::ok); }
