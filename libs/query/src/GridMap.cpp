#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/query/GridMap.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <system_error>

namespace omnimapper::query {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostCells = 400'000'000;
constexpr std::size_t kLongestYaml = 1 << 16;
const std::string kRemedy = " Map the log again with a GridOutput in [mapper] output_plugins.";

[[noreturn]] void refuseGrid(const std::string& file, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, file + ": " + reason + kRemedy);
}

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

/// The keys and values of a map_server file; other elements of YAML are not supported.
class GridYaml {
 public:
  explicit GridYaml(const std::string& file) : file_(file) {
    std::ifstream in = base::openInput(file, "occupancy grid");
    std::string text(kLongestYaml, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() == kLongestYaml) refuseGrid(file, "is longer than the description of a grid can be.");
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      addLine(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  std::string text(const std::string& key) const {
    const auto value = values_.find(key);
    if (value == values_.end() || value->second.empty()) refuseGrid(file_, "lacks the key \"" + key + "\".");
    return value->second;
  }
  std::string text(const std::string& key, const std::string& otherwise) const {
    return values_.count(key) > 0 ? text(key) : otherwise;
  }
  double number(const std::string& key, double least, double most) const {
    return checked(key, numberIn(text(key)), least, most);
  }
  double number(const std::string& key, double least, double most, double otherwise) const {
    return values_.count(key) > 0 ? number(key, least, most) : otherwise;
  }
  /// The numbers of "[a, b, c]".
  std::vector<double> numbers(const std::string& key) const {
    constexpr double kFar = 1e7;
    const std::string list = text(key);
    if (list.front() != '[' || list.back() != ']') refuseGrid(file_, "\"" + key + "\" is not a list of numbers.");
    std::vector<double> result;
    for (std::size_t begin = 1; begin < list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size() - 1);
      result.push_back(checked(key, numberIn(trimmed(list.substr(begin, end - begin))), -kFar, kFar));
      begin = end + 1;
    }
    return result;
  }

 private:
  void addLine(const std::string& line) {
    const std::string said = line.substr(0, line.find('#'));
    const std::size_t colon = said.find(':');
    if (colon != std::string::npos) values_[trimmed(said.substr(0, colon))] = trimmed(said.substr(colon + 1));
  }
  double checked(const std::string& key, std::optional<double> value, double least, double most) const {
    if (!value || *value < least || *value > most)
      refuseGrid(file_, "\"" + key + "\" is not a number that a grid can have.");
    return *value;
  }

  std::string file_;
  std::map<std::string, std::string> values_;
};

// The next number of the header after blanks and comments; negative if there is none.
std::int64_t headerNumber(std::istream& in) {
  constexpr std::int64_t kLargest = 1'000'000'000;
  const auto isBlank = [](int c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  int c = in.get();
  for (; isBlank(c) || c == '#'; c = in.get())
    if (c == '#') in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  std::int64_t number = -1;
  for (; c >= '0' && c <= '9'; c = in.get()) {
    number = 10 * std::max<std::int64_t>(number, 0) + (c - '0');
    if (number > kLargest) return -1;
  }
  return number;
}

struct Pgm {
  int columns = 0, rows = 0, white = 255;
  std::string pixels;  // rows from the top
};

Pgm readPgm(const std::string& file) {
  std::ifstream in = base::openInput(file, "occupancy grid");
  char magic[2] = {};
  in.read(magic, 2);
  if (!in || magic[0] != 'P' || magic[1] != '5')
    refuseGrid(file, "is not a binary PGM: it does not begin with \"P5\".");
  const std::int64_t columns = headerNumber(in), rows = headerNumber(in), white = headerNumber(in);
  if (columns <= 0 || rows <= 0 || white <= 0 || white > 255)
    refuseGrid(file, "has no header of an 8-bit PGM: width, height and the value of white must follow \"P5\".");
  if (columns > kMostCells / rows)
    refuseGrid(file, "has a header of " + std::to_string(columns) + " x " + std::to_string(rows) +
                         " cells, more than " + std::to_string(kMostCells) + ".");
  const auto start = in.tellg();
  in.seekg(0, std::ios::end);
  const std::int64_t left = in.tellg() - start;
  if (!in || left < columns * rows)
    refuseGrid(file, "is truncated: its header gives " + std::to_string(columns) + " x " + std::to_string(rows) +
                         " cells, but only " + std::to_string(std::max<std::int64_t>(left, 0)) + " bytes follow.");
  in.seekg(start);
  Pgm pgm{static_cast<int>(columns), static_cast<int>(rows), static_cast<int>(white), {}};
  pgm.pixels.resize(static_cast<std::size_t>(columns * rows));
  in.read(pgm.pixels.data(), static_cast<std::streamsize>(pgm.pixels.size()));
  if (!in)
    throw base::Error(base::ExitCode::damaged_input, file + ": cannot be read to its end; does the disk have errors?");
  return pgm;
}

}  // namespace

Eigen::Vector2i GridMap::cellOf(const Eigen::Vector2d& point) const {
  constexpr double kFar = 1e9;
  const Eigen::Vector2d cell = ((point - lower_left) / resolution).array().floor().max(-kFar).min(kFar);
  return cell.cast<int>();
}

Eigen::Vector2d GridMap::middleOf(const Eigen::Vector2i& cell) const {
  return lower_left + resolution * (cell.cast<double>() + Eigen::Vector2d(0.5, 0.5));
}

GridMap readGrid(const std::string& folder) {
  const std::string file = (fs::path(folder) / "grid.yaml").string();
  std::error_code none;
  if (!fs::exists(file, none))
    refuseGrid(file,
               "is missing, and without the map's occupancy grid the free space is not known. A grid needs a log with "
               "a laser.");
  const GridYaml yaml(file);
  constexpr double kSmallest = 1e-3, kLargest = 10;
  GridMap grid;
  grid.resolution = yaml.number("resolution", kSmallest, kLargest);
  const auto origin = yaml.numbers("origin");
  if (origin.size() != 3 || origin[2] != 0)
    refuseGrid(file, "\"origin\" is not x, y and a yaw of 0: rotated grids are not supported.");
  grid.lower_left = {origin[0], origin[1]};
  const double free = yaml.number("free_thresh", 0, 1, 0.196), occupied = yaml.number("occupied_thresh", 0, 1, 0.65);
  if (free > occupied)
    refuseGrid(file, "\"free_thresh\" is above \"occupied_thresh\": cells between them would be free and occupied.");
  if (const std::string mode = yaml.text("mode", "trinary"); mode != "trinary")
    refuseGrid(file, "\"mode\" is " + base::printable(mode.substr(0, 40)) + ": only mode trinary is supported.");
  const bool negate = yaml.number("negate", 0, 1, 0) != 0;
  const Pgm pgm = readPgm((fs::path(folder) / yaml.text("image")).string());
  GridCell cell_of[256];
  for (int level = 0; level < 256; ++level) {
    const double light = std::min(1.0, static_cast<double>(level) / pgm.white), occupancy = negate ? light : 1 - light;
    cell_of[level] = occupancy > occupied ? GridCell::occupied : occupancy < free ? GridCell::free : GridCell::unknown;
  }
  grid.columns = pgm.columns;
  grid.rows = pgm.rows;
  grid.cells.resize(pgm.pixels.size());
  const auto columns = static_cast<std::size_t>(grid.columns), rows = static_cast<std::size_t>(grid.rows);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column)
      grid.cells[row * columns + column] =
          cell_of[static_cast<unsigned char>(pgm.pixels[(rows - 1 - row) * columns + column])];
  return grid;
}

}  // namespace omnimapper::query
