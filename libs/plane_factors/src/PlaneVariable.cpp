#include <omnimapper/graph/PlacedVariable.h>
#include <omnimapper/plane_factors/PlaneVariable.h>

namespace omnimapper::plane_factors {

namespace {

class PlaneVariable : public graph::PlacedVariable {
 public:
  std::string_view kind() const override { return "plane"; }
  int ambientSize() const override { return 4; }
  int tangentSize() const override { return 3; }
  void plus(const double* x, const double* delta, double* y) const override {
    Eigen::Map<Eigen::Vector4d>{y} =
        toValue(geometry::plus(planeFromValue(x), Eigen::Map<const Eigen::Vector3d>(delta)));
  }
  void minus(const double* y, const double* x, double* delta) const override {
    Eigen::Map<Eigen::Vector3d>{delta} = geometry::minus(planeFromValue(y), planeFromValue(x));
  }
  void move(const geometry::Se3& a_from_b, const double* x, double* y) const override {
    Eigen::Map<Eigen::Vector4d>{y} = toValue(a_from_b * planeFromValue(x));
  }
  Eigen::VectorXd hyperplane(const double* value) const override { return Eigen::Map<const Eigen::Vector4d>(value); }
};

}  // namespace

const std::shared_ptr<const graph::Variable>& planeVariable() {
  static const std::shared_ptr<const graph::Variable> kind = std::make_shared<PlaneVariable>();
  return kind;
}

Eigen::Vector4d toValue(const geometry::Plane3& plane) {
  Eigen::Vector4d value;
  value << plane.normal, plane.distance;
  return value;
}

}  // namespace omnimapper::plane_factors
