#pragma once

namespace omnimapper::plugins {

/// Registers every plugin class of the project, and the observation classes, with MRPT. May be called twice.
void registerPlugins();

}  // namespace omnimapper::plugins
