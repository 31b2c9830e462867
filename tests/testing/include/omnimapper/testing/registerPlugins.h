#pragma once

#include <omnimapper/export/registerOutputs.h>
#include <omnimapper/mapper/Features.h>

namespace omnimapper::testing {

/// Registers plugins and classes as the programs do at their start, for tests and benchmarks that map in their own
/// process and link omnimapper::export.
inline void registerPlugins() {
  exports::registerOutputs();
  mapper::loadFeatures();
}

}  // namespace omnimapper::testing
