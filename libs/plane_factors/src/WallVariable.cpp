#include <omnimapper/geometry/Angle.h>
#include <omnimapper/graph/PlacedVariable.h>
#include <omnimapper/plane_factors/WallVariable.h>

#include <Eigen/Geometry>
#include <cmath>

namespace omnimapper::plane_factors {

namespace {

class WallVariable : public graph::PlacedVariable {
 public:
  std::string_view kind() const override { return "wall"; }
  int ambientSize() const override { return 4; }
  int tangentSize() const override { return 2; }
  void plus(const double* x, const double* delta, double* y) const override {
    const geometry::Segment2 wall = wallFromValue(x);
    const Eigen::Vector2d shifted = middle(wall) + delta[1] * normalOf(wall);
    const Eigen::Vector2d half = Eigen::Rotation2Dd(delta[0]) * (0.5 * (wall.to - wall.from));
    Eigen::Map<Eigen::Vector4d>{y} = toValue(geometry::Segment2{shifted - half, shifted + half});
  }
  void minus(const double* y, const double* x, double* delta) const override {
    Eigen::Map<Eigen::Vector2d>{delta} = wallChange(wallFromValue(x), wallFromValue(y));
  }
  void move(const geometry::Se3& a_from_b, const double* x, double* y) const override {
    const geometry::Segment2 wall = wallFromValue(x);
    const auto moved = [&](const Eigen::Vector2d& end) -> Eigen::Vector2d {
      return (a_from_b * Eigen::Vector3d(end.x(), end.y(), 0)).head<2>();
    };
    Eigen::Map<Eigen::Vector4d>{y} = toValue(geometry::Segment2{moved(wall.from), moved(wall.to)});
  }
  Eigen::VectorXd hyperplane(const double* value) const override {
    const geometry::Segment2 wall = wallFromValue(value);
    const Eigen::Vector2d normal = normalOf(wall);
    return Eigen::Vector3d(normal.x(), normal.y(), -normal.dot(middle(wall)));
  }
};

}  // namespace

const std::shared_ptr<const graph::Variable>& wallVariable() {
  static const std::shared_ptr<const graph::Variable> kind = std::make_shared<WallVariable>();
  return kind;
}

Eigen::Vector2d wallChange(const geometry::Segment2& from, const geometry::Segment2& to) {
  const Eigen::Vector2d a = direction(from), b = direction(to);
  return {std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)), normalOf(from).dot(middle(to) - middle(from))};
}

Eigen::Vector4d toValue(const geometry::Segment2& wall) {
  Eigen::Vector4d value;
  value << wall.from, wall.to;
  return value;
}

}  // namespace omnimapper::plane_factors
