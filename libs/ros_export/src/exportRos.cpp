#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/query/MapGrid.h>
#include <omnimapper/query/MapToAsk.h>
#include <omnimapper/ros_export/exportRos.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>

#include "MapMessages.h"
#include "McapWriter.h"
#include "definitions.h"

namespace omnimapper::ros_export {

namespace {

// Stamps of ROS count seconds since 1970 in 31 bits. A damaged map may have any.
std::uint64_t nanosecondsOf(base::Stamp stamp, const std::string& file) {
  constexpr std::int64_t kTick = 100;  // [ns] of a stamp
  const auto first = base::stampFromUnix(0);
  if (stamp < first || stamp >= base::stampFromUnix(2147483648.0))
    throw base::Error(base::ExitCode::unreadable_input,
                      file + ": has a pose before 1970 or after 2038, for which ROS has no stamps");
  return static_cast<std::uint64_t>((stamp - first).count() * kTick);
}

// The poses of the sessions that are aligned with the map, in the order of their times.
std::vector<TimedPose> posesOf(const std::string& file, std::vector<std::string>& notes) {
  const auto sections = map::MapFile::readOnly(file, {"frames", "sessions"});
  const auto* frames = sections.find("frames");
  if (!frames) throw base::Error(base::ExitCode::unreadable_input, file + ": has no key frames");
  const map::Map map = map::bareFramesFromSection(*frames);
  const auto* known = sections.find("sessions");
  const auto sessions = known ? map::sessionsFromSection(*known) : map::sessionsOfFrames(map.key_frames);
  const auto isAligned = [&](std::uint16_t number) {
    return std::none_of(sessions.begin(), sessions.end(),
                        [&](const auto& session) { return session.number == number && !session.aligned; });
  };
  std::vector<TimedPose> poses;
  std::size_t left_out = 0;
  for (const auto& pose : map::denseTrajectory(map)) {
    if (isAligned(pose.session))
      poses.emplace_back(nanosecondsOf(pose.stamp, file), pose.map_from_base);
    else
      ++left_out;
  }
  if (left_out > 0)
    notes.push_back(std::to_string(left_out) + " poses of sessions that nothing ties to the map are left out.");
  if (poses.empty()) throw base::Error(base::ExitCode::unreadable_input, file + ": has no poses");
  std::stable_sort(poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return poses;
}

std::optional<grid::GridMap> gridBeside(const std::string& folder, std::vector<std::string>& notes) {
  std::error_code none;
  if (std::filesystem::exists(std::filesystem::path(folder) / "grid.yaml", none)) return query::readGrid(folder);
  notes.push_back("The folder of the map has no grid.yaml, so /map is left out.");
  return std::nullopt;
}

void write(std::ostream& stream, const std::vector<TimedPose>& poses, const std::optional<grid::GridMap>& grid,
           const std::vector<map::Place>& places) {
  McapWriter out(stream);
  const auto topic = [&](const std::string& name, const std::string& package, const std::string& type) {
    return out.addTopic(name, package + "/msg/" + type, definitionOf(package + "/" + type));
  };
  const auto tf = topic("/tf", "tf2_msgs", "TFMessage"), odometry = topic("/odometry", "nav_msgs", "Odometry");
  const auto path = topic("/path", "nav_msgs", "Path");
  const auto markers = topic("/landmarks", "visualization_msgs", "MarkerArray");
  const std::uint64_t start = poses.front().first;
  if (grid) {
    const auto map = topic("/map", "nav_msgs", "OccupancyGrid");
    out.add(map, start, gridMessage(start, *grid));
  }
  out.add(markers, start, markersMessage(start, places));
  out.add(path, start, pathMessage(poses));
  for (const auto& pose : poses) {
    out.add(tf, pose.first, transformMessage(pose));
    out.add(odometry, pose.first, odometryMessage(pose));
  }
  out.finish();
}

}  // namespace

Exported exportRos(const std::string& path, const std::string& output) {
  const auto map = query::openMap(path);
  base::refuseToReplaceInput(output, {map.file});
  if (std::filesystem::path(output).extension() != ".mcap")
    throw base::Error(base::ExitCode::command_line,
                      output + ": what is written is an MCAP file, so its name must end in .mcap");
  Exported exported;
  const auto poses = posesOf(map.file, exported.notes);
  const auto grid = gridBeside(map.folder, exported.notes);
  base::writeFile(output, [&](std::ostream& stream) { write(stream, poses, grid, map.places.places); });
  exported.poses = poses.size();
  exported.landmarks = map.places.places.size();
  exported.has_grid = grid.has_value();
  return exported;
}

}  // namespace omnimapper::ros_export
