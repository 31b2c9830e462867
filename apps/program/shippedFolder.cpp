#include "shippedFolder.h"

#include <filesystem>
#include <system_error>

namespace omnimapper::program {

namespace fs = std::filesystem;

std::string shippedFolder(const std::string& name) {
  std::error_code error;
  const fs::path bin = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error || bin.empty()) return {};
  const bool is_build = fs::exists(bin.parent_path() / "CMakeCache.txt", error);
  return (bin / (is_build ? fs::path("../../..") : fs::path("../share/omnimapper")) / name).string();
}

}  // namespace omnimapper::program
