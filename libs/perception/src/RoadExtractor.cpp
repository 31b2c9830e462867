#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/perception/RoadExtractor.h>

#include "planes/PlaneObservation.h"

namespace omnimapper::perception {

const base::OptionTable<RoadPoseOptions>& RoadPoseOptions::table() {
  static const auto table = base::OptionTable<RoadPoseOptions>().number(
      "ground_height_m", &RoadPoseOptions::ground_height, {},
      "Height of the ground on which the wheels stand, as z in the frame of the base.");
  return table;
}

geometry::Plane3 expectedGround(const mrpt::obs::CObservation3DRangeScan& scan, double ground_height) {
  const geometry::Plane3 in_sensor = geometry::inverse(geometry::fromMrpt(scan.sensorPose)) *
                                     geometry::Plane3{Eigen::Vector3d::UnitZ(), -ground_height};
  return {camera::toOptical(in_sensor.normal), in_sensor.distance};
}

std::shared_ptr<obs::CObservationPlanes> RoadExtractor::extract(const mrpt::obs::CObservation3DRangeScan& scan) const {
  const camera::ScanDepth depth(scan);
  const auto found = segmenter_.segment(depth.image(), expectedGround(scan, pose_.ground_height));
  auto derived = planes::observe(found.ground, scan, depth, camera::ScanColours(scan), outlines_.tolerance);
  derived->sensorLabel = scan.sensorLabel + kRoadSuffix;
  return derived;
}

bool RoadExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> RoadExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {extract(*camera::depthScanOf(raw))};
}

std::vector<DerivedName> RoadExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + kRoadSuffix}};
}

}  // namespace omnimapper::perception
