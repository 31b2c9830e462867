#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/plane_factors/PlaneFactors.h>
#include <omnimapper/plane_factors/PlaneParametrization.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/plane_factors/WallFactor.h>
#include <omnimapper/plane_factors/WallVariable.h>

#include <algorithm>

namespace omnimapper::plane_factors {

namespace {

class PlaneForm : public PlaneParametrization {
 public:
  const std::shared_ptr<const graph::Variable>& variable() const override { return planeVariable(); }
  Eigen::VectorXd value(const geometry::Plane3& plane, const std::vector<Eigen::Vector3d>&) const override {
    return toValue(plane);
  }
  geometry::Plane3 plane(const Eigen::VectorXd& value) const override { return planeFromValue(value.data()); }
  std::shared_ptr<const graph::Factor> ofLine(const Eigen::Vector3d& direction,
                                              const Eigen::Vector3d& middle) const override {
    return std::make_shared<LineOnPlaneFactor>(direction, middle);
  }
  bool mayTilt() const override { return true; }

  Difference difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const override {
    const geometry::Plane3 from = plane(a), to = plane(b);
    Eigen::MatrixXd by_both = Eigen::MatrixXd::Zero(3, 6);
    by_both.leftCols<3>() = -Eigen::Matrix3d::Identity();
    by_both.block<2, 2>(0, 3) = geometry::tangentBasis(from.normal).transpose() * geometry::tangentBasis(to.normal);
    by_both(2, 5) = 1;
    return {geometry::minus(to, from), by_both};
  }
};

class WallForm : public PlaneParametrization {
 public:
  const std::shared_ptr<const graph::Variable>& variable() const override { return wallVariable(); }
  Eigen::VectorXd value(const geometry::Plane3& plane, const std::vector<Eigen::Vector3d>& outline) const override {
    const Eigen::Vector2d along(plane.normal.y(), -plane.normal.x());
    const auto [first, last] = std::minmax_element(outline.begin(), outline.end(), [&](const auto& p, const auto& q) {
      return along.dot((p - q).template head<2>()) < 0;
    });
    return toValue(geometry::Segment2{first->head<2>(), last->head<2>()});
  }
  geometry::Plane3 plane(const Eigen::VectorXd& value) const override {
    const geometry::Segment2 wall = wallFromValue(value.data());
    const Eigen::Vector2d normal = normalOf(wall);
    return geometry::Plane3::through({wall.from.x(), wall.from.y(), 0}, {normal.x(), normal.y(), 0});
  }
  std::shared_ptr<const graph::Factor> ofLine(const Eigen::Vector3d& direction,
                                              const Eigen::Vector3d& middle) const override {
    return std::make_shared<WallFactor>(direction.head<2>().normalized(), middle.head<2>());
  }
  bool mayTilt() const override { return false; }

  Difference difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const override {
    const geometry::Segment2 from = wallFromValue(a.data()), to = wallFromValue(b.data());
    Eigen::MatrixXd by_both(2, 4);
    // A rotation of `from` changes its normal by -along, and a shift moves its middle. The middle of `to` shifts along
    // its own normal.
    by_both << -1, 0, 1, 0, -direction(from).dot(middle(to) - middle(from)), -1, 0, normalOf(from).dot(normalOf(to));
    return {wallChange(from, to), by_both};
  }
};

}  // namespace

const PlaneParametrization& PlaneParametrization::of(Kind kind) {
  static const PlaneForm plane;
  static const WallForm wall;
  if (kind == Kind::wall) return wall;
  return plane;
}

const PlaneParametrization* PlaneParametrization::find(const graph::Variable& variable) {
  for (const Kind kind : {Kind::plane, Kind::wall})
    if (of(kind).variable()->kind() == variable.kind()) return &of(kind);
  return nullptr;
}

PlaneParametrization::Difference differenceOf(const graph::Variable& variable, const Eigen::VectorXd& a,
                                              const Eigen::VectorXd& b) {
  if (const PlaneParametrization* form = PlaneParametrization::find(variable)) return form->difference(a, b);
  const int size = variable.tangentSize();
  PlaneParametrization::Difference difference{Eigen::VectorXd(size), Eigen::MatrixXd(size, 2 * size)};
  variable.minus(b.data(), a.data(), difference.change.data());
  difference.by_both.leftCols(size) = -Eigen::MatrixXd::Identity(size, size);
  difference.by_both.rightCols(size).setIdentity();
  return difference;
}

}  // namespace omnimapper::plane_factors
