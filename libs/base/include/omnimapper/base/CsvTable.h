#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace omnimapper::base {

/// A table of comma-separated fields whose first line names the columns. A field in double quotes may hold commas, and
/// a double quote in it is written twice.
class CsvTable {
 public:
  /// `kind` says in messages what the file is. Throws Error(unreadable_input) if the file cannot be read, or a line has
  /// another number of fields than the first.
  explicit CsvTable(const std::string& path, const std::string& kind = "table");
  /// The same for the content of the file `path`.
  CsvTable(std::istream& content, const std::string& path);

  std::size_t size() const { return rows_.size(); }
  bool has(const std::string& column) const { return columns_.count(column) > 0; }
  /// Throws Error(unreadable_input) if there is no such column.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// Throws Error(unreadable_input) if the field is not a finite number.
  double number(std::size_t row, const std::string& column) const;
  /// Throws Error(unreadable_input) about that row.
  [[noreturn]] void refuse(std::size_t row, const std::string& why) const;

 private:
  void read(std::istream& in);

  std::string path_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// A text as a field of such a table: in quotes if it holds commas, quotes or line breaks. (A table is read line by
/// line, so a text with line breaks cannot be read back.)
std::string csvField(std::string_view text);

}  // namespace omnimapper::base
