
#include <omnimapper/base/FeatureLibraries.h>
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
  if (look.headBeginsWith("OMNIMAP")) return "is a map of OmniMapper, no log; use it with --continue or --localize.";
  for (const char* of_ros : {"#ROSBAG", "#ROSRECORD", "\x89MCAP0", "SQLite format 3"})
    if (look.headBeginsWith(of_ros))
      return std::string("seems to be a log of ROS, which is not read here: ") + base::whyUnavailable("ros_log") + ".";
  if (look.headBeginsWith("\x89PNG") || look.headBeginsWith("\xff\xd8\xff"))
    return "is an image, no log; name the folder that it is in.";
  if (look.headBeginsWith("PK\x03\x04")) return "is a ZIP archive; unpack it first.";
  if (look.headBeginsWith("# .PCD")) return "is a PCD cloud, no log; name the folder that it is in.";
  if (!look.isText())
    return "is no rawlog, or is damaged from its first object on, and no log of another format that is known (" +
           formatsAsText() + ").";
  if (std::filesystem::path(path).extension() == ".ini") return "is an INI file; use it with -i.";
  return "is a text file of unknown kind, no log of a format that is known (" + formatsAsText() + ").";
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
  for (const char* ending : {".rawlog", ".bag"})
    if (const auto log = look.firstEnding(ending); !log.empty())
      return "is a folder; a log in it is " + (std::filesystem::path(path) / log).string() + ".";
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

bool isFolderOfRun(const LogLook& look) {
  return look.has(kMapFile) || look.has(kLocalizationFile);
}

std::string describeInput(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error) ? describeFolder(path) : describeFile(path);
}

}  // namespace omnimapper::source
