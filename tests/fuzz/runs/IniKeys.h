#pragma once

#include <string>
#include <vector>

#include "OddNumbers.h"

namespace omnimapper::fuzz {

/// A key that an INI could have.
struct IniKey {
  std::string section, name, standard;  ///< standard: its default, as ini/README.md has it
};

/// Every key of the sections that this INI has and of those that every INI may have, by ini/README.md.
std::vector<IniKey> keysOf(const std::string& ini);

/// "section.key=value" with a value that is odd: at half of the numbers something like the default.
std::string oddSetting(const IniKey& key, Dice& dice);

}  // namespace omnimapper::fuzz
