#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/check/CheckRun.h>
#include <omnimapper/check/fittingInis.h>
#include <omnimapper/check/gatherFacts.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/check/proposeIni.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/source/openLogs.h>

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "Format.h"
#include "checkText.h"

namespace omnimapper::check {

namespace {

base::ExitCode codeOf(const source::SourceReport& report, const std::vector<FittingIni>& inis,
                      const std::vector<Finding>& findings) {
  if (report.exitCode() != base::ExitCode::ok) return report.exitCode();
  if (inis.empty()) return base::ExitCode::nothing_to_map;
  const bool has_problem = std::any_of(findings.begin(), findings.end(),
                                       [](const Finding& finding) { return finding.weight == Weight::problem; });
  return has_problem ? base::ExitCode::doubtful_input : base::ExitCode::ok;
}

// What the observations show, and what the source doubts.
std::vector<Finding> findingsOf(const LogFacts& facts, const source::SourceReport& report) {
  auto findings = judge(facts);
  for (const auto& doubt : report.doubts) findings.push_back({Weight::warning, doubt});
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.weight > b.weight; });
  return findings;
}

}  // namespace

CheckResult runCheck(const std::vector<std::string>& logs, const base::Config& config, const std::string& output_folder,
                     base::Progress& progress, const std::function<bool()>& stop) {
  mapper::loadPluginLibraries(config);
  const auto given = PluginLists::read(config);
  const auto log = source::openLogs(logs, mapper::sourceOptions(config), stop);
  const auto facts = gatherFacts(*log, Declared::read(config), stop, &progress);
  if (stop())
    throw base::Error(base::ExitCode::interrupted,
                      "interrupted before the log was read to its end; half a log is not judged");
  const auto findings = findingsOf(facts, log->report());
  const auto inis = fittingInis(facts);
  std::string ini;  // the INI that settings are proposed for
  std::vector<Setting> settings;
  if (!inis.empty()) {
    const bool keeps = canMeasure(facts, given);
    ini = keeps ? config.file() : inis.front().file;
    settings = proposeIni(facts, keeps ? given : inis.front().plugins);
  }
  CheckResult result;
  result.code = codeOf(log->report(), inis, findings);
  result.text = checkText(joined(logs, " + "), log->report(), facts, findings, inis, ini, settings);
  if (output_folder.empty()) return result;
  base::makeWritableFolder(output_folder);
  base::writeFile(output_folder + "/check.txt", [&](std::ostream& out) { out << result.text; });
  std::error_code error;
  // It may be one of the INIs that are checked.
  const std::string proposed = output_folder + "/check.ini";
  if (std::filesystem::exists(proposed, error)) std::filesystem::rename(proposed, proposed + "~", error);
  if (!inis.empty())
    base::writeFile(proposed, [&](std::ostream& out) {
      out << (settings.empty() ? base::kWrittenFromALog + ": no settings are proposed.\n" : toIni(settings));
    });
  return result;
}

}  // namespace omnimapper::check
