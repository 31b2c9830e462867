#include "MapServerYaml.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

namespace omnimapper::grid {

namespace {

constexpr std::size_t kLongestYaml = 1 << 16;

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\"'"), end = text.find_last_not_of(" \t\r\"'");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

std::optional<double> numberIn(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace

MapServerYaml::MapServerYaml(const std::string& file) : file_(file) {
  std::ifstream in = base::openInput(file, "occupancy grid");
  std::string text(kLongestYaml, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() == kLongestYaml) refuse("is longer than the description of a grid can be.");
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    addLine(text.substr(begin, end - begin));
    begin = end + 1;
  }
}

void MapServerYaml::refuse(const std::string& reason) const {
  throw base::Error(base::ExitCode::unreadable_input, file_ + ": " + reason);
}

std::string MapServerYaml::text(const std::string& key) const {
  const auto value = values_.find(key);
  if (value == values_.end() || value->second.empty()) refuse("lacks the key \"" + key + "\".");
  return value->second;
}

std::string MapServerYaml::text(const std::string& key, const std::string& otherwise) const {
  return values_.count(key) > 0 ? text(key) : otherwise;
}

double MapServerYaml::number(const std::string& key, double least, double most) const {
  return checked(key, numberIn(text(key)), least, most);
}

double MapServerYaml::number(const std::string& key, double least, double most, double otherwise) const {
  return values_.count(key) > 0 ? number(key, least, most) : otherwise;
}

std::vector<double> MapServerYaml::numbers(const std::string& key) const {
  constexpr double kFar = 1e7;
  const std::string list = text(key);
  if (list.front() != '[' || list.back() != ']') refuse("\"" + key + "\" is not a list of numbers.");
  std::vector<double> result;
  for (std::size_t begin = 1; begin < list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size() - 1);
    result.push_back(checked(key, numberIn(trimmed(list.substr(begin, end - begin))), -kFar, kFar));
    begin = end + 1;
  }
  return result;
}

void MapServerYaml::addLine(const std::string& line) {
  const std::string said = line.substr(0, line.find('#'));
  const std::size_t colon = said.find(':');
  if (colon != std::string::npos) values_[trimmed(said.substr(0, colon))] = trimmed(said.substr(colon + 1));
}

double MapServerYaml::checked(const std::string& key, std::optional<double> value, double least, double most) const {
  if (!value || *value < least || *value > most) refuse("\"" + key + "\" is not a number that a grid can have.");
  return *value;
}

}  // namespace omnimapper::grid
