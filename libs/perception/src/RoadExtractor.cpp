#include <omnimapper/camera/DepthScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/perception/RoadExtractor.h>
#include <omnimapper/perception/viewOf.h>

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

std::shared_ptr<obs::CObservationPlanes> RoadExtractor::groundIn(const mrpt::obs::CObservation3DRangeScan& scan,
                                                                 const camera::RgbdView& view) const {
  const auto found = segmenter_.segment(view.depth(), expectedGround(scan, pose_.ground_height));
  auto derived = planes::observe(found.ground, scan, view, outlines_.tolerance);
  derived->sensorLabel = scan.sensorLabel + kRoadSuffix;
  return derived;
}

std::shared_ptr<obs::CObservationPlanes> RoadExtractor::extract(const mrpt::obs::CObservation3DRangeScan& scan) const {
  return groundIn(scan, camera::RgbdView(scan));
}

bool RoadExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::depthScanOf(raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> RoadExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {extract(*camera::depthScanOf(raw))};
}

std::vector<mrpt::obs::CObservation::Ptr> RoadExtractor::extractUsing(const mrpt::obs::CObservation& raw,
                                                                      Blackboard& board) const {
  const auto& scan = *camera::depthScanOf(raw);
  return {groundIn(scan, viewOf(scan, board))};
}

std::vector<DerivedName> RoadExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationPlanes), raw.sensorLabel + kRoadSuffix}};
}

}  // namespace omnimapper::perception
