#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/Names.h>

#include <charconv>
#include <cmath>
#include <istream>

namespace omnimapper::base {

namespace {

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace

CsvTable::CsvTable(const std::string& path, const std::string& kind) : path_(path) {
  auto in = openInput(path, kind);
  read(in);
}

CsvTable::CsvTable(std::istream& content, const std::string& path) : path_(path) {
  read(content);
}

void CsvTable::read(std::istream& in) {
  std::string line;
  if (!std::getline(in, line))
    throw Error(ExitCode::unreadable_input, path_ + ": is empty; its first line must name the columns");
  const auto names = fieldsOf(line);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!columns_.emplace(names[i], i).second) {
      throw Error(ExitCode::unreadable_input,
                  path_ + ":1: names the column '" + printable(names[i]) + "' twice; leave one out");
    }
  }
  while (std::getline(in, line)) {
    rows_.push_back(fieldsOf(line));
    if (rows_.back().size() != names.size()) {
      refuse(rows_.size() - 1,
             std::to_string(rows_.back().size()) + " fields, but the first line names " + std::to_string(names.size()));
    }
  }
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end())
    throw Error(ExitCode::unreadable_input, path_ + ": has no column '" + column + "'; add it");
  return rows_[row][found->second];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  const std::string& field = text(row, column);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
    refuse(row, "column " + column + ": '" + field + "' is no number");
  return value;
}

void CsvTable::refuse(std::size_t row, const std::string& why) const {
  throw Error(ExitCode::unreadable_input, path_ + ":" + std::to_string(row + 2) + ": " + why);
}

std::string csvField(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace omnimapper::base
