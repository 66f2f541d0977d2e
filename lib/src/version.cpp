#include "avi/version.hpp"

#define AVI_TEXT_OF(number) #number
#define AVI_TEXT(number) AVI_TEXT_OF(number)

namespace avi {

const char* version() noexcept {
  return AVI_TEXT(AVI_VERSION_MAJOR) "." AVI_TEXT(AVI_VERSION_MINOR) "." AVI_TEXT(AVI_VERSION_PATCH);
}

}  // namespace avi
