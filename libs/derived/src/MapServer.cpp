#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/MapServer.h>

namespace omnimapper::derived {

std::string encodePgm(const ScanGrid& grid) {
  constexpr unsigned char kLevels[] = {205, 254, 0};  // in the order of Cell: unknown, free, occupied
  std::string out = "P5\n" + std::to_string(grid.columns) + " " + std::to_string(grid.rows) + "\n255\n";
  out.reserve(out.size() + grid.cells.size());
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) {
      out.push_back(static_cast<char>(kLevels[static_cast<int>(grid.at(column, row))]));
    }
  }
  return out;
}

std::string encodeMapServerYaml(const ScanGrid& grid, const std::string& image, double asked_resolution) {
  std::string out;
  if (grid.resolution > asked_resolution) {
    out += "# Warning: cells of " + base::brief(asked_resolution) +
           " m were requested, but the map is so large that they are " + base::brief(grid.resolution) +
           " m. Raise max_megacells to change that.\n";
  }
  out += "image: " + image + "\n";
  out += "resolution: " + base::brief(grid.resolution, 9) + "\n";
  out += "origin: [" + base::fixed(grid.min_x, 6) + ", " + base::fixed(grid.min_y, 6) + ", 0.0]\n";
  out += "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n";
  return out;
}

}  // namespace omnimapper::derived
