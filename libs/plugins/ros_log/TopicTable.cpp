#include "TopicTable.h"

#include <omnimapper/base/Numbers.h>

namespace omnimapper::ros {

void TopicTable::count(const std::string& text, const std::string& others, Counts& counts) {
  constexpr std::size_t kMost = 50, kLongest = 200;  // texts, [bytes]
  const std::string shown = text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
  ++counts[counts.size() < kMost || counts.count(shown) > 0 ? shown : others];
}

std::vector<std::string> TopicTable::lines() const {
  constexpr std::size_t kMostLines = 60;
  std::vector<std::string> lines;
  for (const auto& [name, row] : rows_) {
    if (lines.size() == kMostLines) {
      lines.push_back("... and " + std::to_string(rows_.size() - kMostLines) + " more topics");
      break;
    }
    std::string line = "topic " + name.first + " (" + name.second + "): " + base::counted(row.messages, "message");
    for (const auto& [label, count] : row.labels) line += "; " + label + ": " + std::to_string(count);
    for (const auto& [reason, count] : row.reasons)
      line += "; left out: " + (count == row.messages ? "" : std::to_string(count) + ", ") + reason;
    lines.push_back(line);
  }
  return lines;
}

std::map<std::string, std::uint64_t> TopicTable::unusedTypes() const {
  std::map<std::string, std::uint64_t> types;
  for (const auto& [name, row] : rows_) {
    std::uint64_t unused = 0;
    for (const auto& [reason, count] : row.reasons) unused += count;
    if (unused > 0 && row.labels.empty()) types[name.second] += unused;
  }
  return types;
}

}  // namespace omnimapper::ros
