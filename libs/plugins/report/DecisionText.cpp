#include "DecisionText.h"

#include <omnimapper/base/Numbers.h>

namespace omnimapper::plugins {

std::string verdictText(const mapper::Decision& decision) {
  return (decision.accepted ? "accepted" : "refused") + (decision.reason.empty() ? "" : ": " + decision.reason);
}

std::string numbersText(const mapper::Decision& decision) {
  std::string text;
  for (const auto& [name, value] : decision.numbers) {
    const std::size_t bracket = name.find(" [");
    const bool has_unit = bracket != std::string::npos && name.back() == ']';
    text += (text.empty() ? "" : ", ") + name.substr(0, has_unit ? bracket : name.size()) + " " + base::brief(value, 3);
    if (has_unit) text += " " + name.substr(bracket + 2, name.size() - bracket - 3);
  }
  return text;
}

}  // namespace omnimapper::plugins
