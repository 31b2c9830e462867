#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace omnimapper::mapper {

/// The folder of the features' libraries: `omnimapper` beside the library of the engine that was loaded. Neither the
/// current folder nor a variable of the environment names another one.
std::string featureFolder();

/// Loads from featureFolder() the library of every feature of this build, which registers the feature's plugins, and
/// registers the observation classes. A library that cannot be loaded is left out: whyUnavailable() says so. Does
/// nothing when called again.
void loadFeatures();

/// The feature of the project that a plugin class belongs to, whether it is there or not; empty if it is of none.
std::string_view featureOf(std::string_view plugin_class);

/// Every plugin class of the project's features, those that are not there, too.
std::vector<std::string> pluginsOfFeatures();

/// Half a sentence on why a plugin class of the project is not registered and how to get it; empty for one that is
/// registered, and for a class that is none of the project's.
std::string whyUnavailable(std::string_view plugin_class);

}  // namespace omnimapper::mapper
