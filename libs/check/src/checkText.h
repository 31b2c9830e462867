#pragma once

#include <omnimapper/check/fittingInis.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/check/proposeIni.h>
#include <omnimapper/source/SourceReport.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// One screen of text: how the log could be read, a line for each sensor, findings, INIs that fit, and the settings to
/// change in `ini`, which is one of these or the user's own.
std::string checkText(const std::string& title, const source::SourceReport& report, const LogFacts& facts,
                      const std::vector<Finding>& findings, const std::vector<FittingIni>& inis, const std::string& ini,
                      const std::vector<Setting>& settings);

}  // namespace omnimapper::check
