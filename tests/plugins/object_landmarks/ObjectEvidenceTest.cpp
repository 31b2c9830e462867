#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>

#include <algorithm>
#include <sstream>

#include "object_landmarks/ObjectEvidence.h"

namespace omnimapper::plugins::object_evidence_test {
namespace {

base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000 + seconds);
}

std::string bytesOf(const ObjectEvidence& evidence) {
  std::ostringstream out;
  evidence.write(out);
  return out.str();
}

using Looks = std::vector<std::pair<Sight, double>>;

ObjectEvidence evidenceOf(const Looks& looks) {
  ObjectEvidence evidence;
  for (const auto& [sight, time] : looks) evidence.add(sight, at(time));
  return evidence;
}

TEST(ObjectEvidence, CountsWhatImagesShow) {
  const auto evidence = evidenceOf({{Sight::seen, 1},
                                    {Sight::hidden, 2},
                                    {Sight::seen, 3},
                                    {Sight::absent, 4},
                                    {Sight::hidden, 5},
                                    {Sight::unknown, 9}});
  EXPECT_EQ(evidence.seen_in, 2U);
  EXPECT_EQ(evidence.hidden_in, 2U);
  EXPECT_EQ(evidence.absent_in, 1U);
  EXPECT_EQ(evidence.first_seen, at(1));
  EXPECT_EQ(evidence.last_seen, at(3));
  EXPECT_EQ(evidence.last_looked, at(5)) << "an image that says nothing is no look";
  EXPECT_EQ(evidence.absent_at, std::vector{at(4)});
}

TEST(ObjectEvidence, OnlyImagesSinceItWasLastSeenSayThatItIsGone) {
  Looks looks{{Sight::absent, 1}, {Sight::absent, 2}, {Sight::seen, 3},
              {Sight::absent, 4}, {Sight::hidden, 5}, {Sight::absent, 6}};
  EXPECT_FALSE(evidenceOf(looks).saysGone(3, 1)) << "it was seen after two of the four";
  EXPECT_TRUE(evidenceOf(looks).saysGone(2, 1));
  EXPECT_FALSE(evidenceOf(looks).saysGone(2, 2.5)) << "two images within two seconds";
  looks.emplace_back(Sight::absent, 8);
  EXPECT_TRUE(evidenceOf(looks).saysGone(3, 4));
}

TEST(ObjectEvidence, HiddenNeverSaysGone) {
  ObjectEvidence evidence;
  evidence.add(Sight::seen, at(0));
  for (int i = 1; i < 1000; ++i) evidence.add(Sight::hidden, at(i));
  EXPECT_FALSE(evidence.saysGone(1, 0));
  EXPECT_EQ(evidence.hidden_in, 999U);
}

TEST(ObjectEvidence, TheOrderMakesNoDifference) {
  Looks looks{{Sight::absent, 1}, {Sight::seen, 2}, {Sight::absent, 3}, {Sight::hidden, 4}, {Sight::absent, 5}};
  const std::string bytes = bytesOf(evidenceOf(looks));
  std::sort(looks.begin(), looks.end());
  do {
    EXPECT_EQ(bytesOf(evidenceOf(looks)), bytes);
  } while (std::next_permutation(looks.begin(), looks.end()));
  ObjectEvidence sum = evidenceOf({looks[0], looks[1]});
  sum.add(evidenceOf({looks[2], looks[3], looks[4]}));
  EXPECT_EQ(bytesOf(sum), bytes) << "nor whether it was one object or two that were merged";
}

TEST(ObjectEvidence, KeepsTheLatestStampsOnly) {
  ObjectEvidence evidence;
  for (int i = 0; i < 100; ++i) evidence.add(Sight::absent, at(i));
  EXPECT_EQ(evidence.absent_in, 100U);
  ASSERT_EQ(evidence.absent_at.size(), ObjectEvidence::kMostStamps);
  EXPECT_EQ(evidence.absent_at.back(), at(99));
}

TEST(ObjectEvidence, IsReadAsItWasWritten) {
  const std::string bytes = bytesOf(evidenceOf({{Sight::seen, 1}, {Sight::absent, 4}, {Sight::absent, 6}}));
  std::istringstream in(bytes);
  EXPECT_EQ(bytesOf(ObjectEvidence::read(in)), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    std::istringstream cut(bytes.substr(0, size));
    EXPECT_THROW(ObjectEvidence::read(cut), base::Error) << size;
  }
  std::string swapped = bytes;  // the two stamps at the end
  std::rotate(swapped.end() - 16, swapped.end() - 8, swapped.end());
  std::istringstream disordered(swapped);
  EXPECT_THROW(ObjectEvidence::read(disordered), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::object_evidence_test
