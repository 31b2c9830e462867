#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/perception/EdgeImage.h>
#include <omnimapper/sim/Simulation.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "EdgePeers.h"

namespace omnimapper::bench {

/// Bit of pixels for which curvature edges are undetermined, because one of the surfaces that meet there is not flat.
constexpr std::uint8_t kUndetermined = 128;

/// A frame of a simulated camera, and the true edges in it.
struct TrueEdges {
  RgbdFrame frame;
  std::vector<std::uint8_t> labels;  ///< bits of perception::EdgeKind, and kUndetermined
};

/// Edges of the exact geometry of a simulated place.
/// - Depth discontinuity: the plane of each of two 8-connected neighbours (the depth, if its surface is not flat),
///   extended to the ray of the other one, misses the other by at least `least_discontinuity` of the nearer depth. The
///   edge pixels are the first measured ones on either side that are on the same surface.
/// - Curvature edge: the planes of two 4-connected neighbours meet there at an angle of at least `least_turn` [rad].
/// - Boundary: one of two neighbours is out of the camera's range (nearer than `nearest`, beyond its largest range, or
///   without a surface), and the other is not.
class EdgeTruth {
 public:
  EdgeTruth(const sim::Simulation& simulation, double least_discontinuity, double least_turn, double nearest)
      : simulation_(simulation),
        surfaces_(sim::numberSurfaces(simulation.world())),
        least_discontinuity_(least_discontinuity),
        least_turn_(least_turn),
        nearest_(nearest) {}

  TrueEdges at(const sim::Sensor& camera, int k) {
    const sim::Measurement measurement = camera.measure(k);
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*measurement.observation);
    names_ = decode(measurement.truth_files.at(0).bytes);
    depths_ = decode(measurement.truth_files.at(1).bytes);
    TrueEdges result{frameOf(scan), {}};
    frame_ = &result.frame;
    farthest_ = static_cast<double>(scan.maxRange);
    result.labels.assign(result.frame.units.size(), 0);
    const geometry::Se3 map_from_optical = *simulation_.mapFromBase().at(camera.timeOf(k)) *
                                           geometry::fromMrpt(scan.sensorPose) * geometry::sensorFromOptical();
    planes_.clear();
    for (int y = 0; y < frame_->height; ++y) {
      for (int x = 0; x < frame_->width; ++x) {
        for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}}) {
          if (x + dx >= 0 && x + dx < frame_->width && y + dy < frame_->height)
            judge(x, y, dx, dy, camera.timeOf(k), geometry::inverse(map_from_optical), result.labels);
        }
      }
    }
    return result;
  }

 private:
  using Plane = std::optional<geometry::Plane3>;

  static cv::Mat decode(const std::string& png) {
    return cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_UNCHANGED);
  }

  static RgbdFrame frameOf(const mrpt::obs::CObservation3DRangeScan& scan) {
    const auto& c = scan.cameraParams;
    RgbdFrame frame{static_cast<int>(c.ncols),
                    static_cast<int>(c.nrows),
                    scan.rangeUnits,
                    {c.fx(), c.fy(), c.cx(), c.cy()},
                    0,
                    0,
                    {},
                    {}};
    for (int y = 0; y < frame.height; ++y) {
      const std::uint8_t* row = scan.intensityImage.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
      for (int x = 0; x < frame.width; ++x) {
        frame.units.push_back(scan.rangeImage(y, x));
        for (const int channel : {2, 1, 0}) frame.rgb.push_back(row[3 * x + channel]);
      }
    }
    return frame;
  }

  double depth(int x, int y) const { return 0.0002 * depths_.at<std::uint16_t>(y, x); }
  bool inRange(int x, int y) const { return depth(x, y) >= nearest_ && depth(x, y) <= farthest_; }
  int name(int x, int y) const { return names_.at<std::uint16_t>(y, x); }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * frame_->width + x); }

  Plane planeInOptical(int label, double time, const geometry::Se3& optical_from_map) {
    const auto known = planes_.find(label);
    if (known != planes_.end()) return known->second;
    const auto ref = surfaces_.at(static_cast<std::size_t>(label) - 1);
    const sim::Body& body = simulation_.world().bodies[static_cast<std::size_t>(ref.body)];
    const auto& face = body.surfaces[static_cast<std::size_t>(ref.surface)].face;
    const auto map_from_body = body.track.at(time);
    Plane plane;
    if (face && map_from_body) plane = optical_from_map * (*map_from_body * face->plane_in_body);
    return planes_[label] = plane;
  }

  // Distance [m] by which the other pixel is behind the extended surface of pixel (x, y); negative if it is in front.
  double behind(const Plane& plane, int x, int y, int other_x, int other_y) const {
    if (!plane) return depth(other_x, other_y) - depth(x, y);
    const camera::Pinhole& c = frame_->camera;
    const Eigen::Vector3d ray((other_x - c.cx) / c.fx, (other_y - c.cy) / c.fy, 1);
    const double facing = plane->normal.dot(ray), on_plane = -plane->distance / facing;
    // If the ray does not meet the plane, the other pixel counts as far in front of it.
    return on_plane > 0 ? depth(other_x, other_y) - on_plane : -1e9;
  }

  void judge(int x, int y, int dx, int dy, double time, const geometry::Se3& optical_from_map,
             std::vector<std::uint8_t>& labels) {
    const int rx = x + dx, ry = y + dy;
    if (inRange(x, y) != inRange(rx, ry)) {
      inRange(x, y) ? mark(x, y, -dx, -dy, perception::kBoundary, labels)
                    : mark(rx, ry, dx, dy, perception::kBoundary, labels);
      return;
    }
    if (depth(x, y) == 0 || depth(rx, ry) == 0 || name(x, y) == name(rx, ry)) return;
    const Plane here = planeInOptical(name(x, y), time, optical_from_map),
                there = planeInOptical(name(rx, ry), time, optical_from_map);
    const double one = behind(here, x, y, rx, ry), other = -behind(there, rx, ry, x, y);
    const double least = least_discontinuity_ * std::min(depth(x, y), depth(rx, ry));
    if ((one > least && other > least) || (one < -least && other < -least)) {
      mark(x, y, -dx, -dy, one > 0 ? perception::kOccluding : perception::kOccluded, labels);
      mark(rx, ry, dx, dy, one > 0 ? perception::kOccluded : perception::kOccluding, labels);
    } else if (!here || !there) {
      labels[index(x, y)] |= kUndetermined;
    } else if ((dx == 0 || dy == 0) && std::min(std::abs(one), std::abs(other)) < 0.25 * least &&
               std::acos(std::min(1.0, here->normal.dot(there->normal))) >= least_turn_ &&
               frame_->units[index(x, y)] != 0) {
      labels[index(x, y)] |= perception::kHighCurvature;
    }
  }

  // Labels the first measured pixel from (x, y) in direction (dx, dy), unless another surface begins before it.
  void mark(int x, int y, int dx, int dy, std::uint8_t kind, std::vector<std::uint8_t>& labels) const {
    const int surface = name(x, y);
    for (; x >= 0 && y >= 0 && x < frame_->width && y < frame_->height && name(x, y) == surface; x += dx, y += dy) {
      if (frame_->units[index(x, y)] == 0) continue;
      labels[index(x, y)] |= kind;
      return;
    }
  }

  const sim::Simulation& simulation_;
  std::vector<sim::SurfaceRef> surfaces_;
  double least_discontinuity_, least_turn_, nearest_, farthest_ = 0;
  std::map<int, Plane> planes_;
  cv::Mat names_, depths_;
  const RgbdFrame* frame_ = nullptr;
};

}  // namespace omnimapper::bench
