#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/landmarks/WallFactor.h>
#include <omnimapper/landmarks/WallVariable.h>

#include <cmath>

namespace omnimapper::landmarks {

const std::vector<std::string_view>& WallFactor::variableKinds() const {
  static const std::vector<std::string_view> kinds = {"se2", "wall"};
  return kinds;
}

void WallFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se2 map_from_base = graph::se2FromValue(values[0]);
  const geometry::Segment2 wall = wallFromValue(values[1]);
  const Eigen::Vector2d along = direction(wall), normal = normalOf(wall);
  const Eigen::Vector2d measured = map_from_base.rotation() * direction_;
  const Eigen::Vector2d from_wall = map_from_base * middle_ - middle(wall);
  residual[0] = std::atan2(along.x() * measured.y() - along.y() * measured.x(), along.dot(measured));
  residual[1] = normal.dot(from_wall);
  if (!jacobians) return;
  if (jacobians[0]) {
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> by_pose(jacobians[0]);
    const Eigen::RowVector2d by_place = normal.transpose() * map_from_base.rotation();
    by_pose << 0, 0, 1, by_place, by_place.dot(Eigen::Vector2d(-middle_.y(), middle_.x()));
  }
  if (jacobians[1]) {
    // The normal turns to -along.
    Eigen::Map<Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>{jacobians[1]} << -1, 0, -along.dot(from_wall), -1;
  }
}

void WallFactor::write(std::ostream& out) const {
  for (const double number : direction_) graph::writeDouble(out, number);
  for (const double number : middle_) graph::writeDouble(out, number);
}

void WallFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("wall_from_se2", [](std::istream& in) {
    Eigen::Vector2d direction, middle;
    for (double& number : direction) number = graph::readDouble(in);
    for (double& number : middle) number = graph::readDouble(in);
    return std::make_shared<WallFactor>(direction, middle);
  });
}

}  // namespace omnimapper::landmarks
