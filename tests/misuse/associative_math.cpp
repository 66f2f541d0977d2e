// error: avi must be compiled without -fassociative-math (-funsafe-math-optimizations): sums could not keep
#define __ASSOCIATIVE_MATH__ 1  // as g++ does where it is told that flag
#include <avi/core/outcome.hpp>

int main() { return static_cast<int>(avi::Outcome::ok); }
