#pragma once

#include <omnimapper/base/Error.h>

#include <string>
#include <utility>
#include <vector>

namespace omnimapper::eval {

/// The choice with that name. `what` names the kind of choice in the error. Throws Error(command_line) that lists the
/// names.
template <class Choice>
Choice namedChoice(const std::string& name, const char* what,
                   const std::vector<std::pair<const char*, Choice>>& choices) {
  std::string known;
  for (const auto& [choice_name, choice] : choices) {
    if (name == choice_name) return choice;
    known += std::string(known.empty() ? "" : " | ") + choice_name;
  }
  throw base::Error(base::ExitCode::command_line, std::string(what) + " '" + name + "' is not one of " + known);
}

}  // namespace omnimapper::eval
