#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/KeyFrames.h>

#include <vector>

namespace omnimapper::map::key_frames_test {
namespace {

KeyFrame keyFrame(std::uint16_t session, std::uint32_t index, double seconds) {
  KeyFrame frame;
  frame.id = {session, index};
  frame.stamp = base::stampFromUnix(1e9 + seconds);
  return frame;
}

std::vector<base::KeyFrameId> order(const KeyFrames& frames) {
  std::vector<base::KeyFrameId> ids;
  for (const auto& frame : frames) ids.push_back(frame.id);
  return ids;
}

TEST(KeyFrames, AreInTheOrderOfSessionThenStampWhateverTheOrderOfIds) {
  KeyFrames frames;
  frames.insert(keyFrame(0, 0, 10));
  frames.insert(keyFrame(0, 1, 30));
  frames.insert(keyFrame(1, 0, 5));  // a later session may have earlier stamps
  EXPECT_EQ(frames.insert(keyFrame(0, 2, 20)), 1U);
  EXPECT_EQ(frames.insert(keyFrame(0, 3, 1)), 0U);
  EXPECT_EQ(order(frames), (std::vector<base::KeyFrameId>{{0, 3}, {0, 0}, {0, 2}, {0, 1}, {1, 0}}));
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames.position(frames[i].id), i);
  EXPECT_EQ(frames.lowerBound(0, frames[2].stamp), 2U);
  EXPECT_EQ(frames.lowerBound(0, base::stampFromUnix(1e9 + 99)), 4U) << "where the session ends";
  EXPECT_EQ(frames.nextId(0), (base::KeyFrameId{0, 4}));
}

TEST(KeyFrames, AnIdOrAStampThatIsTakenIsAnError) {
  KeyFrames frames;
  frames.insert(keyFrame(0, 0, 1));
  EXPECT_THROW(frames.insert(keyFrame(0, 0, 2)), base::Error);
  EXPECT_THROW(frames.insert(keyFrame(0, 1, 1)), base::Error);
  EXPECT_THROW(frames.edit({0, 7}), base::Error);
  EXPECT_EQ(frames.size(), 1U);
}

TEST(KeyFrames, ACopyIsAsItWas) {
  KeyFrames frames;
  frames.insert(keyFrame(0, 0, 1));
  frames.insert(keyFrame(0, 1, 3));
  const KeyFrames copy = frames;
  frames.insert(keyFrame(0, 2, 2));
  frames.edit({0, 0}).reference = false;
  EXPECT_EQ(order(copy), (std::vector<base::KeyFrameId>{{0, 0}, {0, 1}}));
  EXPECT_TRUE(copy.front().reference);
}

}  // namespace
}  // namespace omnimapper::map::key_frames_test
