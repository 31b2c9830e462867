#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace omnimapper::plugins {

/// Table cells for text and for numbers; the latter are right-aligned and sorted by value.
std::string cell(const std::string& html);
std::string numberCell(const std::string& html);

/// A number with thin spaces between groups of three digits.
std::string grouped(std::size_t number);

}  // namespace omnimapper::plugins
