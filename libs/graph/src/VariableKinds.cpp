#include "omnimapper/graph/VariableKinds.h"

#include <omnimapper/geometry/Angle.h>

#include <cmath>

#include "omnimapper/graph/PlacedVariable.h"

namespace omnimapper::graph {

namespace {

class Se2Variable : public PlacedVariable {
 public:
  std::string_view kind() const override { return "se2"; }
  int ambientSize() const override { return 3; }
  int tangentSize() const override { return 3; }
  void plus(const double* x, const double* delta, double* y) const override {
    Eigen::Map<Eigen::Vector3d>{y} = toValue(geometry::plus(se2FromValue(x), Eigen::Map<const Eigen::Vector3d>(delta)));
  }
  void minus(const double* y, const double* x, double* delta) const override {
    Eigen::Map<Eigen::Vector3d>{delta} = geometry::minus(se2FromValue(y), se2FromValue(x));
  }
  void move(const geometry::Se3& a_from_b, const double* x, double* y) const override {
    const geometry::Se2 pose = se2FromValue(x);
    const Eigen::Vector3d position = a_from_b * Eigen::Vector3d(pose.x, pose.y, 0);
    const Eigen::Matrix3d rotation = a_from_b.rotation.toRotationMatrix();
    const double turn = std::atan2(rotation(1, 0), rotation(0, 0));
    Eigen::Map<Eigen::Vector3d>{y} = Eigen::Vector3d(position.x(), position.y(), geometry::wrapToPi(pose.yaw + turn));
  }
};

class Se3Variable : public PlacedVariable {
 public:
  std::string_view kind() const override { return "se3"; }
  int ambientSize() const override { return 7; }
  int tangentSize() const override { return 6; }
  void plus(const double* x, const double* delta, double* y) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 1>>{y} =
        toValue(geometry::plus(se3FromValue(x), Eigen::Map<const geometry::Vector6d>(delta)));
  }
  void minus(const double* y, const double* x, double* delta) const override {
    Eigen::Map<geometry::Vector6d>{delta} = geometry::minus(se3FromValue(y), se3FromValue(x));
  }
  void move(const geometry::Se3& a_from_b, const double* x, double* y) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 1>>{y} = toValue(a_from_b * se3FromValue(x));
  }
};

template <int n>
class PointVariable : public PlacedVariable {
 public:
  std::string_view kind() const override { return n == 2 ? "point2" : "point3"; }
  int ambientSize() const override { return n; }
  int tangentSize() const override { return n; }
  void plus(const double* x, const double* delta, double* y) const override {
    for (int i = 0; i < n; ++i) y[i] = x[i] + delta[i];
  }
  void minus(const double* y, const double* x, double* delta) const override {
    for (int i = 0; i < n; ++i) delta[i] = y[i] - x[i];
  }
  void move(const geometry::Se3& a_from_b, const double* x, double* y) const override {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    point.head<n>() = Eigen::Map<const Eigen::Matrix<double, n, 1>>(x);
    Eigen::Map<Eigen::Matrix<double, n, 1>>{y} = (a_from_b * point).template head<n>();
  }
};

class PanTiltVariable : public Variable {
 public:
  std::string_view kind() const override { return PanTiltKind::kName; }
  int ambientSize() const override { return 2; }
  int tangentSize() const override { return 2; }
  void plus(const double* x, const double* delta, double* y) const override {
    for (int i = 0; i < 2; ++i) y[i] = x[i] + delta[i];
  }
  void minus(const double* y, const double* x, double* delta) const override {
    for (int i = 0; i < 2; ++i) delta[i] = y[i] - x[i];
  }
};

}  // namespace

const std::shared_ptr<const Variable>& se2() {
  static const std::shared_ptr<const Variable> kind = std::make_shared<Se2Variable>();
  return kind;
}

const std::shared_ptr<const Variable>& se3() {
  static const std::shared_ptr<const Variable> kind = std::make_shared<Se3Variable>();
  return kind;
}

const std::shared_ptr<const Variable>& point2() {
  static const std::shared_ptr<const Variable> kind = std::make_shared<PointVariable<2>>();
  return kind;
}

const std::shared_ptr<const Variable>& point3() {
  static const std::shared_ptr<const Variable> kind = std::make_shared<PointVariable<3>>();
  return kind;
}

const std::shared_ptr<const Variable>& panTilt() {
  static const std::shared_ptr<const Variable> kind = std::make_shared<PanTiltVariable>();
  return kind;
}

Eigen::Vector3d toValue(const geometry::Se2& pose) {
  return {pose.x, pose.y, pose.yaw};
}

Eigen::Matrix<double, 7, 1> toValue(const geometry::Se3& pose) {
  Eigen::Matrix<double, 7, 1> value;
  value << pose.translation, pose.rotation.coeffs();
  return value;
}

}  // namespace omnimapper::graph
