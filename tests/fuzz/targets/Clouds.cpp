#include <mrpt/obs/CObservationVelodyneScan.h>
#include <omnimapper/perception/CloudPlaneExtractor.h>

#include <cmath>

#include "../Input.h"
#include "../Targets.h"

namespace omnimapper::fuzz {

namespace {

using namespace perception;

CloudPlaneOptions takeCloudOptions(Input& input) {
  CloudPlaneOptions options;
  options.voxel = input.flag() ? 0 : input.between(0, 0.3);
  options.min_range = input.between(0, 1);
  options.max_range = input.between(2, 200);
  options.range_sigma = input.between(1e-6, 0.1);
  options.noise_at_1m = input.flag() ? 0 : input.between(0, 0.01);
  options.gate = input.between(0.1, 10);
  options.sample_cube = input.between(1e-3, 3);
  options.trials = 1 + input.below(50);
  options.seed = input.below(1000);
  options.max_gap = input.between(1e-3, 1);
  options.min_incidence = input.between(0, 1.5);
  options.min_points = 3 + input.below(60);
  options.outline = input.flag() ? CloudPlaneOptions::Outline::convex : CloudPlaneOptions::Outline::concave;
  return options;
}

// Points on planes, noise, and points whose coordinates are all from the input.
std::vector<Eigen::Vector3f> takePoints(Input& input) {
  std::vector<Eigen::Vector3f> points;
  for (int strokes = 0; !input.atEnd() && strokes < 6; ++strokes) {
    const int kind = input.take<std::uint8_t>(), count = 1 + input.below(kind < 160 ? 300 : 8);
    const auto vector = [&](double reach) {
      const double x = input.between(-reach, reach), y = input.between(-reach, reach), z = input.between(-reach, reach);
      return Eigen::Vector3d(x, y, z);
    };
    const Eigen::Vector3d corner = vector(6), along = vector(3), across = vector(3);
    const double noise = kind < 80 ? 0 : kind < 120 ? 0.02 : input.oddBetween(0, 2);
    std::uint32_t random = static_cast<std::uint32_t>(kind) * 2654435761U + 1;
    const auto share = [&] {
      random = random * 1664525U + 1013904223U;
      return (random >> 8) / 16777216.0;
    };
    for (int i = 0; i < count; ++i) {
      if (kind >= 160) {
        const auto x = input.take<float>(), y = input.take<float>(), z = input.take<float>();
        points.emplace_back(x, y, z);
        continue;
      }
      const double a = share(), b = share(), x = share(), y = share(), z = share();
      const Eigen::Vector3d off = noise * Eigen::Vector3d(x, y, z);
      points.push_back((corner + a * along + b * across + off).cast<float>());
    }
  }
  return points;
}

void requireSound(const CloudPlanes& found, std::size_t points, const CloudPlaneOptions& options) {
  require(found.labels.size() == points, "labels of another number of points");
  for (const std::uint16_t label : found.labels) require(label <= found.planes.size(), "a label without a plane");
  for (const CloudPlane& plane : found.planes) {
    require(plane.inliers >= options.min_points, "a plane of too few points");
    require(std::abs(plane.plane_in_sensor.normal.norm() - 1) < 1e-6, "a normal that is not of length 1");
    require(plane.plane_in_sensor.distance >= 0 && plane.centroid.allFinite(), "a plane that is not finite");
    require(plane.covariance.allFinite(), "a covariance that is not finite");
    for (const auto& vertex : plane.outline.vertices) require(vertex.allFinite(), "a vertex that is not finite");
  }
}

// Velodyne packets with arbitrary content.
void extractPackets(Input& input, const CloudPlaneOptions& options) {
  mrpt::obs::CObservationVelodyneScan scan;
  scan.sensorLabel = "velodyne";
  if (input.flag())
    scan.calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration(input.flag() ? "VLP16" : "HDL32");
  scan.minRange = input.between(0, 2);
  scan.maxRange = input.oddBetween(2, 130);
  scan.scan_packets.resize(static_cast<std::size_t>(input.below(3)));
  for (auto& packet : scan.scan_packets) {
    auto* bytes = reinterpret_cast<std::uint8_t*>(&packet);
    for (std::size_t i = 0; i < sizeof packet; ++i)
      bytes[i] = input.left() > 0 ? input.rest()[(i + i / 100) % input.left()] : static_cast<std::uint8_t>(0);
    // The headers of the blocks, without which a block is not read.
    for (auto& block : packet.blocks) {
      auto* mark = reinterpret_cast<std::uint8_t*>(&block);
      mark[0] = 0xff;
      mark[1] = 0xee;
    }
  }
  mayRefuse([&] {
    const auto found = CloudPlaneExtractor(options, {}).planesOf(scan);
    for (const auto& plane : found->planes) require(plane.centroid.allFinite(), "a plane that is not finite");
  });
}

}  // namespace

void clouds(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const int work = input.take<std::uint8_t>() % 8;
  const CloudPlaneOptions options = takeCloudOptions(input);
  mayRefuse([&] {
    if (work == 0) return extractPackets(input, options);
    const auto points = takePoints(input);
    requireSound(CloudPlaneFinder(options).find(points), points.size(), options);
  });
}

}  // namespace omnimapper::fuzz
