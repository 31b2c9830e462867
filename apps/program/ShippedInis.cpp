#include "ShippedInis.h"

#include <filesystem>
#include <system_error>

namespace omnimapper::program {

std::vector<std::string> findInis(const std::vector<std::string>& names) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path bin = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<std::string> paths;
  for (const auto& name : names) {
    paths.push_back(name);
    if (fs::path(name).has_parent_path() || fs::exists(name, error)) continue;
    for (const char* beside :
         {"../share/omnimapper/ini", "../share/omnimapper/rawlogs", "../../../ini", "../../../rawlogs"}) {
      const fs::path shipped = (bin / beside / name).lexically_normal();
      if (!fs::is_regular_file(shipped, error)) continue;
      paths.back() = shipped;
      break;
    }
  }
  return paths;
}

}  // namespace omnimapper::program
