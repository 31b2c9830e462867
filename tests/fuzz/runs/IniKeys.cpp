#include "IniKeys.h"

#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "FileMutation.h"

namespace omnimapper::fuzz {

namespace {

// The keys in ini/README.md by the heading of their table: "mapper" for "## [mapper]", "OdometryPlugin" for
// "## OdometryPlugin (pose plugin)".
std::map<std::string, std::vector<IniKey>> documentedKeys() {
  std::map<std::string, std::vector<IniKey>> keys;
  std::ifstream reference(testing::sourceFile("ini/README.md"));
  const std::regex heading(R"(## \[?(\w+).*)"), row(R"(\| `(\w+)` \| \w+ \| ([^|]*) \|.*)");
  std::string name;
  std::smatch match;
  for (std::string line; std::getline(reference, line);) {
    if (std::regex_match(line, match, heading)) name = match[1];
    if (std::regex_match(line, match, row)) keys[name].push_back({name, match[1], match[2]});
  }
  return keys;
}

}  // namespace

std::vector<IniKey> keysOf(const std::string& ini) {
  static const auto documented = documentedKeys();
  std::vector<IniKey> keys;
  const auto add = [&](const std::string& heading, const std::string& section) {
    const auto found = documented.find(heading);
    if (found == documented.end()) return;
    for (auto key : found->second) {
      key.section = section;
      keys.push_back(std::move(key));
    }
  };
  for (const char* common : {"mapper", "perception", "trigger", "solver", "hypotheses", "source"}) add(common, common);
  std::ifstream in(ini);
  const std::regex heading(R"(\[(\w+)\].*)"), of_class(R"(class\s*=\s*(\w+).*)");
  std::string section;
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (std::regex_match(line, match, heading)) section = match[1];
    if (std::regex_match(line, match, of_class)) add(match[1], section);
  }
  return keys;
}

std::string oddSetting(const IniKey& key, Dice& dice) {
  const std::string name = key.section + "." + key.name + "=";
  double number = 0;
  std::istringstream in(key.standard);
  if (!(in >> number) || onceIn(dice, 3)) return name + oddWord(dice);
  std::ostringstream value;
  value << oddInstead(number, dice);
  return name + value.str();
}

}  // namespace omnimapper::fuzz
