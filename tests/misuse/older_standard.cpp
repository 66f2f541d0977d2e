// error: avi needs C++20: compile it with -std=c++20, or a newer standard.
#undef __cplusplus
#define __cplusplus 201703L  // as -std=c++17 does
#include <avi/solve.hpp>

int main() {}
