#include <gtest/gtest.h>
#include <omnimapper/geometry/Angle.h>

#include "back_end/judgeTilt.h"

namespace omnimapper::mapper {
namespace {

// Of ten key frames the first `tilted` are followed by a motion that pitches by `deg`; all turn by 90 deg.
map::Map tenFrames(std::uint32_t tilted, double deg) {
  map::Map map;
  for (std::uint32_t i = 0; i < 10; ++i) {
    map::KeyFrame frame;
    frame.id = {0, i};
    frame.stamp = base::stampFromUnix(1e9 + i);
    frame.keyframe_from_next =
        mrpt::poses::CPose3D(1, 0, 0, geometry::kPi / 2, i < tilted ? deg * geometry::kPi / 180 : 0, 0);
    map.key_frames.insert(std::move(frame));
  }
  return map;
}

TEST(JudgeTilt, SaysNothingOfRobotsThatPassAThresholdOrARamp) {
  EXPECT_FALSE(judgeTilt({}));
  EXPECT_FALSE(judgeTilt(tenFrames(10, 4)));
  EXPECT_FALSE(judgeTilt(tenFrames(1, 30)));
}

TEST(JudgeTilt, IsAgainstAFlatMapFromAHand) {
  const auto evidence = judgeTilt(tenFrames(3, 12));
  ASSERT_TRUE(evidence);
  EXPECT_EQ(evidence->says, Evidence::Says::against_it);
  EXPECT_DOUBLE_EQ(evidence->value, 30);
  EXPECT_NE(evidence->reason.find("in 30 % of them (at most 12 deg)"), std::string::npos) << evidence->reason;
  EXPECT_NE(evidence->reason.find("rgbd_handheld.ini"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::mapper
