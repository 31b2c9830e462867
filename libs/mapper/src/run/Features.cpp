#include <dlfcn.h>
#include <mrpt/system/os.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <system_error>

#include "FeatureIndex.h"

namespace omnimapper::mapper {

namespace fs = std::filesystem;

namespace {

std::string libraryOf(std::string_view feature) {
  return "libomnimapper-" + std::string(feature) + ".so";
}

// The libraries that loadFeatures() found, by file name, each with the loader's error message if it could not be
// loaded.
std::map<std::string, std::string>& foundLibraries() {
  static std::map<std::string, std::string> problem_of;
  return problem_of;
}

void loadAll() {
  obs::registerClasses();
  registerFactoryBases();
  for (const auto& entry : kFeatureIndex) {
    const std::string library = libraryOf(entry.feature);
    const fs::path path = fs::path(featureFolder()) / library;
    std::error_code error;  // a path that cannot be examined counts as missing
    if (!entry.left_out.empty() || foundLibraries().count(library) > 0 || !fs::exists(path, error)) continue;
    std::string problem;
    const bool loaded = mrpt::system::loadPluginModule(path, problem);
    foundLibraries()[library] = loaded ? "" : problem;
  }
}

}  // namespace

std::string featureFolder() {
  Dl_info here;
  if (::dladdr(reinterpret_cast<const void*>(&featureFolder), &here) == 0) return {};
  return (fs::absolute(here.dli_fname).lexically_normal().parent_path() / "omnimapper").string();
}

void loadFeatures() {
  static std::once_flag loaded;
  std::call_once(loaded, loadAll);
}

std::string_view featureOf(std::string_view plugin_class) {
  for (const auto& entry : kFeatureIndex) {
    if (entry.plugin_class == plugin_class) return entry.feature;
  }
  return {};
}

std::vector<std::string> pluginsOfFeatures() {
  std::vector<std::string> plugins;
  for (const auto& entry : kFeatureIndex) plugins.emplace_back(entry.plugin_class);
  return plugins;
}

std::string whyUnavailable(std::string_view plugin_class) {
  for (const auto& entry : kFeatureIndex) {
    if (entry.plugin_class != plugin_class) continue;
    const std::string feature(entry.feature), library = libraryOf(feature);
    const auto found = foundLibraries().find(library);
    if (found != foundLibraries().end() && found->second.empty()) return {};
    const std::string why = "it belongs to the feature '" + feature + "', ";
    if (!entry.left_out.empty()) return why + "which this build leaves out: " + std::string(entry.left_out);
    if (found != foundLibraries().end()) return why + "whose library cannot be loaded: " + found->second;
    return why + "whose library " + library + " is not in " + featureFolder() + ": build or install it";
  }
  return {};
}

}  // namespace omnimapper::mapper
