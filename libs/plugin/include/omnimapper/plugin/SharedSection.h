#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// A section of a plugin that holds the options of several structs.
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
    for (const auto& spec : options()) keys.push_back(spec.key);
    return section.read<Struct>(keys);
  }
};

}  // namespace omnimapper::mapper
