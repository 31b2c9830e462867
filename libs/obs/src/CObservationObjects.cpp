#include <mrpt/opengl/CPointCloudColoured.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/obs/SceneDrawing.h>

#include <cmath>

#include "Fields.h"
#include "TextRow.h"

IMPLEMENTS_SERIALIZABLE(CObservationObjects, mrpt::obs::CObservation, omnimapper::obs)

namespace omnimapper::obs {

namespace {

void writeIndex(Archive& out, std::uint32_t index) {
  out << index;
}

void writeObject(Archive& out, const ObservedObject& object) {
  writeMatrix(out, object.centroid);
  writeMatrix(out, object.covariance);
  writePose(out, object.sensor_from_box);
  writeMatrix(out, object.box_size);
  writeItems(out, object.points, writeMatrix<float, 3, 1>);
  writeItems(out, object.colours, writeColour);
  writeOptional(out, object.supporting_plane, writeIndex);
  writeOptional(out, object.colour, writeColour);
  writeText(out, object.class_label);
  out << object.score;
}

ObservedObject readObject(Archive& in) {
  ObservedObject object;
  object.centroid = readMatrix<Eigen::Vector3d>(in);
  object.covariance = readMatrix<Eigen::Matrix3d>(in);
  object.sensor_from_box = readSe3(in);
  object.box_size = readMatrix<Eigen::Vector3d>(in);
  object.points = readItems(in, readMatrix<Eigen::Vector3f>);
  object.colours = readItems(in, readColour);
  if (!object.colours.empty() && object.colours.size() != object.points.size()) {
    throw base::Error(base::ExitCode::damaged_input, "CObservationObjects: an object has " +
                                                         std::to_string(object.colours.size()) + " colours for " +
                                                         std::to_string(object.points.size()) +
                                                         " points; there must be as many colours as points, or none.");
  }
  object.supporting_plane = readOptional(in, readNumber<std::uint32_t>);
  object.colour = readOptional(in, readColour);
  object.class_label = readText(in);
  object.score = readNumber<double>(in);
  return object;
}

void drawBox(mrpt::opengl::CSetOfObjects& scene, const ObservedObject& object, const mrpt::img::TColor& colour) {
  const auto corner = [&](int i) -> Eigen::Vector3d {
    const Eigen::Vector3d sides(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    return object.sensor_from_box * Eigen::Vector3d(sides.cwiseProduct(object.box_size));
  };
  auto edges = makeLines(colour, 3);
  for (int i = 0; i < 8; ++i) {
    for (const int side : {1, 2, 4}) {
      if (!(i & side)) addLine(*edges, corner(i), corner(i | side));
    }
  }
  scene.insert(edges);
}

void drawPoints(mrpt::opengl::CSetOfObjects& scene, const ObservedObject& object, const mrpt::img::TColor& colour) {
  auto cloud = mrpt::opengl::CPointCloudColoured::Create();
  cloud->setPointSize(4);
  for (std::size_t i = 0; i < object.points.size(); ++i) {
    const auto& point = object.points[i];
    if (!point.allFinite()) continue;
    const auto c = i < object.colours.size() ? asColor(object.colours[i]) : colour;
    cloud->insertPoint(mrpt::math::TPointXYZfRGBAu8(point.x(), point.y(), point.z(), c.R, c.G, c.B));
  }
  scene.insert(cloud);
}

}  // namespace

uint8_t CObservationObjects::serializeGetVersion() const {
  return 0;
}

void CObservationObjects::serializeTo(mrpt::serialization::CArchive& out) const {
  writeHead(out);
  writeItems(out, objects, writeObject);
}

void CObservationObjects::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != 0) refuseVersion("CObservationObjects", version);
  readHead(in);
  objects = readItems(in, readObject);
}

void CObservationObjects::describe(std::ostream& out) const {
  out << objects.size() << " objects, in the frame of the sensor:\n";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto& object = objects[i];
    const auto &c = object.centroid, &size = object.box_size;
    out << i << ": centroid (" << shortly(c.x()) << ", " << shortly(c.y()) << ", " << shortly(c.z())
        << ") m, standard deviations";
    for (int k = 0; k < 3; ++k) out << " " << shortly(1000 * std::sqrt(object.covariance(k, k)));
    out << " mm, box of " << shortly(size.x()) << " x " << shortly(size.y()) << " x " << shortly(size.z()) << " m, "
        << object.points.size() << " points" << (object.colours.empty() ? "" : " in colour");
    if (object.supporting_plane) out << ", on plane " << *object.supporting_plane;
    if (object.colour)
      out << ", colour " << int{object.colour->red} << " " << int{object.colour->green} << " "
          << int{object.colour->blue};
    if (!object.class_label.empty())
      out << ", \"" << inAscii(object.class_label) << "\" with score " << shortly(object.score);
    out << "\n";
  }
}

std::string CObservationObjects::exportTxtHeader() const {
  return "objects { centroid_x_m centroid_y_m centroid_z_m cov_x_x cov_x_y cov_x_z cov_y_y cov_y_z cov_z_z box_x_m "
         "box_y_m box_z_m box_qx box_qy box_qz box_qw box_length_x_m box_length_y_m box_length_z_m supporting_plane "
         "red "
         "green blue class_label score points { x_m y_m z_m red green blue } }";
}

std::string CObservationObjects::exportTxtDataRow() const {
  TextRow row;
  row.whole(static_cast<long long>(objects.size()));
  for (const auto& object : objects) {
    row.vector(object.centroid).symmetric(object.covariance);
    row.vector(object.sensor_from_box.translation).vector(Eigen::Vector4d(object.sensor_from_box.rotation.coeffs()));
    row.vector(object.box_size).whole(object.supporting_plane ? static_cast<long long>(*object.supporting_plane) : -1);
    row.colour(object.colour).text(object.class_label).number(object.score);
    row.whole(static_cast<long long>(object.points.size()));
    for (std::size_t i = 0; i < object.points.size(); ++i) {
      row.vector(Eigen::Vector3d(object.points[i].cast<double>()));
      row.colour(i < object.colours.size() ? std::optional<Rgb>(object.colours[i]) : std::nullopt);
    }
  }
  return row.str();
}

void CObservationObjects::draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto& object = objects[i];
    const auto colour = indexColour(i);
    drawBox(scene_in_sensor, object, colour);
    drawPoints(scene_in_sensor, object, colour);
    const std::string label = object.class_label.empty() ? "object " + std::to_string(i) : inAscii(object.class_label);
    addText(scene_in_sensor, object.sensor_from_box * Eigen::Vector3d(0, 0, 0.5 * object.box_size.z() + 0.03), label,
            colour);
  }
}

}  // namespace omnimapper::obs
