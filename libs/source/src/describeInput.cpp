
#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/ImageFile.h>
#include <omnimapper/source/SourceFactory.h>
#include <omnimapper/source/describeInput.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "recognizedFormats.h"

namespace omnimapper::source {

namespace {

constexpr const char *kMapFile = "map.omnimap", *kLocalizationFile = "localization.csv";

// Description of a log that formats recognize; empty if none does.
std::string recognized(const LogLook& look) {
  for (const auto& name : recognizedFormats(look)) {
    if (name == kRawlog)
      return "is a rawlog, or the damaged beginning of one; look at it with: omnimapper-graphslam --check " + look.path;
    for (const auto& format : registeredFormats())
      if (format->name() == name)
        return "is " + format->summary() + ", which -r reads as the format " + name +
               ", and of which omnimapper-import makes a rawlog";
  }
  return "";
}

std::string describeFile(const std::string& path) {
  const auto look = LogLook::at(path);
  if (look.head.empty())
    return look.problem.empty() ? "is empty; copy or record it again."
                                : "cannot be decompressed (" + look.problem + "); copy or download it again.";
  if (const auto known = recognized(look); !known.empty()) return known;
  if (const auto packing = describePacking(path, look.head); !packing.empty()) return packing;
  if (look.headBeginsWith("OMNIMAP")) return "is a map of OmniMapper, no log; use it with --continue or --localize.";
  for (const char* of_ros : {"#ROSBAG", "#ROSRECORD", "\x89MCAP0", "SQLite format 3"})
    if (look.headBeginsWith(of_ros))
      return std::string("seems to be a log of ROS, which is not read here: ") + base::whyUnavailable("ros_log") + ".";
  if (look.headBeginsWith("\x89PNG") || look.headBeginsWith("\xff\xd8\xff"))
    return "is an image, no log; name the folder that it is in.";
  if (look.headBeginsWith("PK\x03\x04")) return "is a ZIP archive; unpack it first.";
  if (look.headBeginsWith("# .PCD")) return "is a PCD cloud, no log; name the folder that it is in.";
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const char* of_ros : {".bag", ".mcap", ".db3"})
    if (ending == of_ros)
      return "is named " + ending +
             ", but does not begin as such a log of ROS does: it is damaged, or another file; "
             "copy or download it again.";
  if (!look.isText())
    return "is no rawlog, or is damaged from its first object on, and no log of another format that is known (" +
           formatsAsText() + ").";
  if (ending == ".ini") return "is an INI file; use it with -i.";
  return "is a text file of unknown kind, no log of a format that is known (" + formatsAsText() + ").";
}

// Paths of the rawlogs, and if there are none of the bags, in a folder.
std::vector<std::string> logsIn(const LogLook& look) {
  std::vector<std::string> logs;
  for (const std::string ending : {".rawlog", ".bag"}) {
    for (const auto& entry : look.entries)
      if (std::filesystem::path(entry).extension() == ending)
        logs.push_back((std::filesystem::path(look.path) / entry).string());
    if (!logs.empty()) break;
  }
  return logs;
}

// Description of a folder of a known kind; "" for any other.
std::string knownFolder(const std::string& path) {
  const auto look = LogLook::at(path);
  if (look.has(kMapFile))
    return "is the folder of a map, no log: report.html in it shows the map, summary.json has its numbers and verdict; "
           "use the folder with --continue or --localize.";
  if (look.has(kLocalizationFile))
    return "is the folder of a run with --localize, neither a log nor a map; the map is in the folder that was given "
           "to --localize.";
  if (const auto logs = logsIn(look); !logs.empty())
    return logs.size() == 1 ? "is a folder; the log in it is " + logs.front() + "."
                            : "is a folder; name one of the logs in it: " + base::option_text::format(logs) + ".";
  return recognized(look);
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
  if (holdsDeepGrey(LogLook::at(path)))
    return "is a folder of depth images and other files; put its depth images into a folder depth/ and their pictures, "
           "with the same names, into color/ beside it.";
  return "is a folder, in which there is nothing that can be read; name a log of a format that is known (" +
         formatsAsText() + ").";
}

}  // namespace

std::string describePacking(const std::string& path, std::string_view head) {
  struct Packing {
    std::string_view beginning;
    const char *name, *program;
  };
  constexpr Packing kPackings[] = {{"\x1f\x8b", "gzip", "gzip -dk"},
                                   {"BZh", "bzip2", "bzip2 -dk"},
                                   {"\xfd\x37zXZ", "xz", "xz -dk"},
                                   {"\x28\xb5\x2f\xfd", "Zstandard", "zstd -d"}};
  for (const auto& packing : kPackings)
    if (head.substr(0, packing.beginning.size()) == packing.beginning)
      return std::string("is compressed by ") + packing.name + "; unpack it first: " + packing.program + " " + path;
  return "";
}

bool isFolderOfRun(const LogLook& look) {
  return look.has(kMapFile) || look.has(kLocalizationFile);
}

std::string describeInput(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error) ? describeFolder(path) : describeFile(path);
}

}  // namespace omnimapper::source
