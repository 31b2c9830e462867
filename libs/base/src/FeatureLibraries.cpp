#include <dlfcn.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/FeatureLibraries.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <system_error>

#include "FeatureIndex.h"

namespace omnimapper::base {

namespace fs = std::filesystem;

namespace {

std::string libraryOf(std::string_view feature) {
  return "libomnimapper-" + std::string(feature) + ".so";
}

// The libraries that were found, by file name, each with the loader's error message if it could not be loaded.
struct Found {
  std::mutex mutex;
  std::map<std::string, std::string> problem_of;
};

Found& found() {
  static Found all;
  return all;
}

// Loads the library of an entry, unless it is left out or missing or was loaded. Returns its handle, if it is loaded
// now.
void* load(const OfFeature& entry) {
  const std::string library = libraryOf(entry.feature);
  const fs::path path = fs::path(featureFolder()) / library;
  std::error_code error;  // a path that cannot be examined counts as missing
  if (!entry.left_out.empty() || !fs::exists(path, error)) return nullptr;
  const std::lock_guard lock(found().mutex);
  void* const handle = ::dlopen(path.c_str(), RTLD_LAZY);  // counts only, if it was loaded before
  found().problem_of[library] = handle ? "" : ::dlerror();
  return handle;
}

}  // namespace

std::string featureFolder() {
  Dl_info here;
  if (::dladdr(reinterpret_cast<const void*>(&featureFolder), &here) == 0) return {};
  return (fs::absolute(here.dli_fname).lexically_normal().parent_path() / "omnimapper").string();
}

void loadFeaturesOf(Registered kind) {
  static std::mutex mutex;
  static std::set<Registered> loaded;
  const std::lock_guard lock(mutex);
  if (!loaded.insert(kind).second) return;
  std::set<std::string_view> features;
  for (const auto& entry : kFeatureIndex) {
    if (entry.kind == kind && features.insert(entry.feature).second) load(entry);
  }
}

void* functionOfFeature(const std::string& function, const std::string& what, const std::string& instead) {
  for (const auto& entry : kFeatureIndex) {
    if (entry.kind != Registered::function || entry.name != function) continue;
    void* const handle = load(entry);
    if (void* const address = handle ? ::dlsym(handle, function.c_str()) : nullptr) return address;
  }
  const auto why = whyUnavailable(function);
  throw Error(ExitCode::plugin_library,
              what + ": " + (why.empty() ? "no feature exports " + function : why) + "; or " + instead + ".");
}

std::string_view featureOf(std::string_view name) {
  for (const auto& entry : kFeatureIndex) {
    if (entry.name == name) return entry.feature;
  }
  return {};
}

std::vector<std::string> namesOfFeatures(Registered kind) {
  std::vector<std::string> names;
  for (const auto& entry : kFeatureIndex) {
    if (entry.kind == kind) names.emplace_back(entry.name);
  }
  return names;
}

std::string whyUnavailable(std::string_view name) {
  const std::lock_guard lock(found().mutex);
  const auto& problem_of = found().problem_of;
  for (const auto& entry : kFeatureIndex) {
    if (entry.name != name) continue;
    const std::string feature(entry.feature), library = libraryOf(feature);
    const auto problem = problem_of.find(library);
    if (problem != problem_of.end() && problem->second.empty()) return {};
    const std::string why = "it belongs to the feature '" + feature + "', ";
    if (!entry.left_out.empty()) return why + "which this build leaves out: " + std::string(entry.left_out);
    if (problem != problem_of.end()) return why + "whose library cannot be loaded: " + problem->second;
    return why + "whose library " + library + " is not in " + featureFolder() + ": build or install it";
  }
  return {};
}

}  // namespace omnimapper::base
