#include "omnimapper/surfaces/Examples.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

#include "KnownExamples.h"

namespace omnimapper::surfaces {

namespace {

using Facts = SurfaceFacts;

constexpr std::array<const char*, 4> kLies{"up", "down", "upright", "leaning"};
struct Length {
  const char* name;
  double Facts::*value;
};
constexpr std::array<Length, 9> kLengths{{{"bottom_m", &Facts::bottom},
                                          {"top_m", &Facts::top},
                                          {"longer_m", &Facts::longer},
                                          {"shorter_m", &Facts::shorter},
                                          {"filled", &Facts::filled},
                                          {"top_longer_m", &Facts::top_longer},
                                          {"top_shorter_m", &Facts::top_shorter},
                                          {"before_wall_m", &Facts::before_wall},
                                          {"plane_width_m", &Facts::plane_width}}};
struct Flag {
  const char* name;
  bool Facts::*value;
};
constexpr std::array<Flag, 7> kFlags{{{"at_seat", &Facts::is_at_seat},
                                      {"at_bed", &Facts::is_at_bed},
                                      {"outer_corner", &Facts::has_outer_corner},
                                      {"inner_corner", &Facts::has_inner_corner},
                                      {"front", &Facts::has_front},
                                      {"below_level", &Facts::is_below_level},
                                      {"on_level", &Facts::is_on_level}}};

std::string header() {
  std::string line = "class,lie";
  for (const auto& length : kLengths) line += std::string(",") + length.name;
  for (const auto& flag : kFlags) line += std::string(",") + flag.name;
  return line;
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Reads the cells of one line in turn.
class Row {
 public:
  Row(std::string_view line, std::string place) : cells_(split(line, ',')), place_(std::move(place)) {
    if (cells_.size() != 2 + kLengths.size() + kFlags.size())
      fail("has " + std::to_string(cells_.size()) + " cells; expected " + header());
  }
  std::string text() { return std::string(cells_[next_++]); }
  double number() {
    const auto cell = cells_[next_++];
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) fail("'" + std::string(cell) + "' is not a number");
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw base::Error(base::ExitCode::unreadable_input, place_ + ": " + what);
  }

 private:
  std::vector<std::string_view> cells_;
  std::string place_;
  std::size_t next_ = 0;
};

Example exampleOf(std::string_view line, const std::string& place) {
  Row cells(line, place);
  Example example;
  const std::string name = cells.text(), lie = cells.text();
  const auto is = surfaceClassNamed(name);
  if (!is) cells.fail("'" + name + "' is no class of surfaces, such as wall or table");
  example.is = *is;
  const auto found = std::find(kLies.begin(), kLies.end(), lie);
  if (found == kLies.end()) cells.fail("'" + lie + "' is not up, down, upright or leaning");
  example.facts.lie = static_cast<Lie>(found - kLies.begin());
  for (const auto& length : kLengths) example.facts.*length.value = cells.number();
  for (const auto& flag : kFlags) example.facts.*flag.value = cells.number() != 0;
  return example;
}

}  // namespace

std::string toCsv(const std::vector<Example>& examples) {
  std::string text = header() + "\n";
  for (const auto& example : examples) {
    text += toString(example.is) + "," + kLies[static_cast<std::size_t>(example.facts.lie)];
    for (const auto& length : kLengths) {
      char cell[32];
      const auto end =
          std::to_chars(cell, cell + sizeof cell, example.facts.*length.value, std::chars_format::fixed, 2);
      text += "," + std::string(cell, end.ptr);
    }
    for (const auto& flag : kFlags) text += example.facts.*flag.value ? ",1" : ",0";
    text += "\n";
  }
  return text;
}

std::vector<Example> readExamples(const std::string& text, const std::string& file) {
  std::vector<Example> examples;
  int number = 0;
  for (const auto line : split(text, '\n')) {
    const std::string place = file + ", line " + std::to_string(++number);
    if (number == 1 && line != header())
      throw base::Error(base::ExitCode::unreadable_input, place + ": is not the header " + header());
    if (number > 1 && !line.empty()) examples.push_back(exampleOf(line, place));
  }
  return examples;
}

const std::vector<Example>& knownExamples() {
  static const auto all = [] {
    auto examples = readExamples(kExamplesOfMaps, "data/examples.csv");
    const auto usual = readExamples(kUsualExamples, "data/usual.csv");
    examples.insert(examples.end(), usual.begin(), usual.end());
    return examples;
  }();
  return all;
}

}  // namespace omnimapper::surfaces
