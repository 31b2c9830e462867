#include "CommandLineHints.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/OptionTable.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace omnimapper::program {

namespace {

bool isOption(const std::string& argument) {
  return argument.rfind("-", 0) == 0;
}

std::string didYouMean(const std::string& name, const std::vector<std::string>& known) {
  const auto near = base::nearestName(name, known);
  return near.empty() ? "" : "; did you mean " + near + "?";
}

// The option that takes such a file; empty if there is none.
std::string optionFor(const std::string& argument, const CLI::App& app) {
  std::error_code error;
  const auto extension = std::filesystem::path(argument).extension();
  const bool is_ini = extension == ".ini";
  if (!is_ini && extension != ".rawlog" && !std::filesystem::exists(argument, error)) return "";
  const auto* option = app.get_option_no_throw(is_ini ? "--ini" : "--rawlog");
  return !option ? "" : is_ini ? "-i" : "-r";
}

}  // namespace

void sayUnknown(const CLI::App& app) {
  std::vector<std::string> known;
  const auto parsed = app.get_subcommands();  // the task that was given, if there are several
  for (const auto* option : (parsed.empty() ? app : *parsed.front()).get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  const auto unknown = app.remaining(true);
  bool is_misspelt = false;  // a value may then lack its option because of that
  for (const auto& argument : unknown) {
    if (!isOption(argument)) continue;
    is_misspelt = true;
    const auto name = argument.substr(0, argument.find('='));
    std::cerr << app.get_name() << ": there is no option " << base::printableLines(name)
              << (argument.rfind("--", 0) == 0 ? didYouMean(name, known) : "; --help lists them") << "\n";
  }
  for (const auto& argument : unknown) {
    if (is_misspelt) break;
    const auto option = optionFor(argument, app), text = base::printableLines(argument);
    std::cerr << app.get_name() << ": '" << text << "' is given without an option"
              << (option.empty() ? "; " : "; did you mean " + option + " " + text + "? ") << "--help has an example\n";
  }
}

bool saidTasks(const CLI::App& app) {
  if (app.get_require_subcommand_min() == 0 || !app.get_subcommands().empty()) return false;
  std::vector<std::string> names;
  for (const auto* task : app.get_subcommands({})) names.push_back(task->get_name());
  const auto unknown = app.remaining(true);
  if (!unknown.empty() && !isOption(unknown.front()))
    std::cerr << app.get_name() << ": there is no task '" << base::printableLines(unknown.front()) << "'"
              << didYouMean(unknown.front(), names) << "\n";
  std::cerr << app.get_name() << ": the first argument is one of " << base::option_text::format(names)
            << "; --help has an example\n";
  return true;
}

}  // namespace omnimapper::program
