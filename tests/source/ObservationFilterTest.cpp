#include <omnimapper/base/Config.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

namespace omnimapper::source::observation_filter_test {
namespace {

using namespace logs;
using Strings = std::vector<std::string>;

class ObservationFilterTest : public ::testing::Test {
 protected:
  Strings read(const std::string& bytes, const SourceOptions& options) {
    RawlogSource source(writeGzip(folder_ / "x.rawlog", bytes), options);
    const auto observations = readAll(source);
    report_ = source.report();
    return listing(observations);
  }
  testing::ScratchFolder folder_;
  SourceReport report_;
};

std::string log() {
  return (Bytes() << odometry(10) << scan(10.5) << scan(11, "rear") << odometry(11.5) << scan(0) << scan(12)).string();
}

TEST_F(ObservationFilterTest, labelsLeaveTheRestOutAndCountIt) {
  SourceOptions options;
  options.labels = {"rear", "wheels"};
  EXPECT_EQ(read(log(), options), (Strings{"wheels 10", "rear 11", "wheels 11.5"}));
  EXPECT_EQ(report_.filtered_out, 3u);
  EXPECT_EQ(report_.filtered_labels.count("rear"), 0u);
  EXPECT_FALSE(report_.filtered_labels.empty());
  EXPECT_EQ(report_.sensors.size(), 2u);
}

TEST_F(ObservationFilterTest, timesCountFromTheFirstStampOfTheLogWhateverItsLabel) {
  SourceOptions options;
  options.labels = {"laser"};
  options.start = 0.25;
  options.end = 1.75;
  EXPECT_EQ(read(log(), options), (Strings{"laser 10.5"})) << "without a stamp it cannot be in a span of time";
  options.end = 0;
  EXPECT_EQ(read(log(), options), (Strings{"laser 10.5", "laser 12"}));
}

TEST_F(ObservationFilterTest, timesCanBeUnixTimes) {
  SourceOptions options;
  options.time_reference = TimeReference::unix_epoch;
  options.start = 1.6e9 + 11;
  options.end = 1.6e9 + 11.5;
  EXPECT_EQ(read(log(), options), (Strings{"rear 11", "wheels 11.5"})) << "both ends belong to the span";
}

TEST_F(ObservationFilterTest, motionIsWantedOnlyIfItsWholeSpanIs) {
  const auto frames =
      Bytes().frame({scan(1)}).action(1, 0, 0).frame({scan(2)}).action(1, 0, 0).frame({scan(3)}).string();
  SourceOptions options;
  options.start = 0.5;
  EXPECT_EQ(read(frames, options), (Strings{"laser 2", "odometry 3", "laser 3"}));
  options.labels = {"laser"};
  EXPECT_EQ(read(frames, options), (Strings{"laser 2", "laser 3"}));
}

TEST_F(ObservationFilterTest, oneStampFarInTheFutureDoesNotEndTheLog) {
  SourceOptions options;
  options.end = 5;
  EXPECT_EQ(read((Bytes() << scan(1) << scan(1e6, "mad") << scan(2)).string(), options),
            (Strings{"laser 1", "laser 2"}));
}

TEST_F(ObservationFilterTest, longAfterTheEndTheRestIsNotRead) {
  Bytes bytes;
  for (int i = 0; i < 3000; ++i) bytes << odometry(1 + i);
  SourceOptions options;
  options.end = 9.5;
  EXPECT_EQ(read(bytes.string(), options).size(), 10u);
  EXPECT_LT(report_.objects, 1100u);
  EXPECT_EQ(report_.ending, SourceReport::Ending::complete);
}

TEST(SourceOptions, areReadFromAnIni) {
  const auto config = base::Config::fromText(
      "[source]\nlabels = a, b\nstart_s = 1.5\naction_span = own\ntime_reference = unix\nimages_folder = pictures\n",
      "t");
  const auto options = config.section("source").read<SourceOptions>();
  EXPECT_EQ(options.labels, (Strings{"a", "b"}));
  EXPECT_EQ(options.start, 1.5);
  EXPECT_EQ(options.action_span, ActionSpan::own);
  EXPECT_EQ(options.time_reference, TimeReference::unix_epoch);
  EXPECT_EQ(options.images_folder, "pictures");
  EXPECT_EQ(options.action_label, "odometry");
  for (const auto& spec : SourceOptions::table().specs()) EXPECT_FALSE(spec.help.empty()) << spec.key;
}

}  // namespace
}  // namespace omnimapper::source::observation_filter_test
