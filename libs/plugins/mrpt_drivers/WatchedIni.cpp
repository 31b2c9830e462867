#include "WatchedIni.h"

#include <mrpt/system/string_utils.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/live/SensorSection.h>

namespace omnimapper::drivers {

namespace {

bool isForWindows(const std::string& key) {
  return mrpt::system::lowerCase(key.size() > 4 ? key.substr(key.size() - 4) : "") == "_win";
}

}  // namespace

std::string WatchedIni::readString(const std::string& section, const std::string& name,
                                   const std::string& default_value, bool fail_if_missing) const {
  read_.emplace(mrpt::system::lowerCase(name), name);
  return ini_.read_string(section, name, default_value, fail_if_missing);
}

std::vector<std::string> WatchedIni::unreadKeys(const std::string& section) const {
  auto known = read_;
  const auto add = [&](const std::string& key) { known.emplace(key, key); };
  add("driver");
  add("rawlog-grabber-ignore");
  for (const auto& spec : live::SensorOptions::table().specs()) add(spec.key);
  std::vector<std::string> names;
  for (const auto& [in_lower_case, name] : known) names.push_back(name);
  std::vector<std::string> keys, unread;
  getAllKeys(section, keys);
  for (const auto& key : keys) {
    if (known.count(mrpt::system::lowerCase(key)) > 0 || isForWindows(key)) continue;
    const std::string nearest = base::nearestName(key, names);
    unread.push_back(key + (nearest.empty() ? "" : " (did you mean " + nearest + "?)"));
  }
  return unread;
}

}  // namespace omnimapper::drivers
