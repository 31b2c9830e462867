#include "ForeignFile.h"

#include <algorithm>
#include <cctype>

#include "CompressedFile.h"

namespace omnimapper::source {

namespace {

bool beginsWith(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
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

}  // namespace

std::string describeForeignFile(const std::string& path) {
  CompressedFile file(path);
  std::string head(4096, '\0');
  head.resize(file.read(head.data(), head.size()));
  if (head.empty()) return file.problem().empty() ? "is empty." : "cannot be decompressed (" + file.problem() + ").";
  if (beginsWith(head, "#ROSBAG")) return "is a ROS bag; convert it with MRPT's rosbag2rawlog.";
  if (beginsWith(head, "SQLite format 3"))
    return "is an SQLite file, perhaps a ROS 2 bag; convert it to a rawlog first.";
  if (beginsWith(head, "\x89PNG") || beginsWith(head, "\xff\xd8\xff")) return "is an image, no rawlog.";
  if (beginsWith(head, "PK\x03\x04")) return "is a ZIP archive; unpack it first.";
  if (isText(head)) {
    return isCarmen(head) ? "is a CARMEN log; make it a rawlog with: omnimapper-import carmen " + path + " OUT.rawlog"
                          : "is a text file, no rawlog; CARMEN logs are imported with omnimapper-import carmen.";
  }
  return "is no rawlog, or damaged from its first object on.";
}

}  // namespace omnimapper::source
