#include <omnimapper/grid/GridMap.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "GridImage.h"
#include "MapServerYaml.h"

namespace omnimapper::grid {

namespace {

namespace fs = std::filesystem;

/// How the levels of an image become probabilities that a cell is occupied, and these become cells.
struct Interpretation {
  std::string mode;
  bool negate = false;
  double free = 0, occupied = 0;

  std::optional<double> occupancy(int level, int white) const {
    constexpr int kLargestRaw = 100;
    if (mode == "raw") return level <= kLargestRaw ? std::optional<double>(level / 100.0) : std::nullopt;
    const double light = std::min(1.0, static_cast<double>(level) / white);
    return negate ? light : 1 - light;
  }
  GridCell cell(int level, int white) const {
    const auto probability = occupancy(level, white);
    if (!probability) return GridCell::unknown;
    return *probability > occupied ? GridCell::occupied : *probability < free ? GridCell::free : GridCell::unknown;
  }
};

Interpretation interpretationOf(const MapServerYaml& yaml) {
  Interpretation result;
  result.mode = yaml.text("mode", "trinary");
  if (result.mode != "trinary" && result.mode != "scale" && result.mode != "raw")
    yaml.refuse("\"mode\" is none of trinary, scale and raw.");
  result.negate = yaml.number("negate", 0, 1, 0) != 0;
  result.free = yaml.number("free_thresh", 0, 1, 0.196);
  result.occupied = yaml.number("occupied_thresh", 0, 1, 0.65);
  if (result.free > result.occupied)
    yaml.refuse("\"free_thresh\" is above \"occupied_thresh\": cells between them would be free and occupied.");
  return result;
}

geometry::Se2 originOf(const MapServerYaml& yaml) {
  const auto origin = yaml.numbers("origin");
  if (origin.size() != 3) yaml.refuse("\"origin\" is not x, y and yaw.");
  return {origin[0], origin[1], geometry::wrapToPi(origin[2])};
}

std::vector<GridCell> cellsOf(const GridImage& image, const Interpretation& meaning) {
  std::array<GridCell, 256> cell_of{};
  for (int level = 0; level < 256; ++level) cell_of[level] = meaning.cell(level, image.white);
  const auto columns = static_cast<std::size_t>(image.columns), rows = static_cast<std::size_t>(image.rows);
  std::vector<GridCell> cells(columns * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t pixel = (rows - 1 - row) * columns + column;
      const bool is_shown = meaning.mode == "trinary" || image.opaque.empty() || image.opaque[pixel] != 0;
      if (is_shown) cells[row * columns + column] = cell_of[image.levels[pixel]];
    }
  }
  return cells;
}

}  // namespace

Eigen::Vector2i GridMap::cellOf(const Eigen::Vector2d& point) const {
  constexpr double kFar = 1e9;
  const Eigen::Vector2d in_grid = geometry::inverse(map_from_grid) * point;
  const Eigen::Vector2d cell = (in_grid / resolution).array().floor().max(-kFar).min(kFar);
  return cell.cast<int>();
}

Eigen::Vector2d GridMap::middleOf(const Eigen::Vector2i& cell) const {
  return map_from_grid * Eigen::Vector2d(resolution * (cell.cast<double>() + Eigen::Vector2d(0.5, 0.5)));
}

GridMap readGridMap(const std::string& yaml_file) {
  const MapServerYaml yaml(yaml_file);
  constexpr double kSmallest = 1e-3, kLargest = 10;
  GridMap grid;
  grid.resolution = yaml.number("resolution", kSmallest, kLargest);
  grid.map_from_grid = originOf(yaml);
  const Interpretation meaning = interpretationOf(yaml);
  const GridImage image = readGridImage((fs::path(yaml_file).parent_path() / yaml.text("image")).string());
  grid.columns = image.columns;
  grid.rows = image.rows;
  grid.cells = cellsOf(image, meaning);
  return grid;
}

}  // namespace omnimapper::grid
