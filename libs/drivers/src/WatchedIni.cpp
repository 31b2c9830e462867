#include "WatchedIni.h"

#include <mrpt/system/string_utils.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/live/SensorSection.h>

namespace omnimapper::drivers {

namespace {

bool isOfAnotherSystem(const std::string& key) {
  const auto end = mrpt::system::lowerCase(key.size() > 4 ? key.substr(key.size() - 4) : "");
  return end == "_win" || end == "_lin";
}

}  // namespace

std::string WatchedIni::readString(const std::string& section, const std::string& name,
                                   const std::string& default_value, bool fail_if_missing) const {
  read_.insert(mrpt::system::lowerCase(name));
  return ini_.read_string(section, name, default_value, fail_if_missing);
}

std::vector<std::string> WatchedIni::unreadKeys(const std::string& section) const {
  std::set<std::string> known = read_;
  known.insert({"driver", "rawlog-grabber-ignore"});
  for (const auto& spec : live::SensorOptions::table().specs()) known.insert(spec.key);
  std::vector<std::string> keys, unread;
  getAllKeys(section, keys);
  for (const auto& key : keys) {
    if (known.count(mrpt::system::lowerCase(key)) > 0 || isOfAnotherSystem(key)) continue;
    const std::string nearest = base::nearestName(key, {known.begin(), known.end()});
    unread.push_back(key + (nearest.empty() ? "" : " (did you mean " + nearest + "?)"));
  }
  return unread;
}

}  // namespace omnimapper::drivers
