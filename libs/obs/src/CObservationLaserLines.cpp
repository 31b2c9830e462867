#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/SceneDrawing.h>

#include <cmath>

#include "Fields.h"
#include "TextRow.h"

IMPLEMENTS_SERIALIZABLE(CObservationLaserLines, mrpt::obs::CObservation, omnimapper::obs)

namespace omnimapper::obs {

namespace {

constexpr double kDegreesPerRadian = 180 / geometry::kPi;
constexpr double kWidth = 0.04;  // [m] of a drawn line

LineEnd readEnd(Archive& in) {
  const auto code = readNumber<std::uint8_t>(in);
  if (code > static_cast<std::uint8_t>(LineEnd::view)) {
    throw base::Error(base::ExitCode::damaged_input, "CObservationLaserLines: a line has an end of kind " +
                                                         std::to_string(int{code}) + "; there must be 0, 1 or 2.");
  }
  return static_cast<LineEnd>(code);
}

void writeLine(Archive& out, const LaserLine& line) {
  writeMatrix(out, line.segment_in_sensor.from);
  writeMatrix(out, line.segment_in_sensor.to);
  out << line.angle << line.distance;
  writeMatrix(out, line.covariance);
  out << static_cast<std::uint8_t>(line.from_end) << static_cast<std::uint8_t>(line.to_end);
  out << line.first_beam << line.last_beam << line.inliers << line.rms;
}

LaserLine readLine(Archive& in) {
  LaserLine line;
  line.segment_in_sensor.from = readMatrix<Eigen::Vector2d>(in);
  line.segment_in_sensor.to = readMatrix<Eigen::Vector2d>(in);
  line.angle = readNumber<double>(in);
  line.distance = readNumber<double>(in);
  line.covariance = readMatrix<Eigen::Matrix2d>(in);
  line.from_end = readEnd(in);
  line.to_end = readEnd(in);
  line.first_beam = readNumber<std::uint32_t>(in);
  line.last_beam = readNumber<std::uint32_t>(in);
  line.inliers = readNumber<std::uint32_t>(in);
  line.rms = readNumber<double>(in);
  return line;
}

const char* name(LineEnd end) {
  switch (end) {
    case LineEnd::wall:
      return "wall";
    case LineEnd::occluded:
      return "occluded";
    case LineEnd::view:
      return "view";
  }
  return "unknown";
}

void drawEnd(mrpt::opengl::CSetOfObjects& scene, mrpt::opengl::CSetOfTriangles& strokes, const Eigen::Vector3d& place,
             const Eigen::Vector3d& across, LineEnd end) {
  if (end == LineEnd::wall) return addStroke(strokes, place - 0.15 * across, place + 0.15 * across, kWidth);
  const std::uint8_t shade = end == LineEnd::view ? 255 : 20;
  addBall(scene, place, 1.2 * kWidth, {shade, shade, shade});
}

}  // namespace

uint8_t CObservationLaserLines::serializeGetVersion() const {
  return 0;
}

void CObservationLaserLines::serializeTo(mrpt::serialization::CArchive& out) const {
  writeHead(out);
  writeItems(out, lines, writeLine);
}

void CObservationLaserLines::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != 0) refuseVersion("CObservationLaserLines", version);
  readHead(in);
  lines = readItems(in, readLine);
}

void CObservationLaserLines::describe(std::ostream& out) const {
  out << lines.size() << " lines, x cos(angle) + y sin(angle) = distance in the plane of the scan:\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& line = lines[i];
    const auto& [from, to] = line.segment_in_sensor;
    out << i << ": from (" << shortly(from.x()) << ", " << shortly(from.y()) << ") m [" << name(line.from_end)
        << "] to (" << shortly(to.x()) << ", " << shortly(to.y()) << ") m [" << name(line.to_end) << "], length "
        << shortly(length(line.segment_in_sensor)) << " m, angle " << shortly(line.angle * kDegreesPerRadian)
        << " deg, distance " << shortly(line.distance) << " m, standard deviations "
        << shortly(std::sqrt(line.covariance(0, 0)) * kDegreesPerRadian) << " deg and "
        << shortly(1000 * std::sqrt(line.covariance(1, 1))) << " mm, beams " << line.first_beam << " to "
        << line.last_beam << ", " << line.inliers << " of them on it with rms " << shortly(1000 * line.rms) << " mm\n";
  }
}

std::string CObservationLaserLines::exportTxtHeader() const {
  return "lines { from_x_m from_y_m to_x_m to_y_m angle_rad distance_m cov_angle_angle cov_angle_distance "
         "cov_distance_distance from_end to_end first_beam last_beam inliers rms_m }";
}

std::string CObservationLaserLines::exportTxtDataRow() const {
  TextRow row;
  row.whole(static_cast<long long>(lines.size()));
  for (const auto& line : lines) {
    row.vector(line.segment_in_sensor.from).vector(line.segment_in_sensor.to);
    row.number(line.angle).number(line.distance).symmetric(line.covariance);
    row.text(name(line.from_end)).text(name(line.to_end));
    row.whole(line.first_beam).whole(line.last_beam).whole(line.inliers).number(line.rms);
  }
  return row.str();
}

void CObservationLaserLines::draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& line = lines[i];
    const Eigen::Vector2d along = direction(line.segment_in_sensor);
    const Eigen::Vector3d across(-along.y(), along.x(), 0);
    Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = from;
    from.head<2>() = line.segment_in_sensor.from;
    to.head<2>() = line.segment_in_sensor.to;
    auto strokes = mrpt::opengl::CSetOfTriangles::Create();
    strokes->enableLight(false);
    addStroke(*strokes, from, to, kWidth);
    drawEnd(scene_in_sensor, *strokes, from, across, line.from_end);
    drawEnd(scene_in_sensor, *strokes, to, across, line.to_end);
    strokes->setColor_u8(indexColour(i));
    scene_in_sensor.insert(strokes);
  }
}

}  // namespace omnimapper::obs
