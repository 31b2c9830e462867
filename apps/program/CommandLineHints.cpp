#include "CommandLineHints.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/OptionTable.h>

#include <iostream>
#include <string>
#include <vector>

namespace omnimapper::program {

void sayNearest(const CLI::App& app) {
  std::vector<std::string> known;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  bool is_misspelt = false;  // then a value may stand alone because of that
  for (const auto& argument : app.remaining(true)) {
    const auto near =
        argument.rfind("--", 0) == 0 ? base::nearestName(argument.substr(0, argument.find('=')), known) : "";
    is_misspelt = is_misspelt || argument.rfind("-", 0) == 0;
    if (!near.empty())
      std::cerr << "There is no " << base::printableLines(argument) << "; did you mean " << near << "?\n";
  }
  for (const auto& argument : app.remaining(true))
    if (!is_misspelt)
      std::cerr << "No option takes '" << base::printableLines(argument) << "'; --help has an example.\n";
}

void sayTasks(const CLI::App& app) {
  if (app.get_require_subcommand_min() == 0 || !app.get_subcommands().empty()) return;
  std::vector<std::string> names;
  for (const auto* task : app.get_subcommands({})) names.push_back(task->get_name());
  std::cerr << "The first argument is one of " << base::option_text::format(names) << ".\n";
}

}  // namespace omnimapper::program
