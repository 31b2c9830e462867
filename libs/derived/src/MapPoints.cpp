#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/derived/MapPoints.h>
#include <omnimapper/derived/forEachScan.h>
#include <omnimapper/geometry/CubeSet.h>
#include <omnimapper/grid/ScanBeams.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace omnimapper::derived {

namespace {

using mrpt::math::TPoint3Df;
using mrpt::obs::CObservationPointCloud;

/// A map whose points differ in height by less than this [m] counts as flat.
constexpr float kFlat = 0.3f;

void addCloud(const CObservationPointCloud& cloud, double max_range, std::vector<TPoint3Df>& points) {
  if (!cloud.pointcloud) return;
  const auto& x = cloud.pointcloud->getPointsBufferRef_x();
  const auto& y = cloud.pointcloud->getPointsBufferRef_y();
  const auto& z = cloud.pointcloud->getPointsBufferRef_z();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const mrpt::math::TPoint3D in_sensor(x[i], y[i], z[i]);
    // This form of the condition also leaves out NaN.
    if (in_sensor.norm() <= max_range) points.emplace_back(cloud.sensorPose.composePoint(in_sensor));
  }
}

void addScan(const mrpt::obs::CObservation2DRangeScan& scan, double max_range, std::vector<TPoint3Df>& points) {
  const grid::BeamEnds ends(scan, {}, grid::BeamEnds::Pose::of_base);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends.hits(i) && scan.getScanRange(i) <= max_range) points.emplace_back(ends.at(i, max_range));
  }
}

bool isFlat(const std::vector<ColouredPoint>& points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const auto& a, const auto& b) { return a.in_map.z < b.in_map.z; });
  return high->in_map.z - low->in_map.z < kFlat;
}

void colourByHeight(std::vector<ColouredPoint>& points) {
  // The lowest and highest hundredth of the points do not determine the scale.
  std::vector<float> heights;
  for (const auto& point : points) {
    const float height = point.in_map.z;  // a copy: MRPT's points are packed, and a reference must be aligned
    heights.push_back(height);
  }
  const auto rank = [&](std::size_t index) {
    std::nth_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(index), heights.end());
    return heights[index];
  };
  const float low = rank(heights.size() / 100), high = rank(heights.size() - 1 - heights.size() / 100);
  for (auto& point : points) point.colour = spectrum((point.in_map.z - low) / std::max(1e-3f, high - low));
}

}  // namespace

const base::OptionTable<PointsOptions>& PointsOptions::table() {
  using Options = PointsOptions;
  static const auto table =
      base::OptionTable<Options>()
          .number("voxel_m", &Options::voxel, {0, 100},
                  "Side of the cubes in each of which one point is kept; 0 keeps all points.")
          .number("max_range_m", &Options::max_range, {0.1, 1000},
                  "Distance from the sensor beyond which points are left out.")
          .choice(
              "colour", &Options::colour,
              {{"auto", PointColour::automatic}, {"height", PointColour::height}, {"time", PointColour::time}},
              "What the colours of the points show: the height or the time of each point. auto: the camera's colours "
              "if there are depth images, else the height if the points are not all at one height, else the time.");
  return table;
}

draw::Rgb spectrum(double fraction) {
  constexpr std::array<std::array<double, 3>, 5> kStops{
      {{49, 75, 196}, {22, 152, 196}, {50, 168, 94}, {232, 178, 36}, {214, 62, 52}}};
  const double at = std::clamp(fraction, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min<std::size_t>(static_cast<std::size_t>(at), kStops.size() - 2);
  const auto channel = [&](int i) {
    const double low = kStops[below][i], high = kStops[below + 1][i];
    return static_cast<std::uint8_t>(std::lround(low + (at - static_cast<double>(below)) * (high - low)));
  };
  return {channel(0), channel(1), channel(2)};
}

bool hasClouds(const map::KeyFrame& frame) {
  return std::any_of(frame.observations.begin(), frame.observations.end(), [](const auto& observation) {
    return dynamic_cast<const CObservationPointCloud*>(observation.get()) != nullptr;
  });
}

bool hasClouds(const map::Map& map) {
  return std::any_of(map.key_frames.begin(), map.key_frames.end(),
                     [](const map::KeyFrame& frame) { return hasClouds(frame); });
}

bool hasDepthClouds(const map::Map& map) {
  return std::any_of(map.key_frames.begin(), map.key_frames.end(),
                     [](const map::KeyFrame& frame) { return !frame.cloud.empty(); });
}

std::vector<TPoint3Df> pointsInBase(const map::KeyFrame& frame, bool of_clouds, double max_range) {
  std::vector<TPoint3Df> points;
  if (of_clouds) {
    for (const auto& observation : frame.observations) {
      const auto* cloud = dynamic_cast<const CObservationPointCloud*>(observation.get());
      if (cloud) addCloud(*cloud, max_range, points);
    }
  } else {
    forEachScan(frame, [&](const auto& scan) { addScan(*scan, max_range, points); });
  }
  return points;
}

std::vector<ColouredPoint> pointsOf(const map::Map& map, const PointsOptions& options) {
  std::vector<ColouredPoint> points;
  geometry::CubeSet cubes(options.voxel);
  const bool by_camera = options.colour == PointColour::automatic && hasDepthClouds(map);
  const auto add = [&](const map::KeyFrame& frame, const mrpt::math::TPoint3D& in_base, const draw::Rgb& colour) {
    const TPoint3Df in_map(frame.map_from_base.composePoint(in_base));
    if (cubes.insert(in_map.x, in_map.y, in_map.z)) points.push_back({in_map, colour});
  };
  const auto by_time = [&](std::size_t i) {
    return spectrum(static_cast<double>(i) / std::max<double>(1, static_cast<double>(map.key_frames.size() - 1)));
  };
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) {
    for (const auto& point : map.key_frames[i].cloud)
      add(map.key_frames[i], point.inBase(), by_camera ? draw::Rgb{point.red, point.green, point.blue} : by_time(i));
  }
  const bool of_clouds = hasClouds(map);
  constexpr draw::Rgb kGrey{128, 128, 128};
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) {
    for (const TPoint3Df& in_base : pointsInBase(map.key_frames[i], of_clouds, options.max_range))
      add(map.key_frames[i], mrpt::math::TPoint3D(in_base), by_camera ? kGrey : by_time(i));
  }
  const bool by_height =
      !points.empty() && (options.colour == PointColour::height ||
                          (options.colour == PointColour::automatic && !by_camera && !isFlat(points)));
  if (by_height) colourByHeight(points);
  return points;
}

}  // namespace omnimapper::derived
