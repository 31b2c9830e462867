#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/check/MountingRun.h>
#include <omnimapper/check/fittingInis.h>
#include <omnimapper/check/gatherFacts.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/source/openLogs.h>

#include <algorithm>
#include <ostream>

#include "../Format.h"
#include "MountingIni.h"
#include "mountingText.h"

namespace omnimapper::check {

namespace {

using State = Quantity::State;

struct Reading {
  LogFacts facts;
  source::SourceReport report;
};

Reading readLogs(const std::vector<std::string>& logs, const base::Config& config, base::Progress& progress,
                 const std::function<bool()>& stop) {
  const auto log = source::openLogs(logs, mapper::sourceOptions(config), stop);
  Reading reading;
  reading.facts = gatherFacts(*log, Declared::read(config), stop, &progress);
  reading.report = log->report();
  if (stop())
    throw base::Error(base::ExitCode::interrupted,
                      "interrupted before the log was read to its end; half a log is not measured");
  return reading;
}

base::Config with(const base::Config& config, const std::vector<MountingLine>& lines) {
  auto changed = base::Config::fromText(config.text(), config.file());  // a copy would share the text
  for (const auto& line : lines) changed.set(line.section + "." + line.key + "=" + line.value);
  return changed;
}

template <class Value>
void keep(std::optional<Value>& value, const std::optional<Value>& before) {
  if (!value) value = before;
}

// What the second reading measured, beside what the first one corrected so that the second one sees nothing of it.
SensorMounting merged(const SensorMounting& first, SensorMounting second) {
  for (auto& one : second.quantities) {
    for (const auto& before : first.quantities) {
      if (before.key() != one.key()) continue;
      one.declared = before.declared;
      if (before.state == State::corrected && one.state != State::corrected) one = before;
    }
  }
  for (const auto& before : first.quantities) {
    const bool is_there = std::any_of(second.quantities.begin(), second.quantities.end(),
                                      [&](const Quantity& one) { return one.key() == before.key(); });
    if (!is_there && before.state == State::corrected) second.quantities.push_back(before);
  }
  for (const auto& [label, keys] : first.sensors) {
    auto& now = second.sensors[label];
    keep(now.pose, keys.pose);
    keep(now.clock_offset, keys.clock_offset);
    keep(now.aperture, keys.aperture);
  }
  for (const auto& [label, keys] : first.cameras) {
    auto& now = second.cameras[label];
    keep(now.depth_scale, keys.depth_scale);
    keep(now.fx, keys.fx);
    keep(now.fy, keys.fy);
    keep(now.mirrored, keys.mirrored);
    keep(now.depth_is_range, keys.depth_is_range);
  }
  keep(second.sweep, first.sweep);
  return second;
}

QuantityKeys correctedIn(const SensorMounting& mounting) {
  QuantityKeys keys;
  for (const auto& one : mounting.quantities) {
    if (one.state == State::corrected) keys.insert(one.key());
  }
  return keys;
}

bool hasLaserOdometry(const base::Config& config, const LogFacts& facts) {
  const std::string name = "scan_odometry";
  const auto names = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  if (config.has("mapper")) return names(config.section("mapper").read<mapper::EngineOptions>().pose_plugins);
  const auto inis = fittingInis(facts);
  return !inis.empty() && names(inis.front().plugins.pose);
}

// Problems, but for those that are said with both causes.
std::vector<std::string> contradictionsOf(const LogFacts& facts, const std::vector<TwoCauses>& two_causes) {
  std::vector<std::string> texts;
  for (const auto& finding : judge(facts)) {
    const bool is_said = std::any_of(two_causes.begin(), two_causes.end(), [&](const TwoCauses& causes) {
      return finding.text.find(check::quoted(causes.sensor)) == 0 && finding.text.find("ither ") != std::string::npos;
    });
    if (finding.is_contradiction && finding.weight == Weight::problem && !is_said) texts.push_back(finding.text);
  }
  return texts;
}

void refuseEmpty(const SensorMounting& mounting, const std::string& title) {
  std::string reasons;
  for (const auto& one : mounting.quantities) {
    if (one.state != State::not_determined) return;
    reasons += "; " + check::quoted(one.sensor) + " " + one.name + ": " + one.reason;
  }
  throw base::Error(base::ExitCode::nothing_to_map,
                    title + ": the log does not determine how its sensors are mounted" +
                        (reasons.empty() ? ": it has neither lasers nor depth cameras whose stamps can be used; "
                                           "omnimapper-graphslam --check says what is wrong with it"
                                         : reasons));
}

}  // namespace

MountingResult runMounting(const std::vector<std::string>& logs, const base::Config& config,
                           const std::string& output_folder, base::Progress& progress,
                           const std::function<bool()>& stop) {
  const base::InputsKept inputs_kept(logs);
  base::makeWritableFolder(output_folder);
  const auto title = joined(logs, " + ");
  mapper::loadPluginLibraries(config);
  auto reading = readLogs(logs, config, progress, stop);
  auto mounting = sensorMounting(reading.facts, {});
  refuseEmpty(mounting, title);
  const bool has_laser_odometry = hasLaserOdometry(config, reading.facts);
  auto lines = mountingLines(mounting, config, has_laser_odometry);
  if (mounting.isAnythingCorrected()) {
    reading = readLogs(logs, with(config, lines), progress, stop);
    mounting = merged(mounting, sensorMounting(reading.facts, correctedIn(mounting)));
    lines = mountingLines(mounting, config, has_laser_odometry);
  }
  std::stable_sort(mounting.quantities.begin(), mounting.quantities.end(),
                   [](const Quantity& a, const Quantity& b) { return a.sensor < b.sensor; });
  const auto contradictions = contradictionsOf(reading.facts, mounting.two_causes);
  MountingResult result;
  result.code = reading.report.exitCode();
  if (result.code == base::ExitCode::ok && (!mounting.two_causes.empty() || !contradictions.empty()))
    result.code = base::ExitCode::doubtful_input;
  result.text = mountingText(title, mounting, leftOutOfIni(mounting, config), contradictions);
  if (!reading.report.message.empty()) result.warnings.push_back(reading.report.message);
  for (auto& sentence : reading.report.unusableText()) result.warnings.push_back(std::move(sentence));
  base::writeFile(output_folder + "/mounting.ini",
                  [&](std::ostream& out) { out << mountingIni(lines, mounting, title); });
  base::writeFile(output_folder + "/report.txt", [&](std::ostream& out) { out << base::printableLines(result.text); });
  return result;
}

}  // namespace omnimapper::check
