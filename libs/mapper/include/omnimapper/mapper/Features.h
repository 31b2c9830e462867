#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace omnimapper::mapper {

/// The folder of the features' libraries: `omnimapper` beside the loaded library of the engine. The path does not
/// depend on the current folder or on environment variables.
std::string featureFolder();

/// Registers the observation classes and loads from featureFolder() the library of every feature of this build; a
/// library registers its plugins as it is loaded. A library that cannot be loaded is skipped, and whyUnavailable()
/// reports it. Further calls do nothing.
void loadFeatures();

/// The feature of the project that a plugin class belongs to, whether it is available or not; empty if the class
/// belongs to none.
std::string_view featureOf(std::string_view plugin_class);

/// Every plugin class of the project's features, available or not.
std::vector<std::string> pluginsOfFeatures();

/// A clause that says why a plugin class of the project is not registered and how to get it. Empty for a class that is
/// registered, and for one that does not belong to the project.
std::string whyUnavailable(std::string_view plugin_class);

}  // namespace omnimapper::mapper
