// The whole library in one inclusion: no two headers contradict each other.
#include <avi/avi.hpp>
