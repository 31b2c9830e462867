#pragma once

#include <string>
#include <vector>

#include "OddNumbers.h"

namespace omnimapper::fuzz {

/// A key that an INI may have.
struct IniKey {
  std::string section, name, standard;  ///< standard: its default in ini/README.md
};

/// All keys in ini/README.md for the sections of this INI and for the sections that every INI may have.
std::vector<IniKey> keysOf(const std::string& ini);

/// "section.key=value" with an odd value. For half of the numbers it is similar to the default.
std::string oddSetting(const IniKey& key, Dice& dice);

}  // namespace omnimapper::fuzz
