#include <mrpt/opengl/CArrow.h>
#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/stock_objects.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>

#include "Fields.h"

IMPLEMENTS_SERIALIZABLE(CObservationRelativeMotion, mrpt::obs::CObservation, omnimapper::obs)

namespace omnimapper::obs {

namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

std::string stampText(base::Stamp stamp) {
  return stamp == base::Stamp() ? "none" : base::formatUnix(stamp);
}

// Appends a number with all digits, for files that a program reads again.
void appendNumber(std::string& row, double value) {
  char text[40];
  std::snprintf(text, sizeof text, " %24.17g", value);
  row += text;
}

}  // namespace

CObservationRelativeMotion::CObservationRelativeMotion() {
  timestamp = base::Stamp();
}

uint8_t CObservationRelativeMotion::serializeGetVersion() const {
  return 0;
}

void CObservationRelativeMotion::serializeTo(mrpt::serialization::CArchive& out) const {
  out << timestamp << sensorLabel << begin;
  writePose(out, begin_from_end);
  writeMatrix(out, covariance);
}

void CObservationRelativeMotion::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != 0) refuseVersion("CObservationRelativeMotion", version);
  in >> timestamp;
  sensorLabel = readText(in);
  in >> begin;
  begin_from_end = readPose(in);
  covariance = readMatrix<Eigen::Matrix<double, 6, 6>>(in);
}

void CObservationRelativeMotion::getSensorPose(mrpt::poses::CPose3D& sensor_pose) const {
  sensor_pose = mrpt::poses::CPose3D();
}

void CObservationRelativeMotion::setSensorPose(const mrpt::poses::CPose3D& sensor_pose) {
  if (sensor_pose != mrpt::poses::CPose3D())
    throw base::Error(base::ExitCode::internal,
                      "CObservationRelativeMotion has no sensor pose: it is a motion of the base.");
}

void CObservationRelativeMotion::getDescriptionAsText(std::ostream& out) const {
  CObservation::getDescriptionAsText(out);
  out << "Motion of the base over a span of time.\n"
      << "Start of the span [Unix s]: " << stampText(begin) << "\n"
      << "End of the span [Unix s]:   " << stampText(timestamp) << "\n";
  if (begin != base::Stamp() && timestamp != base::Stamp())
    out << "Length of the span [s]:     " << base::secondsBetween(begin, timestamp) << "\n";
  const auto& p = begin_from_end;
  out << "Pose of the end in the start, x y z [m]: " << p.x() << " " << p.y() << " " << p.z() << "\n"
      << "Pose of the end in the start, yaw pitch roll [deg]: " << p.yaw() * kDegrees << " " << p.pitch() * kDegrees
      << " " << p.roll() * kDegrees << "\n"
      << "Standard deviations, x y z [m] in the base at the end: ";
  for (int i = 0; i < 3; ++i) out << std::sqrt(covariance(i, i)) << " ";
  out << "\nStandard deviations, rotation vector [deg] in the base at the end: ";
  for (int i = 3; i < 6; ++i) out << std::sqrt(covariance(i, i)) * kDegrees << " ";
  out << "\nCovariance (x y z [m], rotation vector [rad]):\n" << covariance << "\n";
}

std::string CObservationRelativeMotion::exportTxtHeader() const {
  std::string header = "begin_unix_s x_m y_m z_m yaw_rad pitch_rad roll_rad";
  const char* const axes[] = {"x", "y", "z", "rx", "ry", "rz"};
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) header += std::string(" cov_") + axes[i] + "_" + axes[j];
  return header;
}

std::string CObservationRelativeMotion::exportTxtDataRow() const {
  std::string row = begin == base::Stamp() ? "0" : base::formatUnix(begin);
  const auto& p = begin_from_end;
  for (const double value : {p.x(), p.y(), p.z(), p.yaw(), p.pitch(), p.roll()}) appendNumber(row, value);
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) appendNumber(row, covariance(i, j));
  return row;
}

void CObservationRelativeMotion::getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const {
  const double travel = begin_from_end.norm();
  const double size = std::max(0.02, 0.3 * travel);  // [m] axis of a corner
  scene.insert(mrpt::opengl::stock_objects::CornerXYZ(static_cast<float>(size)));
  auto end_corner = mrpt::opengl::stock_objects::CornerXYZ(static_cast<float>(size));
  end_corner->setPose(begin_from_end);
  scene.insert(end_corner);

  if (travel > 1e-3) {
    auto arrow = mrpt::opengl::CArrow::Create();
    arrow->setArrowEnds(mrpt::math::CVectorFixedDouble<3>(), begin_from_end.m_coords);
    arrow->setSmallRadius(static_cast<float>(0.02 * travel));
    arrow->setLargeRadius(static_cast<float>(0.05 * travel));
    arrow->setColor_u8(0xff, 0xa0, 0x00);
    scene.insert(arrow);
  }

  mrpt::math::CMatrixDouble33 translation_covariance;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) translation_covariance(i, j) = covariance(i, j);
  if (translation_covariance.trace() > 0) {
    // A direction without variance gets a thickness of 0.1 mm: MRPT draws no flat ellipsoid.
    for (int i = 0; i < 3; ++i) translation_covariance(i, i) += 1e-8;
    auto ellipsoid = mrpt::opengl::CEllipsoid3D::Create();
    ellipsoid->setCovMatrix(translation_covariance);
    ellipsoid->setQuantiles(2.7955f);  // sqrt of the 95 % quantile of chi-square with 3 degrees of freedom
    ellipsoid->setPose(begin_from_end);
    ellipsoid->setColor_u8(0x00, 0x80, 0xff, 0x60);
    scene.insert(ellipsoid);
  }
}

}  // namespace omnimapper::obs
