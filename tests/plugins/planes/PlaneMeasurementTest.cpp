#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/testing/SimulatedLog.h>

#include "../../graph/Jacobians.h"
#include "SurfaceRun.h"
#include "planes/PlaneMeasurement.h"

namespace omnimapper::plugins::plane_measurement_test {
namespace {

using namespace surface_run;
using geometry::Se3;

PlaneLandmarksOptions smooth() {
  PlaneLandmarksOptions options;
  options.line_sigma = options.line_angle_sigma = 0;
  return options;
}

struct Mounting {
  const char* name;
  double roll;          // [rad] of the sensor: one that hangs upside down sees left and right swapped
  bool is_turned_back;  // its scans run clockwise, and so do its lines
};

class LineOfASensor : public ::testing::TestWithParam<Mounting> {
 protected:
  // Chi-square of the residual of a line, measured with those errors, against the true wall.
  double chi2(double angle_error, double distance_error) const {
    const Se3 base_from_sensor = geometry::fromMrpt(CPose3D(0.2, 0.1, 0.4, 0.3, 0, GetParam().roll));
    obs::CObservationLaserLines observation;
    observation.sensorPose = geometry::toMrpt(base_from_sensor);
    observation.lines = {measured(0.3 + angle_error, 2 + distance_error)};
    const auto measurements = planeMeasurements(
        observation, Vector3d::UnitZ(),
        plane_factors::PlaneParametrization::of(plane_factors::PlaneParametrization::Kind::plane), smooth());
    EXPECT_TRUE(measurements.at(0).why_useless.empty()) << measurements[0].why_useless;
    const Vector3d out(std::cos(0.3), std::sin(0.3), 0);
    const Plane3 wall = base_from_sensor * Plane3::through(2 * out, -out);
    const graph::Evaluation evaluation{*measurements[0].factor,
                                       {graph::se3(), plane_factors::planeVariable()},
                                       {graph::toValue(Se3{}), plane_factors::toValue(wall)}};
    return (measurements[0].noise.matrix() * evaluation.residual()).squaredNorm();
  }

  const Eigen::Matrix2d covariance_ = (Eigen::Matrix2d() << 1e-4, 1.5e-4, 1.5e-4, 4e-4).finished();

 private:
  obs::LaserLine measured(double angle, double distance) const {
    const Vector2d out(std::cos(angle), std::sin(angle)), along(-out.y(), out.x());
    obs::LaserLine seen;
    seen.angle = angle;
    seen.distance = distance;
    seen.covariance = covariance_;
    seen.segment_in_sensor = {distance * out - 0.5 * along, distance * out + 2.5 * along};
    if (GetParam().is_turned_back) std::swap(seen.segment_in_sensor.from, seen.segment_in_sensor.to);
    return seen;
  }
};

// The sum of chi-squares of (direction, offset) over 400 lines has 800 degrees of freedom, with 95 % bounds of 723 and
// 880.
TEST_P(LineOfASensor, IsAsUncertainAsItsCovarianceSays) {
  testing::Dice dice(3);
  const Eigen::Matrix2d root = covariance_.llt().matrixL();
  double sum = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector2d error = root * Vector2d(dice.normal(1), dice.normal(1));
    sum += chi2(error.x(), error.y());
  }
  EXPECT_GT(sum, 723);
  EXPECT_LT(sum, 880);
}

INSTANTIATE_TEST_SUITE_P(Mountings, LineOfASensor,
                         ::testing::Values(Mounting{"Upright", 0, false}, Mounting{"Clockwise", 0, true},
                                           Mounting{"UpsideDown", geometry::kPi, false},
                                           Mounting{"UpsideDownClockwise", geometry::kPi, true}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace omnimapper::plugins::plane_measurement_test
