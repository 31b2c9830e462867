#include "LogFiles.h"

#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
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

bool isNameOfLog(const std::string& name) {
  return isNameOfRos2(name) || endsWith(name, ".bag") || endsWith(name, ".rawlog");
}

// Whether a compressed file is named as one of ROS: x.bag.zst, x.mcap.zstd.
bool isNameOfPackedRos(const std::string& name) {
  for (const std::string packing : {".zst", ".zstd"})
    for (const char* ending : {".bag", ".db3", ".mcap"})
      if (endsWith(name, ending + packing)) return true;
  return false;
}

std::vector<std::string> logsIn(const source::LogLook& folder) {
  std::vector<std::string> names;
  std::copy_if(folder.entries.begin(), folder.entries.end(), std::back_inserter(names), isNameOfLog);
  return names;
}

// Whether the names are those of the parts of one log of ROS 2: one file, or NAME_0.db3, NAME_1.db3 and so on.
bool areOfOneLog(const std::vector<std::string>& names) {
  std::set<std::string> parts, logs;
  for (const auto& name : names) {
    if (!isNameOfRos2(name)) return false;
    fs::path without_ending = fs::path(name).stem();  // of x.db3.zstd it is x.db3
    if (isNameOfRos2(without_ending.string())) without_ending = without_ending.stem();
    const std::string part = without_ending.string();
    const std::size_t number = part.find_last_not_of("0123456789");
    const bool is_numbered = number != std::string::npos && number + 1 < part.size() && part[number] == '_';
    logs.insert(is_numbered ? part.substr(0, number) : part);
    parts.insert(part);
  }
  return parts.size() == names.size() && logs.size() == 1;
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
         (isZstd(head) && isNameOfPackedRos(look.path));
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
  const auto logs = logsIn(look);
  const bool is_listed = !present.empty();
  if (!is_listed && logs.size() > 1 && !areOfOneLog(logs))
    source::refuse(path, "holds several logs: " + base::option_text::format(logs) +
                             "; name the file that is to be read. Only files that a metadata.yaml lists, or that are "
                             "called NAME_0.db3, NAME_1.db3 and so on, are read as one log");
  for (const auto& name : logs) {
    const std::string file = (fs::path(path) / name).string();
    if (!is_listed && isNameOfRos2(name))
      present.push_back(file);
    else if (std::find(present.begin(), present.end(), file) == present.end())
      left_out.push_back(file);
  }
  if (present.empty()) source::refuse(path, "is a folder without a .db3 or .mcap file of ROS 2");
}

}  // namespace omnimapper::ros
