#include "run/SensorLabels.h"

#include <omnimapper/base/OptionTable.h>

#include <set>

namespace omnimapper::mapper {

namespace {

using Labels = std::set<std::string>;

std::string sentence(const std::string& place, const std::string& label, const Labels& existing) {
  std::string known;
  for (const auto& name : existing) {
    if (!name.empty()) known += (known.empty() ? "" : ", ") + name;
  }
  const std::string near = base::nearestName(label, {existing.begin(), existing.end()});
  return place + ": no observation of the log has the label '" + label + "'" +
         (near.empty() ? "; existing labels: " : "; did you mean '" + near + "'? Existing labels: ") +
         (known.empty() ? "none" : known);
}

void check(const base::Config& config, const std::string& section, const std::string& key, const Labels& existing,
           std::vector<std::string>& sentences) {
  std::string text;
  if (!config.section(section).find(key, text)) return;
  const bool is_list = key == "labels";
  for (const auto& label : is_list ? base::option_text::parseList(text) : std::vector<std::string>{text}) {
    if (!label.empty() && existing.count(label) == 0)
      sentences.push_back(sentence("[" + section + "] " + key, label, existing));
  }
}

}  // namespace

std::vector<std::string> unknownLabels(const base::Config& config, const std::vector<std::string>& sections,
                                       const source::SourceReport& report, const map::Map& map) {
  Labels in_log;
  for (const auto& [sensor, counts] : report.sensors) in_log.insert(sensor.first);
  Labels with_derived = in_log;
  for (const auto& frame : map.key_frames) {
    if (frame.id.session != map.sessions.back().number) continue;
    for (const auto& observation : frame.observations) with_derived.insert(observation->sensorLabel);
  }
  std::vector<std::string> sentences;
  Labels in_file = in_log;
  in_file.insert(report.filtered_labels.begin(), report.filtered_labels.end());
  check(config, "source", "labels", in_file, sentences);
  check(config, "mapper", "reference_sensor", with_derived, sentences);
  for (const auto& section : sections) {
    for (const char* key : {"label", "labels", "odometry_label"}) check(config, section, key, with_derived, sentences);
  }
  return sentences;
}

}  // namespace omnimapper::mapper
