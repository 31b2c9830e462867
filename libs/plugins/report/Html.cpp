#include "Html.h"

#include <cstddef>

namespace omnimapper::plugins {

std::string cell(const std::string& html) {
  return "<td>" + html + "</td>";
}

std::string numberCell(const std::string& html) {
  return "<td class=\"num\">" + html + "</td>";
}

std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (auto place = static_cast<std::ptrdiff_t>(text.size()) - 3; place > 0; place -= 3) {
    text.insert(static_cast<std::size_t>(place), "&#8239;");
  }
  return text;
}

}  // namespace omnimapper::plugins
