#include "ShippedInis.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/OptionTable.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "shippedFolder.h"

namespace omnimapper::program {

namespace fs = std::filesystem;

namespace {

// Folders with the INIs of the program: of its installation, or of the checkout that it was built in.
std::vector<fs::path> shippedFolders() {
  std::vector<fs::path> folders;
  for (const char* name : {"ini", "rawlogs"})
    if (const std::string folder = shippedFolder(name); !folder.empty()) folders.emplace_back(folder);
  return folders;
}

/// The names of all these INIs, sorted.
std::vector<std::string> shippedNames() {
  std::error_code error;
  std::vector<std::string> names;
  for (const auto& folder : shippedFolders())
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ".ini") names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// The path of one of these INIs by its name, which may include its folder in the checkout.
std::optional<std::string> shippedPath(const fs::path& name, const std::string& first_folder) {
  const fs::path folder_of_name = name.parent_path();
  if (!folder_of_name.empty() && folder_of_name != "ini" && folder_of_name != "rawlogs") return std::nullopt;
  std::error_code error;
  auto folders = shippedFolders();
  std::stable_partition(folders.begin(), folders.end(),
                        [&](const fs::path& folder) { return folder.filename() == first_folder; });
  for (const auto& folder : folders) {
    if (!folder_of_name.empty() && folder.filename() != folder_of_name) continue;
    const fs::path path = folder / name.filename();
    if (fs::is_regular_file(path, error)) return path.lexically_normal().string();
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> findInis(const std::vector<std::string>& names, const std::string& first_folder) {
  std::error_code error;
  std::vector<std::string> paths;
  for (const auto& name : names) {
    const auto shipped = fs::exists(name, error) ? std::nullopt : shippedPath(name, first_folder);
    paths.push_back(shipped.value_or(name));
    if (shipped || fs::path(name).has_parent_path() || fs::exists(name, error)) continue;
    const auto known = shippedNames();
    if (known.empty()) continue;
    const auto near = base::nearestName(fs::path(name).has_extension() ? name : name + ".ini", known);
    throw base::Error(base::ExitCode::unreadable_input,
                      name + ": there is no such INI file here, and none of that name comes with the program" +
                          (near.empty() ? "." : "; did you mean " + near + "?") + " This program comes with " +
                          base::option_text::format(known));
  }
  return paths;
}

}  // namespace omnimapper::program
