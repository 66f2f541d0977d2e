#pragma once

/// @file
/// The version of the library. In version a.b.c, another b may come with changed interfaces; CHANGELOG.md
/// lists them.

#define AVI_VERSION_MAJOR 0  ///< a of version a.b.c.
#define AVI_VERSION_MINOR 2  ///< b of version a.b.c.
#define AVI_VERSION_PATCH 0  ///< c of version a.b.c.
/// One number to compare with: 10000 a + 100 b + c, so 10203 for 1.2.3.
#define AVI_VERSION (10000 * AVI_VERSION_MAJOR + 100 * AVI_VERSION_MINOR + AVI_VERSION_PATCH)

namespace avi {

/// The version of the compiled library, "a.b.c"; the macros are those of the headers.
const char* version() noexcept;

}  // namespace avi
