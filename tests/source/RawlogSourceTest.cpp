#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CRawlog.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

namespace omnimapper::source::rawlog_source_test {
namespace {

using namespace logs;
using Strings = std::vector<std::string>;
using Ending = SourceReport::Ending;

class RawlogSourceTest : public ::testing::Test {
 protected:
  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "x.rawlog";
};

std::string observationLog() {
  return (Bytes() << odometry(1) << scan(1.1) << odometry(2) << scan(2.1)).string();
}

TEST_F(RawlogSourceTest, streamsObservationsInTheOrderOfTheFilePlainOrGzip) {
  const Strings expected = {"wheels 1", "laser 1.1", "wheels 2", "laser 2.1"};
  for (const bool gzip : {false, true}) {
    gzip ? writeGzip(path_, observationLog()) : writePlain(path_, observationLog());
    RawlogSource source(path_);
    const auto observations = readAll(source);
    EXPECT_EQ(listing(observations), expected);
    const auto report = source.report();
    EXPECT_EQ(report.ending, Ending::complete);
    EXPECT_EQ(report.exitCode(), base::ExitCode::ok);
    EXPECT_EQ(report.message, "");
    EXPECT_EQ(report.objects, 4u);
    EXPECT_EQ(report.bytes, observationLog().size());
    EXPECT_EQ(source.progress(), 1.0);
  }
}

TEST_F(RawlogSourceTest, observationsComeOutWithTheBitsThatWereSaved) {
  writeGzip(path_, observationLog());
  RawlogSource source(path_);
  Bytes again;
  for (const auto& observation : readAll(source)) again << observation;
  EXPECT_EQ(again.string(), observationLog());
}

TEST_F(RawlogSourceTest, unpacksFramesAndPutsTheMotionBeforeTheFrameThatEndsIt) {
  const auto bytes = Bytes()
                         .action(9, 9, 0)
                         .frame({scan(1), scan(1.05, "rear")})
                         .action(0.5, 0, 0)
                         .frame({scan(2), scan(2.05, "rear")})
                         .string();
  for (const bool gzip : {false, true}) {
    gzip ? writeGzip(path_, bytes) : writePlain(path_, bytes);
    RawlogSource source(path_);
    EXPECT_EQ(listing(readAll(source)), (Strings{"laser 1", "rear 1.05", "odometry 2.05", "laser 2", "rear 2.05"}));
    EXPECT_EQ(source.report().dropped_actions, 1u);
  }
}

TEST_F(RawlogSourceTest, readsBothFormatsMixed) {
  writeGzip(path_, (Bytes() << odometry(0.5)).frame({scan(1)}).action(0.1, 0, 0).frame({scan(2)}).string() +
                       (Bytes() << odometry(2.5)).string());
  RawlogSource source(path_);
  EXPECT_EQ(listing(readAll(source)), (Strings{"wheels 0.5", "laser 1", "odometry 2", "laser 2", "wheels 2.5"}));
}

TEST_F(RawlogSourceTest, streamsARawlogThatWasSavedAsOneObject) {
  mrpt::obs::CRawlog rawlog;
  rawlog.insert(odometry(1));
  rawlog.insert(scan(1.1));
  rawlog.setCommentText("two things");
  writeGzip(path_, (Bytes() << rawlog << odometry(2)).string());
  RawlogSource source(path_);
  EXPECT_EQ(listing(readAll(source)), (Strings{"wheels 1", "laser 1.1", "wheels 2"}));
  EXPECT_EQ(source.report().ending, Ending::complete);
}

TEST_F(RawlogSourceTest, countsBySensorZeroAndBackwardStampsAndWhatIsNoObservation) {
  mrpt::obs::CObservationComment comment;
  comment.text = "hello";
  writeGzip(path_,
            (Bytes() << comment << scan(1) << scan(3) << scan(2) << scan(0) << scan(4) << odometry(2.5)).string());
  RawlogSource source(path_);
  EXPECT_EQ(readAll(source).size(), 6u);
  const auto report = source.report();
  const auto& laser = report.sensors.at({"laser", "mrpt::obs::CObservation2DRangeScan"});
  EXPECT_EQ(laser.observations, 5u);
  EXPECT_EQ(laser.zero_stamps, 1u);
  EXPECT_EQ(laser.backward_stamps, 1u);
  EXPECT_EQ(laser.first_stamp, at(1));
  EXPECT_EQ(laser.last_stamp, at(4));
  EXPECT_EQ(report.sensors.at({"wheels", "mrpt::obs::CObservationOdometry"}).backward_stamps, 0u)
      << "another sensor's stamps are another matter";
  EXPECT_EQ(report.other_objects.at("mrpt::obs::CObservationComment"), 1u);
  EXPECT_EQ(report.observations(), 6u);
  const auto text = report.text();
  for (const char* word : {"complete", "laser", "wheels", "CObservationComment", "1600000004.000000"})
    EXPECT_NE(text.find(word), std::string::npos) << word << " is not in\n" << text;
}

TEST_F(RawlogSourceTest, emptyGzipIsALogWithoutObservations) {
  writeGzip(path_, "");
  RawlogSource source(path_);
  EXPECT_EQ(source.next(), nullptr);
  EXPECT_EQ(source.report().ending, Ending::complete);
}

TEST_F(RawlogSourceTest, severalGzipMembersAreOneLog) {
  writeGzip(path_, (Bytes() << odometry(1)).string());
  const auto first = readFile(path_);
  writeGzip(path_, (Bytes() << odometry(2)).string());
  writePlain(path_, first + readFile(path_) + std::string(512, '\0'));
  RawlogSource source(path_);
  EXPECT_EQ(listing(readAll(source)), (Strings{"wheels 1", "wheels 2"}));
  EXPECT_EQ(source.report().ending, Ending::complete);
}

TEST_F(RawlogSourceTest, openingCanBeStopped) {
  writeGzip(path_, (Bytes() << scan(1)).string());
  const std::string other = writeGzip(folder_ / "y.rawlog", (Bytes() << scan(2)).string());
  for (int asked_before : {0, 1}) {
    try {
      openLogs({path_, other}, {}, [&] { return asked_before-- == 0; });
      ADD_FAILURE() << "it was not stopped";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::interrupted);
    }
  }
}

// More objects than a child process can report before its parent reads the reports.
TEST_F(RawlogSourceTest, aLogIsReadWhileTheChildReadsAheadAndCanBeLeftAtAnyTime) {
  const std::string one = (Bytes() << scan(1)).string();
  std::string all;
  for (int i = 0; i < (testing::kIsSanitized ? 5000 : 100000); ++i) all += one;
  writePlain(path_, all);
  for (int taken : {0, 1, 1000}) {
    RawlogSource source(path_);
    for (int i = 0; i < taken; ++i) EXPECT_NE(source.next(), nullptr);
  }
  RawlogSource source(path_);
  EXPECT_NE(source.next(), nullptr);
  source.interrupt();
  EXPECT_EQ(source.next(), nullptr);
  EXPECT_EQ(source.report().ending, SourceReport::Ending::open);
}

TEST_F(RawlogSourceTest, openLogsMergesByStampAndCountsTimeFromTheEarliestLog) {
  writeGzip(path_, (Bytes() << odometry(10) << odometry(11) << odometry(12)).string());
  const auto other = writeGzip(folder_ / "y.rawlog", (Bytes() << scan(9) << scan(10.5) << scan(11.5)).string());
  EXPECT_EQ(listing(readAll(*openLogs({path_, other}, {}))),
            (Strings{"laser 9", "wheels 10", "laser 10.5", "wheels 11", "laser 11.5", "wheels 12"}));
  SourceOptions options;
  options.start = 1.5;
  options.end = 2.5;
  EXPECT_EQ(listing(readAll(*openLogs({path_, other}, options))), (Strings{"laser 10.5", "wheels 11", "laser 11.5"}));
  EXPECT_THROW(openLogs({}, {}), base::Error);
}

TEST_F(RawlogSourceTest, sensorsWhoseClocksAreCorrectedAreSortedByTheirTrueStamps) {
  writeGzip(path_, (Bytes() << odometry(10) << scan(10.5) << odometry(11) << scan(11.5) << odometry(12)).string());
  const auto log = openLogs({path_}, {});
  EXPECT_EQ(listing(readAll(*log)), (Strings{"wheels 10", "laser 10.5", "wheels 11", "laser 11.5", "wheels 12"}));
  SourceOptions options;
  options.clock_offsets["laser"] = -1.25;
  const auto corrected = openLogs({path_}, options);
  EXPECT_EQ(listing(readAll(*corrected)),
            (Strings{"laser 9.25", "wheels 10", "laser 10.25", "wheels 11", "wheels 12"}));
  EXPECT_EQ(corrected->report().objects, log->report().objects) << "objects that are read twice count once";
  EXPECT_EQ(corrected->report().bytes, log->report().bytes);
  EXPECT_EQ(corrected->report().ending, Ending::complete);
  options.clock_offsets["wheels"] = -1.25;
  EXPECT_EQ(listing(readAll(*openLogs({path_}, options))),
            (Strings{"wheels 8.75", "laser 9.25", "wheels 9.75", "laser 10.25", "wheels 10.75"}));
  options.clock_offsets = {{"laser", 100}, {"other", 3}};
  EXPECT_EQ(listing(readAll(*openLogs({path_}, options))),
            (Strings{"wheels 10", "wheels 11", "wheels 12", "laser 110.5", "laser 111.5"}));
}

}  // namespace
}  // namespace omnimapper::source::rawlog_source_test
