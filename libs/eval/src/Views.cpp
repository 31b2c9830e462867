#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/eval/Views.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/perception/PlaneSegmenter.h>
#include <omnimapper/source/openLogs.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "CoveredSurface.h"

namespace omnimapper::eval {

namespace {

using geometry::Se3;
using mrpt::obs::CObservation3DRangeScan;

std::vector<Eigen::Vector3d> inWorld(const Se3& world_from_optical, const perception::Contour& contour) {
  std::vector<Eigen::Vector3d> polygon;
  for (const auto& point : contour.polygon_in_sensor.vertices) polygon.push_back(world_from_optical * point);
  return polygon;
}

/// One image with the pose that it was taken from.
class PosedImage {
 public:
  PosedImage(const camera::DepthImage& image, const Se3& world_from_optical, const ViewOptions& options)
      : image_(image), world_from_optical_(world_from_optical), options_(options) {}

  std::vector<ViewPlane> planes(const perception::PlaneSegmentation& found) const {
    std::vector<ViewPlane> planes;
    for (const auto& region : found.planes) planes.push_back(planeOf(region));
    for (int y = 0; y < found.height; y += options_.pixels_of_point) {
      for (int x = 0; x < found.width; x += options_.pixels_of_point) {
        const std::uint16_t label = found.labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(found.width) +
                                                 static_cast<std::size_t>(x)];
        if (label == 0) continue;
        ViewPlane& plane = planes[label - 1U];
        const Eigen::Vector3d point = world_from_optical_ * pointAt(x, y);
        if (counts(plane.surface.plane, point)) plane.points.push_back(point);
      }
    }
    return planes;
  }

 private:
  // Point of a pixel in the optical frame [m]. The pixel must have a depth, as pixels on planes have.
  Eigen::Vector3d pointAt(int x, int y) const {
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width()) + static_cast<std::size_t>(x);
    const double z = image_.units() ? image_.units()[i] * image_.metresPerUnit() : image_.metres()[i];
    const auto& camera = image_.camera();
    return {z * (x - camera.cx) / camera.fx, z * (y - camera.cy) / camera.fy, z};
  }
  bool counts(const geometry::Plane3& plane, const Eigen::Vector3d& point) const {
    const Eigen::Vector3d to_camera = world_from_optical_.translation - point;
    const double range = to_camera.norm();
    return range <= options_.max_range && plane.normal.dot(to_camera) >= std::cos(options_.max_slant) * range;
  }
  ViewPlane planeOf(const perception::PlaneRegion& region) const {
    ViewPlane seen;
    surfaces::Surface& surface = seen.surface;
    surface.name = "a plane of an image";
    surface.plane = world_from_optical_ * region.plane_in_sensor;
    auto& part = surface.parts.emplace_back();
    part.outline = inWorld(world_from_optical_, region.outline);
    for (const auto& hole : region.holes) part.holes.push_back(inWorld(world_from_optical_, hole));
    surfaces::CellGrid outlined = gridAround(surface, part.outline, options_.cell);
    outlined.fill(part.outline, part.holes);
    surface.seen.emplace(outlined.origin(), outlined.u(), outlined.v(), outlined.cell(), outlined.columns(),
                         outlined.rows());
    forEachSetCell(outlined, [&](const Eigen::Vector3d& middle, surfaces::CellGrid::Cell cell) {
      if (counts(surface.plane, middle)) surface.seen->set(cell);
    });
    return seen;
  }

  const camera::DepthImage& image_;
  const Se3& world_from_optical_;
  const ViewOptions& options_;
};

/// Collects views; when there are too many, every second one is dropped.
class ThinnedViews {
 public:
  explicit ThinnedViews(std::size_t most) : most_(std::max<std::size_t>(1, most)) {}
  /// Whether the next image is used.
  bool wantsNext() { return count_++ % step_ == 0; }
  void add(View view) {
    views_.push_back(std::move(view));
    if (views_.size() <= most_) return;
    std::vector<View> kept;
    for (std::size_t i = 0; i < views_.size(); i += 2) kept.push_back(std::move(views_[i]));
    views_ = std::move(kept);
    step_ *= 2;
  }
  std::vector<View> take() { return std::move(views_); }

 private:
  std::size_t most_, step_ = 1, count_ = 0;
  std::vector<View> views_;
};

std::optional<Se3> poseAt(const Trajectory& trajectory, base::Stamp stamp, const ViewOptions& options) {
  if (options.longest_gap > base::Duration(0)) return interpolatedPose(trajectory, stamp, options.longest_gap);
  const auto nearest = nearestPose(trajectory, stamp, options.tolerance);
  if (!nearest) return std::nullopt;
  return trajectory[*nearest].world_from_body;
}

View viewOf(const CObservation3DRangeScan& scan, const Se3& world_from_base,
            const perception::PlaneSegmenter& segmenter, const ViewOptions& options) {
  const camera::RgbdView image(scan);
  const Se3 world_from_optical = world_from_base * geometry::fromMrpt(scan.sensorPose) * geometry::sensorFromOptical();
  return {scan.sensorLabel + " at " + base::formatUnix(scan.timestamp),
          PosedImage(image.depth(), world_from_optical, options).planes(segmenter.segment(image.depth()))};
}

void refuseNone(const LogViews& views, const std::string& log, const Trajectory& trajectory, base::Stamp first,
                base::Stamp last) {
  if (views.images == 0) {
    throw base::Error(base::ExitCode::unreadable_input,
                      log + ": holds no depth image; the log must be of a depth camera" +
                          (views.message.empty() ? "" : "\n" + views.message));
  }
  if (views.posed > 0) return;
  if (trajectory.empty())
    throw base::Error(base::ExitCode::unreadable_input,
                      log + ": no depth image has a pose, because the trajectory is empty");
  throw base::Error(base::ExitCode::unreadable_input,
                    log + ": no depth image has a pose: the images are of " + base::formatUnix(first) + " to " +
                        base::formatUnix(last) + ", the poses of " + base::formatUnix(trajectory.front().stamp) +
                        " to " + base::formatUnix(trajectory.back().stamp) +
                        "; are they of the same log, or is the tolerance too small?");
}

}  // namespace

LogViews readViews(const std::string& log, const Trajectory& trajectory, const ViewOptions& options,
                   base::Progress& progress, const std::function<bool()>& stop) {
  LogViews result;
  ThinnedViews views(options.most_views);
  const perception::PlaneSegmenter segmenter({});
  const auto source = source::openLogs({log}, {}, stop);
  base::Stamp first, last;
  while (const auto observation = source->next()) {
    if (stop()) throw base::Error(base::ExitCode::interrupted, "interrupted; nothing was judged");
    progress.report(source->progress(), "reading views");
    const auto scan = std::dynamic_pointer_cast<const CObservation3DRangeScan>(observation);
    if (!scan || !scan->hasRangeImage) continue;
    last = scan->timestamp;
    if (result.images++ == 0) first = last;
    const auto world_from_base = poseAt(trajectory, scan->timestamp, options);
    if (!world_from_base) continue;
    ++result.posed;
    if (views.wantsNext()) views.add(viewOf(*scan, *world_from_base, segmenter, options));
  }
  const auto report = source->report();
  result.code = report.exitCode();
  result.message = report.message;
  refuseNone(result, log, trajectory, first, last);
  result.views = views.take();
  return result;
}

}  // namespace omnimapper::eval
