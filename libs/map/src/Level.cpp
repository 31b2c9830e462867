#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/map/Level.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace omnimapper::map {

double Level::standardDeviation() const {
  return std::sqrt(std::max(0.0, geometry::eigenvaluesOf<3>(covariance).maxCoeff()));
}

Eigen::Quaterniond Level::levelFromMap() const {
  if (!isKnown() || up == Eigen::Vector3d::UnitZ()) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
}

std::string toString(Level::Source source) {
  switch (source) {
    case Level::Source::base:
      return "base";
    case Level::Source::planes:
      return "planes";
    case Level::Source::imu:
      return "imu";
    case Level::Source::unknown:
      break;
  }
  return "unknown";
}

std::string sentenceOf(const Level& level) {
  if (!level.isKnown()) return "which way is up is not known: " + level.reason;
  constexpr double kDegrees = 180 / 3.14159265358979323846;
  const auto positive = [](double value) { return std::abs(value) < 0.0005 ? 0.0 : value; };  // no "-0.000"
  char text[160];
  std::snprintf(text, sizeof text, "up is (%.3f, %.3f, %.3f) of the map +- %.2f deg, by %s: ", positive(level.up.x()),
                positive(level.up.y()), positive(level.up.z()), level.standardDeviation() * kDegrees,
                toString(level.source).c_str());
  return text + level.reason;
}

}  // namespace omnimapper::map
