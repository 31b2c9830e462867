// omnimapper-calibrate pointing: from recordings of people who point at known targets to tables of their errors.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/calibration/PointingRun.h>
#include <omnimapper/interaction/PointingTables.h>
#include <omnimapper/interaction/PointingTarget.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <fstream>
#include <random>

namespace omnimapper::calibration::pointing_run_test {
namespace {

using Eigen::Vector3d;
using interaction::PointingRow;
using mrpt::obs::CObservationSkeleton;

constexpr double kDegree = M_PI / 180;
constexpr int kUsers = 6, kFrames = 30;

const Vector3d kTargets[] = {{1.2, -1.0, 0.75}, {0.9, 0.1, 0.75}, {1.4, 0.9, 0.75}, {2.2, 1.5, 0.75},
                             {2.6, 2.0, 1.2},   {1.8, 2.0, 1.6},  {1.0, 2.0, 1.2}};

/// A person who stands 2 m before the base and points with errors of the tables, as NiTE writes it: millimetres, x to
/// the right, y up, z ahead, seen from the base at 1 m.
class Recording {
 public:
  explicit Recording(const std::string& folder) : log(folder + "/people.rawlog"), table(folder + "/people.csv") {
    std::mt19937_64 random(3);
    std::normal_distribution<double> gaussian;
    std::ofstream rows(table);
    rows << "person,target,x_m,y_m,z_m,begin_s\n";
    source::writeRawlog(log, [&](source::RawlogWriter& writer) {
      double time = 1.6e9;
      for (int user = 0; user < kUsers; ++user) {
        for (int target = 0; target < 7; ++target, time += 5) {
          const PointingRow row = interaction::thesisRow(interaction::SkeletonSoftware::openni, target + 1);
          rows << "user " << user << ",target " << target + 1 << "," << kTargets[target].x() << ","
               << kTargets[target].y() << "," << kTargets[target].z() << ","
               << base::formatUnix(base::stampFromUnix(time)) << "\n";
          for (int frame = 0; frame < kFrames; ++frame) {
            const auto drawn = [&](const interaction::RayErrors& ray) {
              const double theta = ray.theta.mean + ray.theta.sigma * gaussian(random);
              return interaction::PointingError{theta, ray.psi.mean + ray.psi.sigma * gaussian(random)};
            };
            const auto elbow = drawn(row.elbow_hand), head = drawn(row.head_hand);
            writer.add(skeleton(kTargets[target], elbow, head, time + frame / 30.0));
          }
        }
      }
    });
  }

  std::string log, table;

 private:
  static CObservationSkeleton skeleton(const Vector3d& target, const interaction::PointingError& elbow_error,
                                       const interaction::PointingError& head_error, double time) {
    const Vector3d hand = Vector3d(2, 0.2, 1.35) + 0.45 * (target - Vector3d(2, 0.2, 1.35)).normalized();
    CObservationSkeleton s;
    s.timestamp = base::stampFromUnix(time);
    s.sensorLabel = "nite";
    s.sensorPose = mrpt::poses::CPose3D(0, 0, 1);
    const auto put = [](CObservationSkeleton::TSkeletonJoint& joint, const Vector3d& p) {
      joint.x = -1000 * p.y(), joint.y = 1000 * (p.z() - 1), joint.z = 1000 * p.x(), joint.conf = 1;
    };
    put(s.right_hand, hand);
    put(s.right_elbow, hand - 0.3 * interaction::directionWithError(hand, target, elbow_error));
    put(s.head, hand - 0.6 * interaction::directionWithError(hand, target, head_error));
    put(s.torso, {2, 0, 0.6});
    put(s.left_hip, {2, -0.1, 0.4});
    put(s.right_hip, {2, 0.1, 0.4});
    put(s.left_shoulder, {2, -0.2, 1.35});
    put(s.left_elbow, {2, -0.2, 1.05});
    put(s.left_hand, {2, -0.2, 0.75});
    return s;
  }
};

class PointingRun : public ::testing::Test {
 protected:
  CalibrationResult run(const std::string& table) const {
    PointingRequest request;
    request.logs = {recording_.log};
    request.gestures = table;
    request.output = folder_ / "out";
    base::Progress silent;
    return runPointingCalibration(request, silent, [] { return false; });
  }
  std::string refusal(const std::string& rows) const {
    const std::string path = folder_ / "bad.csv";
    std::ofstream(path) << "person,target,x_m,y_m,z_m,begin_s,end_s,arm\n" << rows;
    try {
      run(path);
    } catch (const base::Error& error) {
      return error.what();
    }
    return "taken";
  }
  testing::ScratchFolder folder_;
  Recording recording_{folder_.path()};
};

TEST_F(PointingRun, recoversTheTablesOfSixUsersAndSevenTargets) {
  const auto result = run(recording_.table);
  EXPECT_EQ(result.code, base::ExitCode::ok);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_NE(result.text.find("1260 frames of 7 targets"), std::string::npos) << result.text;
  const auto model = interaction::readPointingModel(folder_ / "out/pointing.csv");
  ASSERT_EQ(model.rows.size(), 7u);
  for (int target = 1; target <= 7; ++target) {
    const PointingRow& found = model.rows[static_cast<std::size_t>(target - 1)];
    const PointingRow truth = interaction::thesisRow(interaction::SkeletonSoftware::openni, target);
    for (const auto ray : {&PointingRow::elbow_hand, &PointingRow::head_hand}) {
      for (const auto angle : {&interaction::RayErrors::theta, &interaction::RayErrors::psi}) {
        const auto &is = found.*ray.*angle, &was = truth.*ray.*angle;
        EXPECT_NEAR(is.mean / kDegree, was.mean / kDegree, std::max(1.0, 4 * was.sigma / kDegree / std::sqrt(180.0)));
        EXPECT_NEAR(is.sigma / was.sigma, 1, 0.15) << target;
      }
    }
  }
  std::ifstream svg(folder_ / "out/pointing.svg");
  EXPECT_TRUE(svg);
}

TEST_F(PointingRun, refusesWhatCannotBeRightAndNamesTheLine) {
  const auto expect = [&](const std::string& rows, const std::string& why) {
    EXPECT_NE(refusal(rows).find(why), std::string::npos) << refusal(rows);
  };
  expect("", "has no row");
  expect("anna,cup,1,nan,1,1600000000,,\n", "y_m");
  expect("anna,cup,1,0,1,soon,,\n", "begin_s is 'soon', which is no Unix time");
  expect("anna,cup,1,0,1,1600000000,1599999999,\n", "end_s is not after begin_s");
  expect("anna,cup,1,0,1,1600000000,,both\n", "arm is 'both'; it is right or left");
  expect(",cup,1,0,1,1600000000,,\n", "person and target need a name");
  expect("anna,cup,1,0,1,1600000000,,\nben,cup,3,0,1,1600000005,,\n", ":3");
  expect("anna,cup,1,0,1,1700000000,,\n", "bad.csv:2: anna points at 'cup', but no log has a skeleton at that time");
}

}  // namespace
}  // namespace omnimapper::calibration::pointing_run_test
