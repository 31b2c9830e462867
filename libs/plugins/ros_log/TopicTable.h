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
  /// As a log can have any number of labels and reasons, of any length, a topic has 50 of either, which are shortened
  /// to 200 bytes, and counts the others together.
  void taken(const Channel& channel, const std::string& label) {
    count(label, "other sensors", rows_[{channel.topic, channel.type}].labels);
  }
  /// For a reason that completes "left out: ".
  void leftOut(const Channel& channel, const std::string& reason) {
    count(reason, "other reasons", rows_[{channel.topic, channel.type}].reasons);
  }

  /// A line for each topic.
  std::vector<std::string> lines() const;
  /// Messages that were not decoded, by type.
  std::map<std::string, std::uint64_t> unusedTypes() const;

 private:
  using Counts = std::map<std::string, std::uint64_t>;
  struct Row {
    std::uint64_t messages = 0;
    Counts labels, reasons;
  };
  static void count(const std::string& text, const std::string& others, Counts& counts);

  std::map<std::pair<std::string, std::string>, Row> rows_;  // by topic and type
};

}  // namespace omnimapper::ros
