#pragma once

#include <omnimapper/export/registerOutputs.h>
#include <omnimapper/mapper/Features.h>

namespace omnimapper::testing {

/// What the programs do when they start, for tests and benchmarks that map in their own process and link
/// omnimapper::export.
inline void registerPlugins() {
  exports::registerOutputs();
  mapper::loadFeatures();
}

}  // namespace omnimapper::testing
