#pragma once

#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../Runs.h"

namespace runs {

/// A line a x + b y + c = 0 in the world, seen from above.
using TrueWall = std::array<double, 3>;

/// Lines of the upright surfaces of a simulated place. `folder` is its folder in the source tree.
inline std::vector<TrueWall> trueWalls(const std::string& folder) {
  std::vector<TrueWall> walls;
  const auto truth = nlohmann::json::parse(readFile(omnimapper::testing::sourceFile(folder + "/landmarks.json")));
  for (const auto& surface : truth["surfaces"]) {
    if (!surface.contains("normal") || std::abs(surface["normal"][2].get<double>()) > 0.01) continue;
    walls.push_back({surface["normal"][0], surface["normal"][1], surface["distance"]});
  }
  return walls;
}

/// Both ends of a wall of floorplan.geojson. For a wall in several parts these are the two points that are farthest
/// apart.
inline nlohmann::json endsOf(const nlohmann::json& geometry) {
  if (geometry["type"] == "LineString") return geometry["coordinates"];
  nlohmann::json ends;
  double longest = -1;
  for (const auto& first : geometry["coordinates"]) {
    for (const auto& second : geometry["coordinates"]) {
      for (const auto& a : first) {
        for (const auto& b : second) {
          const double distance =
              std::hypot(a[0].get<double>() - b[0].get<double>(), a[1].get<double>() - b[1].get<double>());
          if (distance > longest) longest = distance, ends = {a, b};
        }
      }
    }
  }
  return ends;
}

/// Distance [m] of the farther end of a mapped wall from the line of the true wall that fits it best.
inline double endsFromWalls(const nlohmann::json& ends, const mrpt::poses::CPose3D& world_from_map,
                            const std::vector<TrueWall>& walls) {
  double off = 1e9;
  for (const auto& [a, b, c] : walls) {
    double farthest = 0;
    for (const auto& end : ends) {
      const auto p = world_from_map.composePoint({end[0], end[1], 0});
      farthest = std::max(farthest, std::abs(a * p.x + b * p.y + c));
    }
    off = std::min(off, farthest);
  }
  return off;
}

}  // namespace runs
