#include <dlfcn.h>
#include <mrpt/system/os.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>

#include "FeatureIndex.h"

namespace omnimapper::mapper {

namespace fs = std::filesystem;

namespace {

std::string libraryOf(std::string_view feature) {
  return "libomnimapper-" + std::string(feature) + ".so";
}

// The libraries that loadFeatures() found, by file name, each with what the loader said if it could not be loaded.
std::map<std::string, std::string>& foundLibraries() {
  static std::map<std::string, std::string> problem_of;
  return problem_of;
}

void loadAll() {
  obs::registerClasses();
  registerFactoryBases();
  std::vector<fs::path> libraries;
  std::error_code error;  // a folder that is not there holds no features
  for (const auto& entry : fs::directory_iterator(featureFolder(), error)) {
    const std::string name = entry.path().filename();
    if (name.rfind("libomnimapper-", 0) == 0 && entry.path().extension() == ".so") libraries.push_back(entry.path());
  }
  std::sort(libraries.begin(), libraries.end());
  for (const auto& library : libraries) {
    std::string problem;
    const bool loaded = mrpt::system::loadPluginModule(library, problem);
    foundLibraries()[library.filename()] = loaded ? "" : problem;
  }
}

}  // namespace

std::string featureFolder() {
  Dl_info here;
  if (::dladdr(reinterpret_cast<const void*>(&featureFolder), &here) == 0) return {};
  return (fs::absolute(here.dli_fname).parent_path() / "omnimapper").string();
}

void loadFeatures() {
  static std::once_flag loaded;
  std::call_once(loaded, loadAll);
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
