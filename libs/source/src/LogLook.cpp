#include <omnimapper/source/CompressedFile.h>
#include <omnimapper/source/LogLook.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

namespace omnimapper::source {

namespace fs = std::filesystem;

LogLook LogLook::at(const std::string& path) {
  LogLook look;
  look.path = path;
  std::error_code error;
  look.is_folder = fs::is_directory(path, error);
  if (look.is_folder) {
    fs::directory_iterator entry(path, error);
    for (; !error && entry != fs::directory_iterator() && look.entries.size() < kMostEntries; entry.increment(error))
      look.entries.push_back(entry->path().filename().string());
    if (error) refuse(path, error.message() + "; is the path right?");
    std::sort(look.entries.begin(), look.entries.end());
    return look;
  }
  CompressedFile file(path);
  look.head.resize(kLongestHead);
  look.head.resize(file.read(look.head.data(), look.head.size()));
  look.problem = file.problem();
  return look;
}

bool LogLook::isText() const {
  return !head.empty() && std::all_of(head.begin(), head.end(),
                                      [](unsigned char c) { return std::isprint(c) || std::isspace(c) || c >= 0x80; });
}

bool LogLook::headBeginsWith(std::string_view beginning) const {
  return std::string_view(head).substr(0, beginning.size()) == beginning;
}

bool LogLook::has(const std::string& entry) const {
  return std::binary_search(entries.begin(), entries.end(), entry);
}

std::string LogLook::firstEnding(std::string_view ending) const {
  for (const auto& entry : entries) {
    if (entry.size() >= ending.size() && entry.compare(entry.size() - ending.size(), ending.size(), ending) == 0)
      return entry;
  }
  return "";
}

}  // namespace omnimapper::source
