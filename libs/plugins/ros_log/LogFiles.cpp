#include "LogFiles.h"

#include <omnimapper/base/InputFile.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "BagFile.h"
#include "Db3File.h"
#include "McapFile.h"
#include "decompressed.h"

namespace omnimapper::ros {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMetadata = "metadata.yaml";

bool endsWith(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() && name.substr(name.size() - ending.size()) == ending;
}

bool isNameOfRos2(const std::string& name) {
  for (const char* ending : {".db3", ".mcap", ".db3.zstd", ".mcap.zstd"})
    if (endsWith(name, ending)) return true;
  return false;
}

// The entries of "relative_file_paths:", which are names in the folder itself, also where older versions wrote a path.
std::vector<std::string> listedIn(const fs::path& metadata) {
  std::istringstream lines(base::readInput(metadata.string()));
  std::vector<std::string> names;
  bool is_list = false;
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find_first_not_of(" \t");
    if (first == std::string::npos) continue;
    if (line.compare(first, 2, "- ") != 0) {
      is_list = line.compare(first, 20, "relative_file_paths:") == 0;
      continue;
    }
    if (!is_list) continue;
    std::string name = line.substr(first + 2);
    name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c == '"' || c == '\'' || c == '\r'; }),
               name.end());
    names.push_back(fs::path(name).filename().string());
  }
  return names;
}

}  // namespace

bool looksLikeRos(const source::LogLook& look) {
  if (look.is_folder) return std::any_of(look.entries.begin(), look.entries.end(), isNameOfRos2);
  const std::string head = look.head.substr(0, 64);
  return BagFile::recognizes(head) || McapFile::recognizes(head) || Db3File::recognizes(head) ||
         (isZstd(head) && isNameOfRos2(look.path));
}

LogFiles::LogFiles(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    present.push_back(path);
    return;
  }
  const auto look = source::LogLook::at(path);
  if (look.has(kMetadata)) {
    for (const auto& name : listedIn(fs::path(path) / kMetadata)) {
      const std::string file = (fs::path(path) / name).string();
      // Files that were compressed when they were full are listed under either name.
      const bool is_there = fs::exists(file, error), is_packed = fs::exists(file + ".zstd", error);
      (is_there || is_packed ? present : missing).push_back(is_there || !is_packed ? file : file + ".zstd");
    }
  }
  if (present.empty())
    for (const auto& name : look.entries)
      if (isNameOfRos2(name)) present.push_back((fs::path(path) / name).string());
  if (present.empty()) source::refuse(path, "is a folder without a .db3 or .mcap file of ROS 2");
}

}  // namespace omnimapper::ros
