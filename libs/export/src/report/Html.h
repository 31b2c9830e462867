#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace omnimapper::exports {

/// Cells of a table row: text, and numbers, which stand to the right and are sorted as such.
std::string cell(const std::string& html);
std::string numberCell(const std::string& html);

/// A number with thin blanks between thousands.
std::string grouped(std::size_t number);

}  // namespace omnimapper::exports
