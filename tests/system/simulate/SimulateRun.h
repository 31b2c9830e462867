#pragma once

#include <omnimapper/source/RawlogSource.h>

#include <functional>
#include <map>

#include "../Runs.h"

/// Runs omnimapper-simulate as a user does.
namespace runs {

/// Two rooms with a door between them, a table, a laser, a small camera and odometry, for a few seconds.
inline const char* const kSmallWorld = R"([simulation]
sensors = laser, camera, odometry
duration_s = 6
[world]
rooms = hall, kitchen
doors = door_1
furniture = table_1
[hall]
class = room
rectangle_m = 0 0 5 4
number = 118
[kitchen]
class = room
rectangle_m = 5.15 0 8 4
[door_1]
class = door
rooms = hall, kitchen
x_m = 5
y_m = 2
[table_1]
class = table
x_m = 2.5
y_m = 3.3
[robot]
mode = waypoints
start = 1 1
waypoints = 1 1, kitchen
[laser]
class = Laser2d
model = hokuyo_utm30
z_m = 0.4
rate_hz = 5
[camera]
class = RgbdCamera
width_px = 160
height_px = 120
labels = true
z_m = 1
rate_hz = 2
[odometry]
class = Odometry
rate_hz = 20
)";

inline Ended simulate(const Texts& arguments, const ProgramOptions& options = {}) {
  Texts words{omnimapper::testing::ownProgram("omnimapper-simulate")};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return omnimapper::testing::runProgram(words, options);
}

/// The bytes of every file below a folder, by its path relative to the folder.
inline std::map<std::string, std::string> contentOf(const std::string& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) content[fs::relative(entry.path(), folder).string()] = readFile(entry.path().string());
  }
  return content;
}

/// Reads a whole rawlog, calls `visit` for each observation, and returns the report of the source.
inline omnimapper::source::SourceReport readLog(const std::string& path,
                                                const std::function<void(const mrpt::obs::CObservation&)>& visit = {}) {
  omnimapper::source::RawlogSource source(path);
  while (const auto observation = source.next()) {
    if (visit) visit(*observation);
  }
  return source.report();
}

}  // namespace runs
