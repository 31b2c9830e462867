#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/perception/ObjectExtractor.h>
#include <omnimapper/perception/viewOf.h>

#include "planes/FoundPlanes.h"
#include "planes/PlaneObservation.h"

namespace omnimapper::perception {

const base::OptionTable<ObjectPointOptions>& ObjectPointOptions::table() {
  static const auto table = base::OptionTable<ObjectPointOptions>().integer(
      "max_points", &ObjectPointOptions::max_points, {1, 1e9}, "Largest number of points that are kept of an object.");
  return table;
}

const base::OptionTable<PlaneReuseOptions>& PlaneReuseOptions::table() {
  static const auto table = base::OptionTable<PlaneReuseOptions>().choice(
      "reuse_planes", &PlaneReuseOptions::reuse,
      {{"same_options", Reuse::same_options}, {"any_options", Reuse::any_options}},
      "Which planes that an earlier extractor of [perception] has found in the same image are used instead of finding "
      "planes anew: those found with the same options as this section's, or those found with any options.");
  return table;
}

namespace {

Eigen::Vector3d upInOptical(const mrpt::poses::CPose3D& base_from_sensor) {
  const Eigen::Matrix3d base_from_optical =
      base_from_sensor.getRotationMatrix().asEigen() * geometry::sensorFromOptical().rotation.toRotationMatrix();
  return base_from_optical.transpose() * Eigen::Vector3d::UnitZ();
}

Eigen::Vector3d pointOf(const camera::DepthImage& image, int pixel, double depth) {
  const camera::Pinhole& camera = image.camera();
  const int x = pixel % image.width(), y = pixel / image.width();
  return {(x - camera.cx) / camera.fx * depth, (y - camera.cy) / camera.fy * depth, depth};
}

// Adds points with colours, at most max_points, and the mean colour of all pixels.
void addPoints(const ObjectRegion& region, const camera::RgbdView& view, int max_points, obs::ObservedObject& object) {
  const camera::DepthImage& depth = view.depth();
  const int count = static_cast<int>(region.pixels.size()), step = (count + max_points - 1) / max_points;
  camera::ColourSum sum;
  for (int i = 0; i < count; ++i) {
    const int pixel = region.pixels[static_cast<std::size_t>(i)];
    const double z = depth.at(static_cast<std::size_t>(pixel));
    const auto colour = view.colours().at(pixel % depth.width(), pixel / depth.width(), z);
    if (colour) sum.add(*colour);
    if (i % step != 0) continue;
    object.points.push_back(camera::toSensor(pointOf(depth, pixel, z)).cast<float>());
    if (colour) object.colours.push_back(*colour);
  }
  if (object.colours.size() != object.points.size()) object.colours.clear();
  object.colour = sum.mean();
}

}  // namespace

ObjectExtractor::Found ObjectExtractor::objectsOn(const PlaneSegmentation& planes,
                                                  const mrpt::obs::CObservation3DRangeScan& scan,
                                                  const camera::RgbdView& view) const {
  Found found;
  found.objects = obs::CObservationObjects::Create();
  found.objects->timestamp = scan.timestamp;
  found.objects->sensorPose = scan.sensorPose;
  found.objects->sensorLabel = scan.sensorLabel + kObjectsSuffix;
  found.objects->source_label = scan.sensorLabel;
  const geometry::Se3 sensor_from_optical = geometry::sensorFromOptical();
  const Eigen::Matrix3d turn = sensor_from_optical.rotation.toRotationMatrix();
  const Eigen::Vector3d up = upInOptical(scan.sensorPose);
  found.has_surface = finder_.hasSurface(planes, up);
  for (const ObjectRegion& region : finder_.find(view.depth(), planes, up)) {
    obs::ObservedObject object;
    object.centroid = camera::toSensor(region.centroid);
    object.covariance = turn * region.covariance * turn.transpose();
    object.sensor_from_box = sensor_from_optical * region.sensor_from_box;
    object.box_size = region.box_size;
    if (region.surface) object.supporting_plane = static_cast<std::uint32_t>(*region.surface);
    addPoints(region, view, options_.points.max_points, object);
    found.objects->objects.push_back(std::move(object));
  }
  return found;
}

ObjectExtractor::Found ObjectExtractor::extract(const mrpt::obs::CObservation3DRangeScan& scan) const {
  const camera::RgbdView view(scan);
  const PlaneSegmentation planes = segmenter_.segment(view.depth());
  Found found = objectsOn(planes, scan, view);
  found.planes = planes::observe(planes, scan, view, options_.outlines.tolerance);
  return found;
}

bool ObjectExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> ObjectExtractor::extract(const mrpt::obs::CObservation& raw) const {
  Blackboard board;
  return extractUsing(raw, board);
}

std::vector<mrpt::obs::CObservation::Ptr> ObjectExtractor::extractUsing(const mrpt::obs::CObservation& raw,
                                                                        Blackboard& board) const {
  using planes::FoundPlanes;
  const auto& scan = *camera::depthScanOf(raw);
  const camera::RgbdView& view = viewOf(scan, board);
  auto known = board.find<FoundPlanes>([&](const auto& one) {
    return options_.reuse.reuse == PlaneReuseOptions::Reuse::any_options || one.settings == options_.planeSettings();
  });
  std::vector<mrpt::obs::CObservation::Ptr> made;
  if (!known) {
    known =
        std::make_shared<const FoundPlanes>(FoundPlanes{options_.planeSettings(), segmenter_.segment(view.depth())});
    board.put(known);
    made.push_back(planes::observe(known->planes, scan, view, options_.outlines.tolerance));
  }
  const Found found = objectsOn(known->planes, scan, view);
  ++scans_;
  with_surface_ += found.has_surface;
  made.push_back(found.objects);
  return made;
}

std::vector<DerivedName> ObjectExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + kPlanesSuffix},
          {CLASS_ID(obs::CObservationObjects), raw.sensorLabel + kObjectsSuffix}};
}

std::vector<std::string> ObjectExtractor::warnings() const {
  if (scans_ == 0 || with_surface_ > 0 || !options_.objects.on_surfaces_only) return {};
  return {"none of " + std::to_string(scans_) +
          " scans shows a level surface for objects to stand on: is the sensor's pose on the base right? It "
          "determines what is level. For a hand-held camera set max_tilt_deg = 75"};
}

}  // namespace omnimapper::perception
