#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace omnimapper::base {

/// What a feature registers, so that its library must be loaded.
enum class Registered {
  plugin,    ///< a class that an INI names
  format,    ///< a format of logs
  driver,    ///< a class of live sensors
  function,  ///< nothing: it exports the function
};

/// The folder of the features' libraries: `omnimapper` beside this library. The path does not depend on the current
/// folder or on environment variables.
std::string featureFolder();

/// Loads from featureFolder() the library of every feature of this build that registers something of that kind; a
/// library registers its classes as it is loaded. A library that cannot be loaded is skipped, and whyUnavailable()
/// reports it. Further calls do nothing.
void loadFeaturesOf(Registered kind);

/// Loads the feature that exports a function, and returns the function. This is for features that few runs need,
/// because loading is slow; a library that was loaded is never unloaded. Throws Error(plugin_library) if the feature is
/// not available. For the message, `what` says what is not possible then ("Tesseract cannot read"), and `instead` what
/// can be done without it ("leave reader = tesseract out").
void* functionOfFeature(const std::string& function, const std::string& what, const std::string& instead);

/// The feature of the project that a plugin class, a format, a driver or a function belongs to, whether it is available
/// or not; empty if it belongs to none.
std::string_view featureOf(std::string_view name);

/// Everything of that kind that the project's features register, available or not.
std::vector<std::string> namesOfFeatures(Registered kind);

/// A clause that says why a plugin class, a format, a driver or a function of the project is not there, and how to get
/// it. Empty for one whose library is loaded, and for one that does not belong to the project.
std::string whyUnavailable(std::string_view name);

}  // namespace omnimapper::base
