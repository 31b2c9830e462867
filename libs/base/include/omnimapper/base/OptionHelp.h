#pragma once

#include <omnimapper/base/OptionTable.h>

#include <set>
#include <string>
#include <vector>

namespace omnimapper::base {

/// The options as a Markdown table; "No options." if there are no options.
std::string optionsAsMarkdown(const std::vector<OptionSpec>& options);

/// An INI section with "class = ..." and every option at its default. A comment above each option states its meaning.
/// The options named in `decided`, whose defaults depend on other options, are commented out.
std::string optionsAsIni(const std::string& section, const std::string& class_name, const std::string& summary,
                         const std::vector<OptionSpec>& options, const std::set<std::string>& decided = {});

/// The section name for a class: "loop_closure" for "LoopClosurePlugin" if `endings` contains "_plugin".
std::string sectionNameFor(const std::string& class_name, const std::vector<std::string>& endings);

}  // namespace omnimapper::base
