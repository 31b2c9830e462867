#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/obs/SceneDrawing.h>

#include <cmath>

#include "Fields.h"
#include "TextRow.h"

IMPLEMENTS_SERIALIZABLE(CObservationPlanes, mrpt::obs::CObservation, omnimapper::obs)

namespace omnimapper::obs {

namespace {

void writePlane(Archive& out, const ObservedPlane& plane) {
  writeMatrix(out, plane.plane_in_sensor.normal);
  out << plane.plane_in_sensor.distance;
  writeMatrix(out, plane.covariance);
  writeMatrix(out, plane.centroid);
  writePolygon(out, plane.outline);
  writeItems(out, plane.holes, writePolygon);
  out << plane.inliers << plane.rms;
  writeOptional(out, plane.colour, writeColour);
  out << plane.roughness;
}

ObservedPlane readPlaneWithoutRoughness(Archive& in) {
  ObservedPlane plane;
  plane.plane_in_sensor.normal = readMatrix<Eigen::Vector3d>(in);
  plane.plane_in_sensor.distance = readNumber<double>(in);
  plane.covariance = readMatrix<Eigen::Matrix3d>(in);
  plane.centroid = readMatrix<Eigen::Vector3d>(in);
  plane.outline = readPolygon(in);
  plane.holes = readItems(in, readPolygon);
  plane.inliers = readNumber<std::uint32_t>(in);
  plane.rms = readNumber<double>(in);
  plane.colour = readOptional(in, readColour);
  return plane;
}

ObservedPlane readPlane(Archive& in) {
  ObservedPlane plane = readPlaneWithoutRoughness(in);
  plane.roughness = readNumber<double>(in);
  return plane;
}

double areaOf(const ObservedPlane& plane) {
  double result = area(plane.outline);
  for (const auto& hole : plane.holes) result -= area(hole);
  return result;
}

}  // namespace

uint8_t CObservationPlanes::serializeGetVersion() const {
  return 1;
}

void CObservationPlanes::serializeTo(mrpt::serialization::CArchive& out) const {
  writeHead(out);
  writeItems(out, planes, writePlane);
}

void CObservationPlanes::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version > 1) refuseVersion("CObservationPlanes", version);
  readHead(in);
  planes = readItems(in, version == 0 ? readPlaneWithoutRoughness : readPlane);
}

void CObservationPlanes::describe(std::ostream& out) const {
  out << planes.size() << " planes, normal . p + distance = 0 in the frame of the sensor:\n";
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const auto& plane = planes[i];
    const auto& [normal, distance] = plane.plane_in_sensor;
    out << i << ": normal " << shortly(normal.x()) << " " << shortly(normal.y()) << " " << shortly(normal.z())
        << ", distance " << shortly(distance) << " m, area " << shortly(areaOf(plane)) << " m^2, " << plane.inliers
        << " points with rms " << shortly(1000 * plane.rms) << " mm, " << shortly(plane.roughness)
        << " times the sensor's noise, standard deviations " << shortly(1000 * std::sqrt(plane.covariance(0, 0)))
        << " and " << shortly(1000 * std::sqrt(plane.covariance(1, 1))) << " mrad, "
        << shortly(1000 * std::sqrt(plane.covariance(2, 2))) << " mm, outline of " << plane.outline.vertices.size()
        << " vertices, " << plane.holes.size() << " holes";
    if (plane.colour)
      out << ", colour " << int{plane.colour->red} << " " << int{plane.colour->green} << " " << int{plane.colour->blue};
    out << "\n";
  }
}

std::string CObservationPlanes::exportTxtHeader() const {
  return "planes { nx ny nz distance_m cov_1_1 cov_1_2 cov_1_d cov_2_2 cov_2_d cov_d_d centroid_x_m centroid_y_m "
         "centroid_z_m area_m2 inliers rms_m red green blue outline { x_m y_m z_m } holes { vertices { x_m y_m z_m } } "
         "}";
}

std::string CObservationPlanes::exportTxtDataRow() const {
  TextRow row;
  row.whole(static_cast<long long>(planes.size()));
  for (const auto& plane : planes) {
    row.vector(plane.plane_in_sensor.normal).number(plane.plane_in_sensor.distance).symmetric(plane.covariance);
    row.vector(plane.centroid).number(areaOf(plane)).whole(plane.inliers).number(plane.rms).colour(plane.colour);
    row.polygon(plane.outline).whole(static_cast<long long>(plane.holes.size()));
    for (const auto& hole : plane.holes) row.polygon(hole);
  }
  return row.str();
}

void CObservationPlanes::draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const {
  // Opaque parts are drawn first, because they would not show through a translucent face that was drawn before.
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const auto& plane = planes[i];
    auto edges = makeLines(indexColour(i), 3);
    addClosed(*edges, plane.outline);
    for (const auto& hole : plane.holes) addClosed(*edges, hole);
    scene_in_sensor.insert(edges);
    const double arrow = std::clamp(0.3 * std::sqrt(area(plane.outline)), 0.05, 0.5);  // [m]
    addArrow(scene_in_sensor, plane.centroid, plane.centroid + arrow * plane.plane_in_sensor.normal, indexColour(i));
  }
  for (std::size_t i = 0; i < planes.size(); ++i) {
    auto polygons = planes[i].holes;
    polygons.push_back(planes[i].outline);
    addFilled(scene_in_sensor, planes[i].plane_in_sensor, polygons, indexColour(i, 110));
  }
}

}  // namespace omnimapper::obs
