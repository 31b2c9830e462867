#include "PlaneObservation.h"

#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include "Outlines.h"

namespace omnimapper::perception::planes {

namespace {

// The colours of the pixels of each plane.
std::vector<camera::ColourSum> coloursOf(const PlaneSegmentation& found, const camera::RgbdView& view) {
  const camera::ScanColours& colours = view.colours();
  std::vector<camera::ColourSum> sums(found.planes.size());
  if (!colours.exist() || sums.empty()) return sums;
  for (int y = 0; y < found.height; ++y) {
    const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(found.width);
    for (int begin = 0, end = 0; begin < found.width; begin = end) {
      const std::uint16_t label = found.labels[first + static_cast<std::size_t>(begin)];
      while (end < found.width && found.labels[first + static_cast<std::size_t>(end)] == label) ++end;
      if (label == 0) continue;
      auto& sum = sums[label - 1U];
      if (colours.areOfDepthView()) {
        colours.addRow(y, begin, end, sum);
        continue;
      }
      for (int x = begin; x < end; ++x) {
        const auto colour = colours.at(x, y, view.depth().at(first + static_cast<std::size_t>(x)));
        if (colour) sum.add(*colour);
      }
    }
  }
  return sums;
}

geometry::Polygon3 polygonOf(const Contour& contour, double tolerance) {
  geometry::Polygon3 polygon;
  for (const std::size_t i : cornersNeeded(contour.corners, tolerance))
    polygon.vertices.push_back(camera::toSensor(contour.polygon_in_sensor.vertices[i]));
  return polygon;
}

}  // namespace

std::shared_ptr<obs::CObservationPlanes> observe(const PlaneSegmentation& found,
                                                 const mrpt::obs::CObservation3DRangeScan& scan,
                                                 const camera::RgbdView& view, double outline_tolerance) {
  auto derived = obs::CObservationPlanes::Create();
  derived->timestamp = scan.timestamp;
  derived->sensorPose = scan.sensorPose;
  derived->sensorLabel = scan.sensorLabel + kPlanesSuffix;
  derived->source_label = scan.sensorLabel;
  const geometry::Se3 sensor_from_optical = geometry::sensorFromOptical();
  const auto sums = coloursOf(found, view);
  for (std::size_t i = 0; i < found.planes.size(); ++i) {
    const PlaneRegion& region = found.planes[i];
    obs::ObservedPlane plane;
    plane.plane_in_sensor = {camera::toSensor(region.plane_in_sensor.normal), region.plane_in_sensor.distance};
    plane.covariance = geometry::transportCovariance(sensor_from_optical, region.plane_in_sensor, region.covariance);
    plane.centroid = camera::toSensor(region.centroid);
    plane.outline = polygonOf(region.outline, outline_tolerance);
    for (const Contour& hole : region.holes) plane.holes.push_back(polygonOf(hole, outline_tolerance));
    plane.inliers = static_cast<std::uint32_t>(region.inliers);
    plane.rms = region.rms;
    plane.roughness = region.roughness;
    plane.colour = sums[i].mean();
    derived->planes.push_back(std::move(plane));
  }
  return derived;
}

}  // namespace omnimapper::perception::planes
