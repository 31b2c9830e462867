#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/perception/ObjectExtractor.h>

#include "planes/PlaneObservation.h"

namespace omnimapper::perception {

const base::OptionTable<ObjectPointOptions>& ObjectPointOptions::table() {
  static const auto table = base::OptionTable<ObjectPointOptions>().integer(
      "max_points", &ObjectPointOptions::max_points, {1, 1e9}, "Largest number of points that are kept of an object.");
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
void addPoints(const ObjectRegion& region, const camera::ScanDepth& depth, const camera::ScanColours& colours,
               int max_points, obs::ObservedObject& object) {
  const int count = static_cast<int>(region.pixels.size()), step = (count + max_points - 1) / max_points;
  camera::ColourSum sum;
  for (int i = 0; i < count; ++i) {
    const int pixel = region.pixels[static_cast<std::size_t>(i)];
    const double z = depth.at(static_cast<std::size_t>(pixel));
    const auto colour = colours.at(pixel % depth.image().width(), pixel / depth.image().width(), z);
    if (colour) sum.add(*colour);
    if (i % step != 0) continue;
    object.points.push_back(camera::toSensor(pointOf(depth.image(), pixel, z)).cast<float>());
    if (colour) object.colours.push_back(*colour);
  }
  if (object.colours.size() != object.points.size()) object.colours.clear();
  object.colour = sum.mean();
}

}  // namespace

ObjectExtractor::Found ObjectExtractor::extract(const mrpt::obs::CObservation3DRangeScan& scan) const {
  const camera::ScanDepth depth(scan);
  const camera::ScanColours colours(scan);
  const PlaneSegmentation planes = segmenter_.segment(depth.image());
  Found found;
  found.planes = planes::observe(planes, scan, depth, colours, options_.outlines.tolerance);
  found.objects = obs::CObservationObjects::Create();
  found.objects->timestamp = scan.timestamp;
  found.objects->sensorPose = scan.sensorPose;
  found.objects->sensorLabel = scan.sensorLabel + kObjectsSuffix;
  found.objects->source_label = scan.sensorLabel;
  const geometry::Se3 sensor_from_optical = geometry::sensorFromOptical();
  const Eigen::Matrix3d turn = sensor_from_optical.rotation.toRotationMatrix();
  const Eigen::Vector3d up = upInOptical(scan.sensorPose);
  found.has_surface = finder_.hasSurface(planes, up);
  for (const ObjectRegion& region : finder_.find(depth.image(), planes, up)) {
    obs::ObservedObject object;
    object.centroid = camera::toSensor(region.centroid);
    object.covariance = turn * region.covariance * turn.transpose();
    object.sensor_from_box = sensor_from_optical * region.sensor_from_box;
    object.box_size = region.box_size;
    if (region.surface) object.supporting_plane = static_cast<std::uint32_t>(*region.surface);
    addPoints(region, depth, colours, options_.points.max_points, object);
    found.objects->objects.push_back(std::move(object));
  }
  return found;
}

bool ObjectExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> ObjectExtractor::extract(const mrpt::obs::CObservation& raw) const {
  const auto found = extract(*camera::depthScanOf(raw));
  ++scans_;
  with_surface_ += found.has_surface;
  return {found.planes, found.objects};
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
