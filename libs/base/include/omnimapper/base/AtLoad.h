#pragma once

namespace omnimapper::base {

/// An object of this type at namespace scope calls a function when its library or program is loaded. Objects of one
/// file are made from top to bottom, so it belongs below IMPLEMENTS_MRPT_OBJECT. MRPT_INITIALIZER is no substitute:
/// compiled by clang, it runs before the ids of the classes are made.
struct AtLoad {
  explicit AtLoad(void (*function)()) { function(); }
};

}  // namespace omnimapper::base
