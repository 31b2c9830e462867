// Findings about absolute poses.
#include <mrpt/obs/CObservationRobotPose.h>

#include "CheckedLog.h"

namespace omnimapper::check::poses_test {
namespace {

TEST(Poses, ThatStandOnTheirSideAreAProblem) {
  const auto textOf = [](double roll) {
    auto log = halfALap();
    for (int i = 0; i < 20; ++i) {
      auto pose = mrpt::obs::CObservationRobotPose::Create();
      pose->sensorLabel = "tracker";
      pose->timestamp = log.back()->timestamp + base::durationFromSeconds(0.1);
      pose->pose.mean = mrpt::poses::CPose3D(i, 0, 1, 0.3 * i, 0.1, roll);
      log.push_back(pose);
    }
    return Checked(log).text();
  };
  EXPECT_NE(textOf(-1.5).find("problem: 'tracker': the poses are not level: on average the base is tilted by"),
            std::string::npos)
      << textOf(-1.5);
  EXPECT_EQ(textOf(-1.5).find("it copes"), std::string::npos) << textOf(-1.5);
  EXPECT_EQ(textOf(0.3).find("level"), std::string::npos) << textOf(0.3);
  EXPECT_EQ(textOf(0.9).find("problem: 'tracker'"), std::string::npos) << "a camera in the hand that looks down";
  EXPECT_NE(textOf(0.9).find("right for a camera in the hand"), std::string::npos) << textOf(0.9);
}

}  // namespace
}  // namespace omnimapper::check::poses_test
