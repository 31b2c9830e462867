#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace omnimapper::mapper {

/// The folder of the features' libraries: `omnimapper` beside the library of the engine, wherever that was installed.
/// It depends on no environment variable and not on the current folder.
std::string featureFolder();

/// Loads the library of every feature in featureFolder(), which registers the feature's plugins, and registers the
/// observation classes. A library that cannot be loaded is left out: whyUnavailable() says so. Does nothing when called
/// again.
void loadFeatures();

/// Half a sentence on why a plugin class of the project is not registered and how to get it; empty for one that is
/// registered, and for a class that is none of the project's.
std::string whyUnavailable(std::string_view plugin_class);

}  // namespace omnimapper::mapper
