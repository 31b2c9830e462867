#include "ShippedInis.h"

#include <filesystem>
#include <system_error>

namespace omnimapper::program {

namespace fs = std::filesystem;

namespace {

// Folders of INIs that came with the program: of an installation, or of the checkout whose build this is.
std::vector<fs::path> shippedFolders() {
  std::error_code error;
  const fs::path bin = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error || bin.empty()) return {};
  if (fs::exists(bin.parent_path() / "CMakeCache.txt", error)) return {bin / "../../../ini", bin / "../../../rawlogs"};
  return {bin / "../share/omnimapper/ini", bin / "../share/omnimapper/rawlogs"};
}

}  // namespace

std::vector<std::string> findInis(const std::vector<std::string>& names) {
  std::error_code error;
  std::vector<std::string> paths;
  for (const auto& name : names) {
    paths.push_back(name);
    if (fs::path(name).has_parent_path() || fs::exists(name, error)) continue;
    for (const auto& folder : shippedFolders()) {
      if (!fs::is_regular_file(folder / name, error)) continue;
      paths.back() = (folder / name).lexically_normal();
      break;
    }
  }
  return paths;
}

}  // namespace omnimapper::program
