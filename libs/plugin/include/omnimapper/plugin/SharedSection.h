#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <algorithm>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// An INI section of a plugin that has the options of several structs.
template <class... Structs>
struct SharedSection {
  static const std::vector<base::OptionSpec>& options() {
    static const auto all = [] {
      std::vector<base::OptionSpec> specs;
      (specs.insert(specs.end(), Structs::table().specs().begin(), Structs::table().specs().end()), ...);
      return specs;
    }();
    return all;
  }

  template <class Struct>
  static Struct read(const base::ConfigSection& section) {
    auto keys = sectionKeysOfEngine();
    const auto& own = Struct::table().specs();  // these are read by read() itself
    for (const auto& spec : options()) {
      const auto is_it = [&](const base::OptionSpec& other) { return other.key == spec.key; };
      if (std::none_of(own.begin(), own.end(), is_it)) keys.push_back(spec.key);
    }
    return section.read<Struct>(keys);
  }
};

}  // namespace omnimapper::mapper
