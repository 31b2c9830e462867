#include <cmath>

#include "Program.h"

namespace omnimapper::program {

namespace {

CLI::Validator number(const std::string& description, const std::function<bool(double)>& fits) {
  return CLI::Validator(
      [=](const std::string& text) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        return is_number && fits(value) ? std::string() : "'" + text + "' is not a number " + description;
      },
      description);
}

}  // namespace

CLI::Validator notNegative() {
  return number(">= 0", [](double value) { return value >= 0; });
}

CLI::Validator positive() {
  return number("> 0", [](double value) { return value > 0; });
}

}  // namespace omnimapper::program
