#include <gtest/gtest.h>
#include <omnimapper/drivers/OdometryLine.h>

#include <random>

namespace omnimapper::drivers::odometry_line_test {
namespace {

std::optional<LineFault> faultOf(const std::string& line) {
  return parseOdometryLine(line).fault;
}

TEST(OdometryLine, fourWordsArePoseAndSevenHaveTheVelocity) {
  const auto pose = parseOdometryLine("1790000000.25 1.5 -2 0.75");
  ASSERT_FALSE(pose.fault);
  EXPECT_EQ(pose.stamp, base::stampFromUnix(1'790'000'000.25));
  EXPECT_EQ(pose.odometry.odometry.x(), 1.5);
  EXPECT_EQ(pose.odometry.odometry.y(), -2);
  EXPECT_EQ(pose.odometry.odometry.phi(), 0.75);
  EXPECT_FALSE(pose.odometry.hasVelocities);
  const auto both = parseOdometryLine("\t- 1 2 3e-1  0.5 0 -0.25 ");
  ASSERT_FALSE(both.fault);
  EXPECT_FALSE(both.stamp);
  ASSERT_TRUE(both.odometry.hasVelocities);
  EXPECT_EQ(both.odometry.velocityLocal.vx, 0.5);
  EXPECT_EQ(both.odometry.velocityLocal.omega, -0.25);
}

TEST(OdometryLine, stampsAreExactToTheTick) {
  for (const char* text : {"1790000000.1234567", "1790000000", "0.0000001", "1790000000.9999999"})
    EXPECT_EQ(parseOdometryLine(std::string(text) + " 0 0 0").stamp, base::parseUnix(text)) << text;
  EXPECT_EQ(parseOdometryLine("1790000000.123456789 0 0 0").stamp, base::parseUnix("1790000000.1234568"));
}

TEST(OdometryLine, whatIsNoLineIsMalformed) {
  for (const char* line : {"",
                           " ",
                           "1",
                           "1 2 3",
                           "1 2 3 4 5",
                           "1 2 3 4 5 6",
                           "1 2 3 4 5 6 7 8",
                           "x 1 2 3",
                           "1 2 3 four",
                           "1 2 3 4m",
                           "1,2,3,4",
                           "1 0x10 0 0",
                           "-5 0 0 0",
                           "1. 0 0 0",
                           "1.-5 0 0 0",
                           "1.1234567891 0 0 0",
                           "1e9 0 0 0",
                           "nan 0 0 0",
                           "99999999999 0 0 0",
                           "99999999999999999999 0 0 0",
                           "1 - 0 0",
                           "1 1e999 0 0",
                           "1 0 0 --1"})
    EXPECT_EQ(faultOf(line), LineFault::malformed) << line;
  EXPECT_EQ(faultOf(std::string("1 2\0 3 4", 8)), LineFault::malformed);
}

TEST(OdometryLine, whatIsNoFiniteNumberIsRejected) {
  for (const char* line :
       {"1 nan 0 0", "1 0 -nan 0", "1 0 0 inf", "1 -inf 0 0", "1 0 0 0 nan 0 0", "1 0 0 0 0 0 infinity"})
    EXPECT_EQ(faultOf(line), LineFault::not_finite) << line;
}

TEST(OdometryLine, whatIsBeyondAllBoundsIsRejected) {
  for (const char* line : {"1 1.1e6 0 0", "1 0 -1e300 0", "1 0 0 6284", "1 0 0 0 101 0 0", "1 0 0 0 0 0 -1e9"})
    EXPECT_EQ(faultOf(line), LineFault::too_large) << line;
  EXPECT_FALSE(faultOf("1 1e6 -1e6 6283"));
}

TEST(OdometryLine, anyBytesAreRead) {
  std::mt19937 random(7);
  for (int i = 0; i < 20'000; ++i) {
    std::string line(random() % 64, ' ');
    for (char& byte : line) byte = random() % 4 ? "0123456789.-+e naif\t"[random() % 20] : static_cast<char>(random());
    const auto read = parseOdometryLine(line);
    if (read.fault) continue;
    EXPECT_LE(std::abs(read.odometry.odometry.x()), 1e6) << line;
  }
}

}  // namespace
}  // namespace omnimapper::drivers::odometry_line_test
