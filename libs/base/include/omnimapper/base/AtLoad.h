#pragma once

namespace omnimapper::base {

/// Calls a function when the library or program is loaded that defines such an object at namespace scope: after what
/// stands above it in its file. MRPT_INITIALIZER does so too early for classes that clang has compiled: their ids are
/// made later.
struct AtLoad {
  explicit AtLoad(void (*function)()) { function(); }
};

}  // namespace omnimapper::base
