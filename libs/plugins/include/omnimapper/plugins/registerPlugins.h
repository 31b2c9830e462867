#pragma once

#include <omnimapper/graph/FactorRegistry.h>

namespace omnimapper::plugins {

/// Registers every plugin class of the project, and the observation classes, with MRPT. May be called twice.
void registerPlugins();

/// Reads back every factor that a plugin of the project puts into a map.
graph::FactorRegistry factorRegistry();

}  // namespace omnimapper::plugins
