#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ChannelDecoder.h"

namespace omnimapper::ros {

/// Counts what became of the messages of each topic.
class TopicTable {
 public:
  void read(const Channel& channel) { ++rows_[{channel.topic, channel.type}].messages; }
  void taken(const Channel& channel, const std::string& label) { ++rows_[{channel.topic, channel.type}].labels[label]; }
  /// For a reason that completes "left out: ".
  void leftOut(const Channel& channel, const std::string& reason) {
    ++rows_[{channel.topic, channel.type}].reasons[reason];
  }

  /// A line for each topic.
  std::vector<std::string> lines() const;
  /// Messages that were not decoded, by type.
  std::map<std::string, std::uint64_t> unusedTypes() const;

 private:
  struct Row {
    std::uint64_t messages = 0;
    std::map<std::string, std::uint64_t> labels, reasons;
  };
  std::map<std::pair<std::string, std::string>, Row> rows_;  // by topic and type
};

}  // namespace omnimapper::ros
