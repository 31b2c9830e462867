// A mirror on a wall, which to a laser is an opening into a mirrored copy of the room.
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>

#include <cmath>
#include <limits>

#include "../MapFolder.h"
#include "TrueWalls.h"

namespace {

using namespace runs;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;
using omnimapper::testing::sourceFile;

// rawlogs/box is a room without furniture. The mirror covers the wall x = kLength from y = kMirrorFrom to y =
// kMirrorTo.
constexpr double kLength = 6, kWidth = 7, kMirrorFrom = 2, kMirrorTo = 5;  // [m]

// Distance from a place in the room to its wall, in lengths of the vector (dx, dy).
double toWall(double x, double y, double dx, double dy) {
  const double along_x = dx > 0 ? (kLength - x) / dx : dx < 0 ? -x / dx : std::numeric_limits<double>::infinity();
  const double along_y = dy > 0 ? (kWidth - y) / dy : dy < 0 ? -y / dy : std::numeric_limits<double>::infinity();
  return std::min(along_x, along_y);
}

// Length [m] of a beam after its reflection; 0 if it does not meet the mirror.
double beyondMirror(const CPose3D& world_from_sensor, double bearing) {
  const double yaw = world_from_sensor.yaw() + bearing, dx = std::cos(yaw), dy = std::sin(yaw);
  const double range = toWall(world_from_sensor.x(), world_from_sensor.y(), dx, dy);
  const double x = world_from_sensor.x() + range * dx, y = world_from_sensor.y() + range * dy;
  const bool meets = x > kLength - 1e-6 && y > kMirrorFrom && y < kMirrorTo;
  return meets ? toWall(x - 1e-9, y, -dx, dy) : 0;
}

void writeMirrored(const std::string& rawlog, const omnimapper::eval::Trajectory& truth) {
  omnimapper::source::RawlogSource log(sourceFile("rawlogs/box/box.rawlog"));
  omnimapper::source::writeRawlog(rawlog, [&](omnimapper::source::RawlogWriter& out) {
    while (const auto observation = log.next()) {
      if (auto* scan = dynamic_cast<CObservation2DRangeScan*>(observation.get())) {
        const auto at = omnimapper::eval::nearestPose(truth, scan->timestamp, std::chrono::milliseconds(1));
        ASSERT_TRUE(at);
        const auto world_from_sensor = omnimapper::geometry::toMrpt(truth[*at].world_from_body) + scan->sensorPose;
        const auto beams = scan->getScanSize();
        for (std::size_t i = 0; i < beams; ++i) {
          const double bearing = scan->aperture * (static_cast<double>(i) / static_cast<double>(beams - 1) - 0.5);
          const double more = beyondMirror(world_from_sensor, scan->rightToLeft ? bearing : -bearing);
          scan->setScanRange(i, scan->getScanRange(i) + static_cast<float>(more));
        }
      }
      out.add(*observation);
    }
  });
}

// The reflection is mapped as a room, because a laser cannot distinguish it. The real room and the trajectory are
// right.
TEST(Mirror, TheRoomBeforeItIsMappedAsItIs) {
  const omnimapper::testing::ScratchFolder scratch;
  const auto truth = omnimapper::eval::readTum(sourceFile("rawlogs/box/truth.tum"));
  writeMirrored(scratch / "mirror.rawlog", truth);
  ASSERT_TRUE(endedWith(ExitCode::ok, graphslam({"-i", sourceFile("ini/laser_walls.ini"), "-r",
                                                 scratch / "mirror.rawlog", "-o", scratch / "map"})));
  omnimapper::eval::PairingOptions pairing;
  pairing.alignment = omnimapper::eval::Alignment::se3;
  const auto error = omnimapper::eval::absoluteTrajectoryError(
      omnimapper::eval::readTum(scratch / "map/trajectory.tum"), truth, pairing);
  EXPECT_LT(error.translation.rmse, 0.02);

  const CPose3D world_from_map = omnimapper::geometry::toMrpt(truth.front().world_from_body);
  auto missing = trueWalls("rawlogs/box");
  const auto walls = missing;
  int behind = 0;
  const auto plan = nlohmann::json::parse(readFile(scratch / "map/floorplan.geojson"));
  for (const auto& feature : plan["features"]) {
    if (feature["properties"].value("label", "") != "wall") continue;
    const auto ends = endsOf(feature["geometry"]);
    double farthest_x = 0;
    for (const auto& end : ends) farthest_x = std::max(farthest_x, world_from_map.composePoint({end[0], end[1], 0}).x);
    if (farthest_x > kLength + 0.1) {
      ++behind;
      continue;
    }
    EXPECT_LT(endsFromWalls(ends, world_from_map, walls), 0.05)
        << "the map has a wall in the room that does not exist: " << feature;
    missing.erase(std::remove_if(missing.begin(), missing.end(),
                                 [&](const auto& wall) { return endsFromWalls(ends, world_from_map, {wall}) < 0.05; }),
                  missing.end());
  }
  EXPECT_LE(missing.size(), 2U) << "walls that are collinear with their reflection count as beyond the mirror";
  EXPECT_GT(behind, 0) << "otherwise nothing was mirrored";
}

}  // namespace
