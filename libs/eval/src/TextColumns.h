#pragma once

#include <omnimapper/base/Stamp.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// One line of a text file of numbers: the columns, separated by blanks or tabs, and the place of the line.
struct TextColumns {
  std::string at;  ///< "file:line: ", for messages
  std::vector<std::string> texts;

  /// Throws Error(unreadable_input) unless there are `count` columns; `names`: names of the expected columns.
  void expect(std::size_t count, const std::string& names) const;
  /// The number in a column. Throws Error(unreadable_input) if it is no finite number.
  double number(std::size_t column) const;
  /// The stamp in a column, exact to the tick, from plain or scientific decimals. Throws Error(unreadable_input) if it
  /// is no time.
  base::Stamp stamp(std::size_t column) const;
};

/// Calls `use` for every line of the file that holds more than a '#' comment; false ends the reading.
/// Throws Error(unreadable_input) if the file cannot be read.
void forEachLine(const std::string& path, const std::function<bool(const TextColumns&)>& use);

}  // namespace omnimapper::eval
