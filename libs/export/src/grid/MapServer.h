#pragma once

#include <string>

#include "grid/ScanGrid.h"

namespace omnimapper::exports {

/// A grid in the form of ROS map_server: an 8-bit PGM, row 0 at the top (largest y), 254 free, 0 occupied, 205 unknown,
/// and the YAML that says where it lies.
std::string encodePgm(const ScanGrid& grid);
/// `asked_resolution` [m]: a comment says so where the grid had to be made coarser.
std::string encodeMapServerYaml(const ScanGrid& grid, const std::string& image, double asked_resolution);

}  // namespace omnimapper::exports
