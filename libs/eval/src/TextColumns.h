#pragma once

#include <omnimapper/base/Stamp.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// One line of a text file of numbers: the columns that blanks or tabs part, and where they stand.
struct TextColumns {
  std::string at;  ///< "file:line: ", for messages
  std::vector<std::string> texts;

  /// Throws Error(unreadable_input) unless there are so many columns; `names` are those of a line that is right.
  void expect(std::size_t count, const std::string& names) const;
  /// Throws Error(unreadable_input) if the column is no finite number.
  double number(std::size_t column) const;
  /// Exact to the tick, from plain or scientific decimals. Throws Error(unreadable_input) if it is no time.
  base::Stamp stamp(std::size_t column) const;
};

/// Calls `use` for every line of the file that holds more than a '#' comment; false ends the reading.
/// Throws Error(unreadable_input) if the file cannot be read.
void forEachLine(const std::string& path, const std::function<bool(const TextColumns&)>& use);

}  // namespace omnimapper::eval
