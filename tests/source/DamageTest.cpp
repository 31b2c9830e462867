#include <mrpt/maps/CSimplePointsMap.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <filesystem>

namespace omnimapper::source::damage_test {
namespace {

using namespace logs;
using Ending = SourceReport::Ending;

constexpr int kFlips = testing::kIsSanitized ? 15 : 100;
constexpr std::size_t kStep = testing::kIsSanitized ? 61 : 6;  // bytes between the places of truncation

// Both of MRPT's formats in one log, with every kind of object.
std::string smallLog() {
  return Bytes().action(1, 2, 0.1).frame({scan(1), scan(1.1, "rear")}).action(0.5, 0, 0).frame({scan(2)}).string() +
         (Bytes() << odometry(2.5) << scan(3) << odometry(3.5)).string();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos);
  return text.replace(place, from.size(), to);
}

class DamageTest : public ::testing::Test {
 protected:
  // Result of reading a file; the constructor may refuse one that is damaged before its first object.
  struct Outcome {
    bool refused = false;
    std::vector<std::string> listing;
    SourceReport report;
  };
  Outcome read(const std::string& bytes) {
    Outcome outcome;
    writePlain(path_, bytes);
    std::unique_ptr<RawlogSource> source;
    try {
      source = std::make_unique<RawlogSource>(path_);
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      outcome.refused = true;
      return outcome;
    }
    EXPECT_NO_THROW(outcome.listing = listing(readAll(*source)));
    outcome.report = source->report();
    return outcome;
  }
  std::string gzipped(const std::string& bytes) { return readFile(writeGzip(folder_ / "whole", bytes)); }
  std::string refusal(const std::string& path) {
    try {
      RawlogSource source(path);
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      return error.what();
    }
    ADD_FAILURE() << path << " was taken for a rawlog";
    return "";
  }

  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "x.rawlog";
};

bool isPrefix(const std::vector<std::string>& part, const std::vector<std::string>& whole) {
  return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

TEST_F(DamageTest, truncatedPlainLogGivesWhatWasWholeAndSaysWhereItEnds) {
  const std::string log = smallLog();
  const auto whole = read(log).listing;
  ASSERT_EQ(whole.size(), 7u);
  std::size_t complete = 0;
  for (std::size_t length = 1; length < log.size(); length += kStep) {
    SCOPED_TRACE(length);
    const auto outcome = read(log.substr(0, length));
    if (outcome.refused) {
      EXPECT_LT(length, 40u) << "only a cut through the first header leaves no rawlog";
      continue;
    }
    EXPECT_TRUE(isPrefix(outcome.listing, whole));
    EXPECT_LE(outcome.report.bytes, length);
    if (outcome.report.ending == Ending::complete) {
      ++complete;  // cut between two objects, which no reader can detect
      EXPECT_EQ(outcome.report.bytes, length);
      continue;
    }
    EXPECT_EQ(outcome.report.ending, Ending::truncated);
    EXPECT_EQ(outcome.report.exitCode(), base::ExitCode::damaged_input);
    EXPECT_NE(outcome.report.message.find("truncated"), std::string::npos) << outcome.report.message;
    EXPECT_NE(outcome.report.message.find(path_), std::string::npos) << outcome.report.message;
  }
  EXPECT_LE(complete, 7u);
}

TEST_F(DamageTest, truncatedGzipIsDetectedAtEveryByte) {
  const auto whole = read(smallLog()).listing;
  const std::string gzip = gzipped(smallLog());
  bool some_were_read = false;
  for (std::size_t length = 2; length < gzip.size(); length += kStep) {
    SCOPED_TRACE(length);
    const auto outcome = read(gzip.substr(0, length));
    if (outcome.refused) continue;
    EXPECT_TRUE(isPrefix(outcome.listing, whole));
    EXPECT_EQ(outcome.report.ending, Ending::truncated);
    some_were_read |= !outcome.listing.empty();
  }
  EXPECT_TRUE(some_were_read);
  // The last byte belongs to the length that gzip stores after the checksum: all objects are there.
  const auto outcome = read(gzip.substr(0, gzip.size() - 1));
  EXPECT_EQ(outcome.listing, whole);
  EXPECT_EQ(outcome.report.ending, Ending::truncated);
}

TEST_F(DamageTest, flippedBytesOfAPlainLogNeverCrashAndNeverThrow) {
  const std::string log = smallLog();
  testing::Dice dice(3);
  std::map<Ending, int> endings;
  for (int i = 0; i < kFlips; ++i) {
    std::string damaged = log;
    const auto place = static_cast<std::size_t>(dice.uniform(0, static_cast<double>(log.size())));
    damaged[place] = static_cast<char>(damaged[place] ^ (i % 2 == 0 ? 0xff : 1 << (i / 2 % 8)));
    SCOPED_TRACE("byte " + std::to_string(place));
    const auto outcome = read(damaged);
    if (outcome.refused) continue;
    ++endings[outcome.report.ending];
    EXPECT_NE(outcome.report.ending, Ending::open);
    EXPECT_EQ(outcome.report.message.empty(), outcome.report.ending == Ending::complete);
  }
  EXPECT_GT(endings[Ending::corrupt] + endings[Ending::truncated], 0);
  EXPECT_GT(endings[Ending::complete], 0) << "a changed range is a range";
}

TEST_F(DamageTest, flippedBytesOfAGzipLogAreNeverTakenForGood) {
  const std::string log = smallLog(), gzip = gzipped(log);
  const auto whole = read(log).listing;
  testing::Dice dice(4);
  for (int i = 0; i < kFlips; ++i) {
    std::string damaged = gzip;
    // After gzip's header of 10 bytes, whose time and system have no effect.
    const auto place = static_cast<std::size_t>(dice.uniform(10, static_cast<double>(gzip.size())));
    damaged[place] = static_cast<char>(damaged[place] ^ (i % 2 == 0 ? 0xff : 1 << (i / 2 % 8)));
    SCOPED_TRACE("byte " + std::to_string(place));
    const auto outcome = read(damaged);
    if (outcome.refused) continue;
    EXPECT_GT(outcome.report.ending, Ending::complete);
    EXPECT_FALSE(outcome.report.message.empty());
  }
}

// A count of four billion particles inside an action: MRPT would draw them all.
TEST_F(DamageTest, corruptCountThatMrptWouldFollowEndsTheStreamInstead) {
  if (testing::kIsSanitized) GTEST_SKIP() << "the memory of the child process cannot be limited under a sanitizer";
  auto movement = logs::movement(1, 0, 0);
  movement.motionModelConfiguration.modelSelection = mrpt::obs::CActionRobotMovement2D::mmThrun;
  movement.motionModelConfiguration.thrunModel.nParticlesCount = 0xfffffff0u;
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  const auto outcome = read(Bytes().frame({scan(1)}).string() + (Bytes() << actions).string());
  EXPECT_FALSE(outcome.refused);
  EXPECT_EQ(outcome.listing, (std::vector<std::string>{"laser 1"}));
  EXPECT_EQ(outcome.report.ending, Ending::corrupt);
  EXPECT_EQ(outcome.report.objects, 1u);
}

TEST_F(DamageTest, otherBytesAfterTheGzipDataAreReportedAndTheLogIsKept) {
  const auto outcome = read(gzipped(smallLog()) + "garbage");
  EXPECT_EQ(outcome.listing.size(), 7u);
  EXPECT_EQ(outcome.report.ending, Ending::corrupt);
}

TEST_F(DamageTest, unregisteredClassIsNamedAndWhatCameBeforeItIsKept) {
  const std::string known = "mrpt::obs::CObservationOdometry", unknown = "mrpt::obs::CObservationTelepath";
  ASSERT_EQ(known.size(), unknown.size());
  const std::string log = (Bytes() << scan(1)).string() + replaced((Bytes() << odometry(2)).string(), known, unknown) +
                          (Bytes() << scan(3)).string();
  for (const auto& bytes : {log, gzipped(log)}) {
    const auto outcome = read(bytes);
    EXPECT_EQ(outcome.listing, (std::vector<std::string>{"laser 1"}));
    EXPECT_EQ(outcome.report.ending, Ending::unregistered_class);
    EXPECT_EQ(outcome.report.unregistered_class, unknown);
    EXPECT_EQ(outcome.report.exitCode(), base::ExitCode::unregistered_class);
    EXPECT_NE(outcome.report.message.find(unknown), std::string::npos);
  }
}

TEST_F(DamageTest, unregisteredClassInsideAFrameIsNamedToo) {
  const std::string known = "mrpt::obs::CObservationOdometry", unknown = "mrpt::obs::CObservationTelepath";
  const auto outcome =
      read((Bytes() << scan(1)).string() + replaced(Bytes().frame({scan(2), odometry(2)}).string(), known, unknown));
  EXPECT_EQ(outcome.listing, (std::vector<std::string>{"laser 1"}));
  EXPECT_EQ(outcome.report.unregistered_class, unknown);
}

TEST_F(DamageTest, unregisteredClassAtTheVeryBeginningIsReportedToo) {
  const auto outcome = read(replaced((Bytes() << odometry(2)).string(), "mrpt::obs::CObservationOdometry",
                                     "mrpt::obs::CObservationTelepath"));
  EXPECT_FALSE(outcome.refused);
  EXPECT_EQ(outcome.report.ending, Ending::unregistered_class);
}

TEST_F(DamageTest, whatIsNoRawlogIsRefusedWithARemedy) {
  const auto says = [&](const std::string& bytes, const std::string& expected) {
    const auto message = refusal(writePlain(path_, bytes));
    EXPECT_NE(message.find(expected), std::string::npos) << message;
    EXPECT_NE(message.find(path_), std::string::npos) << message;
  };
  says("", "is empty");
  says("Dear diary,\ntoday\n", "is a text file");
  says("\x89PNG\r\n\x1a\n" + std::string(100, '\1'), "is an image");
  says(std::string("PK\x03\x04") + std::string(100, '\1'), "ZIP");
  says(std::string(1000, '\xee'), "no log of a format that is known");
  says("# .PCD v0.7\nVERSION 0.7\n", "is a PCD cloud, no log; name the folder");
  says("OMNIMAP\n\1", "use it with --continue or --localize");
  says("\x1f\x8b and no more gzip than that", "decompress");
  says((Bytes() << mrpt::maps::CSimplePointsMap()).string(), "mrpt::maps::CSimplePointsMap");
  EXPECT_NE(refusal(folder_ / "nowhere.rawlog").find("No such file"), std::string::npos);
}

TEST_F(DamageTest, aFolderIsRefusedWithWhatItIsFor) {
  const auto says = [&](const std::string& folder, const std::string& file, const std::string& expected) {
    std::filesystem::create_directories(folder_ / folder);
    writePlain(folder_ / folder + "/" + file, "text");
    const auto message = refusal(folder_ / folder);
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  };
  says("nothing", "notes.txt", "is a folder, in which there is nothing that can be read");
  says("map", "map.omnimap", "is the folder of a map, no log");
  says("logs", "b.rawlog", "the log in it is " + (folder_ / "logs/b.rawlog"));
  says("logs", "a.rawlog", "name one of the logs in it: " + (folder_ / "logs/a.rawlog"));
  says("located", "localization.csv", "is the folder of a run with --localize");
}

}  // namespace
}  // namespace omnimapper::source::damage_test
