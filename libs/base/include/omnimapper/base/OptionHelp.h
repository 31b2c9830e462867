#pragma once

#include <omnimapper/base/OptionTable.h>

#include <set>
#include <string>
#include <vector>

namespace omnimapper::base {

/// The options as a table in Markdown; "No options." without any.
std::string optionsAsMarkdown(const std::vector<OptionSpec>& options);

/// "[section]" with "class = ..." and every option at its default, what it means above it; those named in `decided` are
/// comments: another option decides their default.
std::string optionsAsIni(const std::string& section, const std::string& class_name, const std::string& summary,
                         const std::vector<OptionSpec>& options, const std::set<std::string>& decided = {});

/// "LoopClosurePlugin" as the name of a section: "loop_closure" where `endings` has "_plugin".
std::string sectionNameFor(const std::string& class_name, const std::vector<std::string>& endings);

}  // namespace omnimapper::base
