#pragma once

#include <omnimapper/derived/ScanGrid.h>

#include <string>

namespace omnimapper::derived {

/// A grid for ROS map_server: an 8-bit PGM, row 0 at the top (largest y), 254 free, 0 occupied, 205 unknown.
std::string encodePgm(const ScanGrid& grid);
/// The YAML with the place of the grid. If the cells had to be made coarser than `asked_resolution` [m], a comment says
/// so.
std::string encodeMapServerYaml(const ScanGrid& grid, const std::string& image, double asked_resolution);

}  // namespace omnimapper::derived
