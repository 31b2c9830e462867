#include <omnimapper/base/Numbers.h>
#include <omnimapper/source/SourceReport.h>

#include <algorithm>
#include <cstdio>

namespace omnimapper::source {

namespace {

template <class Member>
std::uint64_t sum(const SourceReport& report, Member member) {
  std::uint64_t total = 0;
  for (const auto& [sensor, counts] : report.sensors) total += counts.*member;
  return total;
}

void appendCount(std::string& text, const char* what, std::uint64_t count) {
  if (count > 0) text += std::string(what) + ": " + std::to_string(count) + "\n";
}

std::string stampText(base::Stamp stamp) {
  return base::isValid(stamp) ? base::formatUnix(stamp, 6) : "none";
}

}  // namespace

std::string toString(SourceReport::Ending ending) {
  switch (ending) {
    case SourceReport::Ending::open:
      return "not read to its end";
    case SourceReport::Ending::complete:
      return "complete";
    case SourceReport::Ending::truncated:
      return "truncated";
    case SourceReport::Ending::corrupt:
      return "corrupt";
    case SourceReport::Ending::unregistered_class:
      return "unregistered class";
  }
  return "?";
}

std::uint64_t SourceReport::observations() const {
  return sum(*this, &SensorCounts::observations);
}
std::uint64_t SourceReport::zeroStamps() const {
  return sum(*this, &SensorCounts::zero_stamps);
}
std::uint64_t SourceReport::backwardStamps() const {
  return sum(*this, &SensorCounts::backward_stamps);
}

base::ExitCode SourceReport::exitCode() const {
  switch (ending) {
    case Ending::truncated:
    case Ending::corrupt:
      return base::ExitCode::damaged_input;
    case Ending::unregistered_class:
      return base::ExitCode::unregistered_class;
    case Ending::open:
    case Ending::complete:
      break;
  }
  if (missing_images > 0) return base::ExitCode::missing_images;
  return unusable.empty() ? base::ExitCode::ok : base::ExitCode::damaged_input;
}

std::string SourceReport::text() const {
  std::string text = toString(ending) + ": " + std::to_string(objects) + " objects, ";
  if (bytes > 0) text += std::to_string(bytes) + " bytes uncompressed, ";  // 0 for folders of files
  text += base::counted(observations(), "observation") + "\n";
  if (!message.empty()) text += message + "\n";
  if (!sensors.empty()) {
    char row[400];
    std::snprintf(row, sizeof row, "%-20s %-40s %9s %8s %8s  %-18s %-18s %10s\n", "label", "class", "count", "no stamp",
                  "backward", "first stamp [s]", "last stamp [s]", "span [s]");
    text += row;
    for (const auto& [sensor, counts] : sensors) {
      std::snprintf(row, sizeof row, "%-20s %-40s %9llu %8llu %8llu  %-18s %-18s %10.1f\n",
                    sensor.first.empty() ? "(none)" : sensor.first.c_str(), sensor.second.c_str(),
                    static_cast<unsigned long long>(counts.observations),
                    static_cast<unsigned long long>(counts.zero_stamps),
                    static_cast<unsigned long long>(counts.backward_stamps), stampText(counts.first_stamp).c_str(),
                    stampText(counts.last_stamp).c_str(), base::secondsBetween(counts.first_stamp, counts.last_stamp));
      text += row;
    }
  }
  appendCount(text, "stamps repaired", repaired_stamps);
  appendCount(text, "observations outside of the wanted labels and times", filtered_out);
  appendCount(text, "actions without a span of time", dropped_actions);
  for (const auto& [name, count] : other_objects) appendCount(text, (name + " (no observation)").c_str(), count);
  for (const auto& sentence : unusableText()) text += sentence + "\n";
  if (missing_images > 0) {
    text += "observations left out because an external file cannot be read: " + std::to_string(missing_images) +
            ", first " + first_missing_image + "\n";
  }
  for (const auto& note : notes) text += note + "\n";
  return text;
}

std::uint64_t SourceReport::unusableCount() const {
  std::uint64_t count = 0;
  for (const auto& [key, left_out] : unusable) count += left_out.observations;
  return count;
}

std::vector<std::string> SourceReport::unusableText() const {
  std::vector<std::string> sentences;
  for (const auto& [key, left_out] : unusable) {
    sentences.push_back(base::counted(left_out.observations, "observation") + " of " +
                        (key.first.empty() ? "a sensor without a label" : "'" + key.first + "'") + " " +
                        base::wasOrWere(left_out.observations) + " left out because " + key.second + ", the first at " +
                        stampText(left_out.first_stamp) + " s");
  }
  return sentences;
}

void SourceReport::countUnusable(const std::string& label, const std::string& reason, base::Stamp stamp) {
  auto& left_out = unusable[{label, reason}];
  if (left_out.observations++ == 0) left_out.first_stamp = stamp;
}

void SourceReport::count(const std::string& label, const std::string& class_name, base::Stamp stamp) {
  auto& counts = sensors[{label, class_name}];
  ++counts.observations;
  if (!base::isValid(stamp)) {
    ++counts.zero_stamps;
    return;
  }
  if (base::isValid(counts.last_stamp) && stamp < counts.last_stamp) ++counts.backward_stamps;
  if (!base::isValid(counts.first_stamp)) counts.first_stamp = stamp;
  counts.last_stamp = stamp;
}

void SourceReport::add(const SourceReport& other) {
  const Ending worse = std::max(ending, other.ending);
  const bool one_is_open = ending == Ending::open || other.ending == Ending::open;
  ending = worse <= Ending::complete && one_is_open ? Ending::open : worse;
  if (!other.message.empty()) message += (message.empty() ? "" : "\n") + other.message;
  if (unregistered_class.empty()) unregistered_class = other.unregistered_class;
  objects += other.objects;
  bytes += other.bytes;
  for (const auto& [sensor, counts] : other.sensors) {
    auto& mine = sensors[sensor];
    mine.observations += counts.observations;
    mine.zero_stamps += counts.zero_stamps;
    mine.backward_stamps += counts.backward_stamps;
    if (!base::isValid(mine.first_stamp) ||
        (base::isValid(counts.first_stamp) && counts.first_stamp < mine.first_stamp))
      mine.first_stamp = counts.first_stamp;
    mine.last_stamp = std::max(mine.last_stamp, counts.last_stamp);
  }
  for (const auto& [name, count] : other.other_objects) other_objects[name] += count;
  repaired_stamps += other.repaired_stamps;
  filtered_out += other.filtered_out;
  filtered_labels.insert(other.filtered_labels.begin(), other.filtered_labels.end());
  dropped_actions += other.dropped_actions;
  for (const auto& [key, left_out] : other.unusable) {
    auto& mine = unusable[key];
    if (mine.observations == 0 || left_out.first_stamp < mine.first_stamp) mine.first_stamp = left_out.first_stamp;
    mine.observations += left_out.observations;
  }
  missing_images += other.missing_images;
  if (first_missing_image.empty()) first_missing_image = other.first_missing_image;
  notes.insert(notes.end(), other.notes.begin(), other.notes.end());
  doubts.insert(doubts.end(), other.doubts.begin(), other.doubts.end());
  has_logs_apart = has_logs_apart || other.has_logs_apart;
}

}  // namespace omnimapper::source
