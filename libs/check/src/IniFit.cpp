#include "IniFit.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/check/judge.h>

#include <algorithm>
#include <regex>
#include <sstream>

namespace omnimapper::check {

namespace {

std::vector<std::string> splitAt(const std::string& separator, std::string text) {
  std::vector<std::string> parts;
  for (auto at = text.find(separator); at != std::string::npos; at = text.find(separator)) {
    parts.push_back(text.substr(0, at));
    text.erase(0, at + separator.size());
  }
  parts.push_back(text);
  return parts;
}

IniFit::Need needOf(const std::string& text) {
  const std::string no = "no ";
  const bool is_absent = text.compare(0, no.size(), no) == 0;
  return {splitAt(" or ", is_absent ? text.substr(no.size()) : text), is_absent};
}

// Observations are named without their namespace.
bool holds(const LogFacts& facts, const std::string& name) {
  if (name == "laser") return !usableLasers(facts).empty();
  if (name == "odometry") return usableOdometry(facts).has_value();
  return std::any_of(facts.sensors.begin(), facts.sensors.end(), [&](const auto& sensor) {
    const std::string& class_name = sensor.first.second;
    return class_name.substr(class_name.rfind(':') + 1) == name;
  });
}

// The comments that begin with "; Fits", each in one line.
std::vector<std::string> commentsOf(const std::string& ini) {
  const std::string more = ";   ";
  std::vector<std::string> comments;
  std::istringstream lines(ini);
  bool goes_on = false;
  for (std::string line; std::getline(lines, line);) {
    if (goes_on && line.rfind(more, 0) == 0) {
      comments.back() += " " + line.substr(more.size());
      continue;
    }
    goes_on = line.rfind("; Fits", 0) == 0;
    if (goes_on) comments.push_back(line);
  }
  return comments;
}

}  // namespace

bool IniFit::fits(const LogFacts& facts) const {
  return std::all_of(needs.begin(), needs.end(), [&](const Need& need) {
    const bool has = std::any_of(need.one_of.begin(), need.one_of.end(),
                                 [&](const std::string& name) { return holds(facts, name); });
    return has != need.is_absent;
  });
}

std::vector<IniFit> fitsOf(const std::string& ini, const std::string& file) {
  static const std::regex form(R"(; Fits ([0-9]+)( \((settings|a guess|settings, a guess)\))?: ([^:]+): (.+))");
  std::vector<IniFit> fits;
  for (const auto& comment : commentsOf(ini)) {
    std::smatch parts;
    if (!std::regex_match(comment, parts, form))
      throw base::Error(base::ExitCode::internal, file + ": '" + comment + "' does not say which logs it fits");
    IniFit fit;
    fit.place = std::stoi(parts[1]);
    fit.needs_settings = parts[3].str().find("settings") != std::string::npos;
    fit.is_a_guess = parts[3].str().find("guess") != std::string::npos;
    for (const auto& need : splitAt(", ", parts[4])) fit.needs.push_back(needOf(need));
    fit.what = parts[5];
    fits.push_back(std::move(fit));
  }
  return fits;
}

}  // namespace omnimapper::check
