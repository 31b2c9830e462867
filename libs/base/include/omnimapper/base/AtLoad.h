#pragma once

namespace omnimapper::base {

/// An object of this type at namespace scope calls a function when its library or program is loaded. Objects of one
/// file are constructed from top to bottom, so where the function registers a class of an observation, this object must
/// be placed below IMPLEMENTS_SERIALIZABLE.
/// MRPT_INITIALIZER cannot replace it: compiled by clang, MRPT_INITIALIZER runs before the class ids are constructed.
struct AtLoad {
  explicit AtLoad(void (*function)()) { function(); }
};

}  // namespace omnimapper::base
