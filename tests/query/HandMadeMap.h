#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/query/MapToAsk.h>
#include <omnimapper/query/Verbs.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace omnimapper::query {

inline map::Place signAt(double x, double y, const std::string& caption, const std::string& words = "") {
  map::Place sign;
  sign.kind = sign.label = "sign";
  sign.caption = caption;
  if (!words.empty()) sign.properties = {{"words", words}};
  sign.position = {x, y, 1.5};
  sign.extent.points = {{x, y}};
  sign.extent.bottom = sign.extent.top = 1.5;
  sign.measurements = 7;
  sign.seen_by = {{"camera", 7}};
  sign.last_seen = base::stampFromUnix(1'700'000'000);
  return sign;
}

inline map::Place wallFrom(double x, double y, double to_x, double to_y) {
  map::Place wall;
  wall.kind = wall.label = "wall";
  wall.position = {(x + to_x) / 2, (y + to_y) / 2, 0.3};
  wall.extent.lines = {{{x, y}, {to_x, to_y}}};
  return wall;
}

/// Places with ids in this order.
inline map::Places placesOf(std::vector<map::Place> places) {
  map::Places all;
  for (auto& place : places) {
    place.id = {0, static_cast<std::uint32_t>(all.places.size())};
    all.places.push_back(place);
  }
  all.last_pose = map::LastPose{1, 1, 0, base::stampFromUnix(1'700'000'100), 0};
  return all;
}

inline void putFile(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Writes grid.yaml and grid.pgm from rows of characters, the first one at the top: '#' occupied, '.' free, else
/// unknown. The lower left corner is at the origin.
inline void putGrid(const std::string& folder, const std::vector<std::string>& rows, const std::string& resolution) {
  std::string pgm =
      "P5\n# made by hand\n" + std::to_string(rows.front().size()) + " " + std::to_string(rows.size()) + "\n255\n";
  for (const auto& row : rows)
    for (const char c : row) pgm += static_cast<char>(c == '#' ? 0 : c == '.' ? 254 : 205);
  putFile(folder + "/grid.pgm", pgm);
  putFile(folder + "/grid.yaml", "image: grid.pgm\nresolution: " + resolution +
                                     "\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n"
                                     "free_thresh: 0.196\nmode: trinary\n");
}

/// The message of an Error; empty if nothing is thrown.
inline std::string refusalOf(const std::function<void()>& act, base::ExitCode code) {
  try {
    act();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return {};
}

}  // namespace omnimapper::query
