#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/plane_factors/WallFactor.h>

#include <cmath>

namespace omnimapper::plane_factors {

void WallFactor::evaluate(const double* const* values, double* residual, double* const* jacobians) const {
  const geometry::Se2 map_from_base = graph::se2FromValue(values[0]);
  const geometry::Segment2 wall = wallFromValue(values[1]);
  const Eigen::Vector2d along = direction(wall), normal = normalOf(wall);
  const Eigen::Vector2d measured = map_from_base.rotation() * direction_;
  const Eigen::Vector2d from_wall = map_from_base * middle_ - middle(wall);
  residual[0] = std::atan2(along.x() * measured.y() - along.y() * measured.x(), along.dot(measured));
  residual[1] = normal.dot(from_wall);
  if (!jacobians) return;
  if (auto by_pose = jacobian<0>(jacobians)) {
    const Eigen::RowVector2d by_place = normal.transpose() * map_from_base.rotation();
    by_pose << 0, 0, 1, by_place, by_place.dot(Eigen::Vector2d(-middle_.y(), middle_.x()));
  }
  // The derivative of the normal by the wall's rotation is -along.
  if (auto by_wall = jacobian<1>(jacobians)) by_wall << -1, 0, -along.dot(from_wall), -1;
}

void WallFactor::write(std::ostream& out) const {
  graph::writeVector(out, direction_);
  graph::writeVector(out, middle_);
}

void WallFactor::addTo(graph::FactorRegistry& registry) {
  registry.add("wall_from_se2", [](std::istream& in) {
    const Eigen::Vector2d direction = graph::readVector<2>(in);
    return std::make_shared<WallFactor>(direction, graph::readVector<2>(in));
  });
}

}  // namespace omnimapper::plane_factors
