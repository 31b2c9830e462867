#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <string>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// Every registered plugin class with its one-sentence summary, for --list-plugins.
std::string listPlugins();

/// An INI section of that plugin class, with every option at its default value and its meaning, for --print-ini.
/// Throws Error(unknown_plugin) if the class is not registered.
std::string printIni(const std::string& class_name);

/// The sections that do not belong to a plugin, with their options.
using FixedSections = std::vector<std::pair<std::string, std::vector<base::OptionSpec>>>;

/// Markdown tables of all sections and plugin classes: ini/README.md is this text.
std::string iniReference(const FixedSections& fixed);

}  // namespace omnimapper::mapper
