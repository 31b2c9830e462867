#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>

#include <limits>
#include <random>

namespace omnimapper::base::stamp_test {
namespace {

// 2000-01-01 00:00:00 UTC is Unix second 946684800; 1601 lies 11644473600 s before 1970, a tick is 100 ns.
constexpr std::int64_t kTicksOfYear2000 = (946'684'800LL + 11'644'473'600LL) * 10'000'000LL;

TEST(Stamp, CountsTicksOf100NanosecondsSince1601) {
  EXPECT_EQ(parseUnix("946684800").time_since_epoch().count(), kTicksOfYear2000);
  EXPECT_EQ(parseUnix("946684800.0000001").time_since_epoch().count(), kTicksOfYear2000 + 1);
  EXPECT_EQ(stampFromUnix(946684800.25).time_since_epoch().count(), kTicksOfYear2000 + 2'500'000);
}

TEST(Stamp, TenThousandRandomStampsSurviveTextUnchanged) {
  std::mt19937_64 random(1601);
  std::uniform_int_distribution<std::int64_t> ticks(0, 4'102'444'800LL * 10'000'000LL);  // up to the year 2100
  const std::int64_t unix_epoch = kTicksOfYear2000 - 946'684'800LL * 10'000'000LL;
  for (int i = 0; i < 10'000; ++i) {
    const Stamp stamp{Duration(unix_epoch + ticks(random))};
    const std::string text = formatUnix(stamp);
    ASSERT_EQ(parseUnix(text), stamp) << text;
    ASSERT_EQ(formatUnix(parseUnix(text)), text);
  }
}

TEST(Stamp, ADoubleHoldsAPresentDayStampToAQuarterMicrosecond) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> ticks(0, 1'000'000'000LL * 10'000'000LL);
  for (int i = 0; i < 10'000; ++i) {
    const Stamp stamp{Duration(kTicksOfYear2000 + ticks(random))};
    ASSERT_LE(std::abs((stampFromUnix(unixSeconds(stamp)) - stamp).count()), 3);
  }
}

TEST(Stamp, PrintsFewerDecimalsRounded) {
  const Stamp stamp = parseUnix("1137834225.9737656");
  EXPECT_EQ(formatUnix(stamp), "1137834225.9737656");
  EXPECT_EQ(formatUnix(stamp, 6), "1137834225.973766");
  EXPECT_EQ(formatUnix(stamp, 1), "1137834226.0");
  EXPECT_EQ(formatUnix(stamp, 0), "1137834226");
}

TEST(Stamp, PrintsAndReadsMomentsBefore1970) {
  EXPECT_EQ(formatUnix(parseUnix("-0.05")), "-0.0500000");
  EXPECT_EQ(formatUnix(parseUnix("-12.5"), 1), "-12.5");
}

TEST(Stamp, RoundsDecimalsBeyondTheTick) {
  EXPECT_EQ(formatUnix(parseUnix("1.23456784")), "1.2345678");
  EXPECT_EQ(formatUnix(parseUnix("1.23456785")), "1.2345679");
  EXPECT_EQ(formatUnix(parseUnix("1.999999951")), "2.0000000");
  EXPECT_EQ(formatUnix(parseUnix("1305031102.175299883000000000000000")), "1305031102.1752999");
}

TEST(Stamp, RefusesTextThatIsNoTime) {
  for (const char* text : {"", ".", "-", "abc", "1.2.3", "1e9", "12 ", " 12", "+5", "0x10", "nan", "1,5"}) {
    EXPECT_THROW(parseUnix(text), Error) << "'" << text << "'";
  }
}

TEST(Stamp, RefusesSecondsThatOverflowTheTicks) {
  for (const char* text : {"999999999999999999", "1000000000000000000000", "-1000000000000000"}) {
    EXPECT_THROW(parseUnix(text), Error) << text;
  }
}

TEST(Stamp, NoStampAndMomentsBefore1970AreNotValid) {
  EXPECT_FALSE(isValid(Stamp()));
  EXPECT_FALSE(isValid(parseUnix("-1")));
  EXPECT_FALSE(isValid(parseUnix("0")));
  EXPECT_TRUE(isValid(parseUnix("0.0000001")));
  EXPECT_TRUE(isValid(parseUnix("70.179699")));  // CARMEN logs count from the start of the program
  EXPECT_FALSE(isValid(Stamp(Duration(std::numeric_limits<std::int64_t>::max()))));
}

TEST(Stamp, StampsOfDamagedFilesDoNotOverflow) {
  const Stamp first{Duration(INT64_MIN)}, last{Duration(INT64_MAX)};
  EXPECT_GT(secondsBetween(first, last), 1e11);
  EXPECT_LT(secondsBetween(last, first), -1e11);
  EXPECT_FALSE(isValid(first));
  EXPECT_LT(unixSeconds(first), 0);
  EXPECT_EQ(formatUnix(first).front(), '-');
}

TEST(Stamp, DifferencesAreExactToTheTick) {
  EXPECT_DOUBLE_EQ(secondsBetween(parseUnix("1137834225.9"), parseUnix("1137834226.0000001")), 0.1000001);
  EXPECT_DOUBLE_EQ(secondsBetween(parseUnix("10"), parseUnix("8.5")), -1.5);
  EXPECT_EQ(durationFromSeconds(0.1).count(), 1'000'000);
  EXPECT_EQ(durationFromSeconds(-0.00000004).count(), 0);
  EXPECT_DOUBLE_EQ(toSeconds(durationFromSeconds(-3.25)), -3.25);
}

}  // namespace
}  // namespace omnimapper::base::stamp_test
