#include <mrpt/config/CConfigFileMemory.h>
#include <omnimapper/base/IniDifferences.h>
#include <omnimapper/base/OptionTable.h>

#include "RenamedKeys.h"

namespace omnimapper::base {

namespace {

using mrpt::config::CConfigFileMemory;

// Whether the section is [live] or a section of a driver.
bool isOfSensors(const CConfigFileMemory& ini, const std::string& section) {
  return section == "live" || ini.keyExists(section, "driver");
}

// Whether the section has settings. If it has only a class, its absence in the other INI makes no difference.
bool hasSettings(const CConfigFileMemory& ini, const std::string& section, const CConfigFileMemory& other) {
  std::vector<std::string> keys;
  ini.getAllKeys(section, keys);
  return keys.size() > 1 || (keys.size() == 1 && (keys.front() != "class" || other.keyExists(section, "class")));
}

// Whether two values are equal, as numbers if they are numbers: 0.5 equals 0.50.
bool areEqual(const std::string& a, const std::string& b) {
  double of_a = 0, of_b = 0;
  const bool are_numbers = !option_text::parse(a, Range(), of_a) && !option_text::parse(b, Range(), of_b);
  return are_numbers ? of_a == of_b : a == b;
}

std::string valueOf(const CConfigFileMemory& ini, const std::string& section, const std::string& key) {
  return ini.keyExists(section, key) ? ini.read_string(section, key, "") : "not set";
}

// Adds the differences in the keys of `listed`, or only in those that `now` lacks.
void addDifferences(const CConfigFileMemory& listed, const CConfigFileMemory& now, const CConfigFileMemory& before,
                    bool are_missing_now, std::vector<std::string>& all) {
  std::vector<std::string> sections, keys;
  listed.getAllSections(sections);
  for (const auto& section : sections) {
    if (isOfSensors(listed, section) || !hasSettings(listed, section, are_missing_now ? now : before)) continue;
    listed.getAllKeys(section, keys);
    for (const auto& key : keys) {
      if (are_missing_now && now.keyExists(section, key)) continue;
      const std::string is = valueOf(now, section, key), was = valueOf(before, section, key);
      if (!areEqual(is, was)) all.push_back("[" + section + "] " + key + " (" + is + ", was " + was + ")");
    }
  }
}

// The INI with the present names of its keys.
CConfigFileMemory withPresentNames(const std::string& text) {
  CConfigFileMemory read, renamed;
  read.setContent(text);
  std::vector<std::string> sections, keys;
  read.getAllSections(sections);
  for (const auto& section : sections) {
    read.getAllKeys(section, keys);
    for (const auto& key : keys) {
      const auto present = renamedKeys().find(key);
      renamed.write(section, present == renamedKeys().end() ? key : present->second,
                    read.read_string(section, key, ""));
    }
  }
  return renamed;
}

}  // namespace

std::vector<std::string> iniDifferences(const std::string& now, const std::string& before) {
  const CConfigFileMemory ini_now = withPresentNames(now), ini_before = withPresentNames(before);
  std::vector<std::string> all;
  addDifferences(ini_now, ini_now, ini_before, false, all);
  addDifferences(ini_before, ini_now, ini_before, true, all);
  return all;
}

}  // namespace omnimapper::base
