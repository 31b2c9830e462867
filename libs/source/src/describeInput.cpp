#include "describeInput.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "CompressedFile.h"
#include "RgbdFolderForms.h"

namespace omnimapper::source {

namespace {

bool beginsWith(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

bool isRawlog(const std::string& head) {
  constexpr std::size_t kFirstHeader = 64;  // [bytes] at the beginning, in which the first object's class is named
  return head.substr(0, kFirstHeader).find("mrpt::obs::C") != std::string::npos;
}

bool isText(const std::string& head) {
  return std::all_of(head.begin(), head.end(),
                     [](unsigned char c) { return std::isprint(c) || std::isspace(c) || c >= 0x80; });
}

bool isCarmen(const std::string& head) {
  for (const char* word : {"PARAM ", "ODOM ", "FLASER ", "RLASER ", "ROBOTLASER1 ", "SYNC ", "# message_name"})
    if (beginsWith(head, word) || head.find(std::string("\n") + word) != std::string::npos) return true;
  return false;
}

std::string describeFile(const std::string& path) {
  CompressedFile file(path);
  std::string head(4096, '\0');
  head.resize(file.read(head.data(), head.size()));
  if (head.empty())
    return file.problem().empty() ? "is empty; copy or record it again."
                                  : "cannot be decompressed (" + file.problem() + "); copy or download it again.";
  if (isRawlog(head))
    return "is a rawlog, or the damaged beginning of one; look at it with: omnimapper-graphslam --check " + path;
  if (beginsWith(head, "OMNIMAP")) return "is a map of OmniMapper, no log; use it with --continue or --localize.";
  if (beginsWith(head, "#ROSBAG"))
    return "is a ROS bag; convert it with MRPT's rosbag2rawlog -c CONFIG.yml, which names the topics.";
  if (beginsWith(head, "SQLite format 3"))
    return "is an SQLite file, perhaps a ROS 2 bag; convert it to a rawlog first.";
  if (beginsWith(head, "\x89PNG") || beginsWith(head, "\xff\xd8\xff"))
    return "is an image, no rawlog; make one of a folder of images with: omnimapper-import images FOLDER OUT.rawlog";
  if (beginsWith(head, "PK\x03\x04")) return "is a ZIP archive; unpack it first.";
  if (beginsWith(head, "# .PCD"))
    return "is a PCD cloud; make a rawlog of the folder that it is in with: omnimapper-import pcd FOLDER OUT.rawlog";
  if (!isText(head)) return "is no rawlog, or is damaged from its first object on.";
  if (isCarmen(head)) return "is a CARMEN log; make it a rawlog with: omnimapper-import carmen " + path + " OUT.rawlog";
  if (std::filesystem::path(path).extension() == ".ini") return "is an INI file; use it with -i.";
  return "is a text file of unknown kind, no rawlog.";
}

/// Name of the first file in `folder`, in the order of names, that ends with `end`; "" if there is none.
std::string firstWith(const std::string& end, const std::filesystem::path& folder) {
  std::error_code error;
  std::string first;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool ends_so = name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    if (ends_so && (first.empty() || name < first)) first = name;
  }
  return first;
}

// Description of a folder of a known kind; "" for any other.
std::string knownFolder(const std::string& path) {
  const std::filesystem::path folder(path);
  std::error_code error;
  if (std::filesystem::exists(folder / "map.omnimap", error))
    return "is the folder of a map, no log: report.html in it shows the map, summary.json has its numbers and verdict; "
           "use the folder with --continue or --localize.";
  if (std::filesystem::exists(folder / "localization.csv", error))
    return "is the folder of a run with --localize, neither a log nor a map; the map is in the folder that was given "
           "to --localize.";
  if (const auto log = firstWith(".rawlog", folder); !log.empty())
    return "is a folder; a log in it is " + (folder / log).string() + ".";
  const auto import = [&](const std::string& what, const std::string& task) {
    return "is a folder of " + what + "; make a rawlog of it with: omnimapper-import " + task + " " + path +
           " OUT.rawlog";
  };
  if (isRgbdFolder(folder)) return import("RGB-D images", "tum");
  if (!firstWith(".pcd", folder).empty()) return import("PCD clouds", "pcd");
  return "";
}

std::string describeFolder(const std::string& path) {
  if (const auto known = knownFolder(path); !known.empty()) return known;
  std::error_code error;
  std::vector<std::string> inner;
  for (const auto& entry : std::filesystem::directory_iterator(path, error))
    if (entry.is_directory(error)) inner.push_back(entry.path().string());
  std::sort(inner.begin(), inner.end());
  for (const auto& folder : inner)
    if (const auto known = knownFolder(folder); !known.empty()) return "is a folder; in it, " + folder + " " + known;
  return "is a folder, in which there is nothing that can be read; name a file.";
}

}  // namespace

std::string describeInput(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error) ? describeFolder(path) : describeFile(path);
}

}  // namespace omnimapper::source
