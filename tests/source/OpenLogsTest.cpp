// Logs of formats that only this test knows: a list of labels and times, one line each ("LIST", then "laser 1.5").
#include <omnimapper/base/Error.h>
#include <omnimapper/source/SourceFactory.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

#include <csignal>
#include <sstream>

namespace omnimapper::source::open_logs_test {
namespace {

using namespace logs;
using Strings = std::vector<std::string>;

struct ListOptions {
  std::string prefix;
  static const base::OptionTable<ListOptions>& table() {
    static const auto table =
        base::OptionTable<ListOptions>().text("prefix", &ListOptions::prefix, "Beginning of all labels.");
    return table;
  }
};

/// The label "crash" ends the process, and "error" throws; "bad" is a scan that no gate lets pass.
class ListLog : public ObservationSource {
 public:
  static constexpr const char* kName = "list_log";
  static constexpr const char* kSummary = "a list for a test";
  static bool recognizes(const LogLook& look) { return look.headBeginsWith("LIST"); }

  explicit ListLog(const std::string& path, const ListOptions& options = {}) : prefix_(options.prefix) {
    lines_.str(readFile(path));
    std::string first;
    lines_ >> first;
    if (first == "LISTbroken") throw base::Error(base::ExitCode::unreadable_input, path + ": is broken");
    if (first == "LISTcrash") std::raise(SIGKILL);
  }
  CObservation::Ptr next() override {
    std::string label;
    double seconds = 0;
    if (!(lines_ >> label >> seconds)) {
      report_.ending = SourceReport::Ending::complete;
      report_.notes = {"the list has ended"};
      return nullptr;
    }
    if (label == "crash") std::raise(SIGKILL);
    if (label == "error") throw std::runtime_error("a line was torn out");
    ++report_.objects;
    auto observation = scan(seconds, prefix_ + label);
    if (label == "bad") dynamic_cast<mrpt::obs::CObservation2DRangeScan&>(*observation).aperture = std::nanf("");
    report_.count(observation->sensorLabel, "scan", observation->timestamp);
    return observation;
  }
  double progress() const override { return 0.5; }
  SourceReport report() const override { return report_; }
  TruePoses truth() const override { return {{at(1), {}}}; }
  std::optional<geometry::Se3> truthAt(base::Stamp) const override { return geometry::Se3(); }

 private:
  std::string prefix_;
  std::istringstream lines_;
  SourceReport report_;
};

/// Recognizes lists that begin so, too.
class TwinLog : public ListLog {
 public:
  static constexpr const char* kName = "twin_log";
  static bool recognizes(const LogLook& look) { return look.headBeginsWith("LISTtwin"); }
  using ListLog::ListLog;
};

class OpenLogsTest : public ::testing::Test {
 protected:
  OpenLogsTest() {
    SourceOf<ListLog, ListOptions>::registerClass();
    SourceOf<TwinLog, ListOptions>::registerClass();
  }
  std::string write(const std::string& name, const std::string& text) { return writePlain(folder_ / name, text); }
  static Strings read(const std::vector<std::string>& paths, const SourceOptions& options = {}) {
    return listing(readAll(*openLogs(paths, options)));
  }
  static base::Error failure(const std::vector<std::string>& paths, const SourceOptions& options = {}) {
    try {
      openLogs(paths, options);
    } catch (const base::Error& error) {
      return error;
    }
    ADD_FAILURE() << "no error";
    return base::Error(base::ExitCode::ok, "");
  }
  static bool says(const base::Error& error, const std::string& text) {
    const bool is_said = std::string(error.what()).find(text) != std::string::npos;
    EXPECT_TRUE(is_said) << error.what();
    return is_said;
  }

  testing::ScratchFolder folder_;
};

TEST_F(OpenLogsTest, aRegisteredFormatIsOpenedByWhatItLooksLike) {
  const auto log = openLogs({write("x", "LIST\nlaser 1\nlaser 2\n")}, {});
  EXPECT_EQ(listing(readAll(*log)), (Strings{"laser 1", "laser 2"}));
  const auto report = log->report();
  EXPECT_EQ(report.ending, SourceReport::Ending::complete);
  EXPECT_EQ(report.observations(), 2U);
  EXPECT_EQ(report.objects, 2U);
  EXPECT_EQ(report.notes, Strings{"the list has ended"});
  EXPECT_NE(report.text().find("the list has ended"), std::string::npos);
  EXPECT_EQ(log->truth().size(), 1U);
  EXPECT_TRUE(log->truthAt(at(1)));
}

TEST_F(OpenLogsTest, itsOptionsAreReadFromTheSectionOfTheFormat) {
  const auto config = base::Config::fromText("[source_list_log]\nprefix = my_\n", "x.ini");
  EXPECT_EQ(read({write("x", "LIST\nlaser 1\n")}, readSourceOptions(config)), Strings{"my_laser 1"});
  config.refuseUnreadSections();
  EXPECT_THROW(readSourceOptions(base::Config::fromText("[source_list_log]\nperfix = my_\n", "x.ini")), base::Error);
}

TEST_F(OpenLogsTest, aLogOfAnyFormatIsMergedAndSelectedAsARawlogIs) {
  const auto list = write("x", "LIST\nlaser 1\ncamera 2\nlaser 3\nlaser 9\n");
  const auto rawlog = write("x.rawlog", (Bytes() << odometry(0.5) << odometry(2.5)).string());
  EXPECT_EQ(read({list, rawlog}), (Strings{"wheels 0.5", "laser 1", "camera 2", "wheels 2.5", "laser 3", "laser 9"}));
  SourceOptions options;
  options.labels = {"laser", "wheels"};
  options.start = 0.4;  // after the first stamp of both, which is 0.5
  options.end = 4;
  EXPECT_EQ(read({list, rawlog}, options), (Strings{"laser 1", "wheels 2.5", "laser 3"}));
  options.start = options.end = 0;
  options.clock_offsets = {{"laser", 0.25}};
  EXPECT_EQ(read({list, rawlog}, options),
            (Strings{"wheels 0.5", "laser 1.25", "wheels 2.5", "laser 3.25", "laser 9.25"}));
  EXPECT_EQ(openLogs({list}, options)->report().objects, 1U) << "each object is counted once, however often it is read";
}

TEST_F(OpenLogsTest, aReaderThatCrashesEndsTheLogAndNotTheProgram) {
  const auto path = write("x", "LIST\nlaser 1\nlaser 2\ncrash 3\nlaser 4\n");
  const auto log = openLogs({path}, {});
  EXPECT_EQ(listing(readAll(*log)), (Strings{"laser 1", "laser 2"}));
  EXPECT_EQ(log->report().ending, SourceReport::Ending::corrupt);
  EXPECT_EQ(log->report().exitCode(), base::ExitCode::damaged_input);
  EXPECT_NE(log->report().message.find(path + ": is corrupt"), std::string::npos);
  EXPECT_NE(log->report().message.find("after 2 observations"), std::string::npos);
  says(failure({write("y", "LISTcrash\n")}), "cannot be opened: its reader crashes");
}

TEST_F(OpenLogsTest, anErrorOfAReaderIsPassedOn) {
  const auto log = openLogs({write("x", "LIST\nlaser 1\nerror 2\n")}, {});
  EXPECT_EQ(listing(readAll(*log)), Strings{"laser 1"});
  EXPECT_EQ(log->report().ending, SourceReport::Ending::corrupt);
  EXPECT_NE(log->report().message.find("a line was torn out"), std::string::npos) << log->report().message;
  says(failure({write("y", "LISTbroken\n")}), "is broken");
}

TEST_F(OpenLogsTest, whatCannotBeUsedIsLeftOutAndLabelsCannotForgeLines) {
  const auto log = openLogs({write("x", "LIST\nlaser 1\nbad 2\nla\033[2Jser 3\n")}, {});
  const auto all = readAll(*log);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1]->sensorLabel.find('\033'), std::string::npos);
  EXPECT_EQ(log->report().unusableCount(), 1U);
}

TEST_F(OpenLogsTest, twoFormatsThatRecognizeALogAreAnErrorThatTheIniSettles) {
  const auto path = write("x", "LISTtwin\nlaser 1\n");
  const auto error = failure({path});
  EXPECT_EQ(error.code(), base::ExitCode::command_line);
  says(error, path) && says(error, "list_log, twin_log") && says(error, "[source] formats = list_log");
  const auto options = readSourceOptions(base::Config::fromText("[source]\nformats = rawlog, twin_log\n", "x.ini"));
  EXPECT_EQ(read({path}, options), Strings{"laser 1"});
  EXPECT_EQ(listing(readAll(*openLogAs("list_log", path, {}))), Strings{"laser 1"});
}

TEST_F(OpenLogsTest, whatNoFormatRecognizesIsAnErrorThatListsThem) {
  const auto error = failure({write("x", "Dear diary,\n")});
  EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
  says(error, "text file of unknown kind") && says(error, "rawlog") && says(error, "list_log");
  says(failure({folder_.path()}), "twin_log");
  SourceOptions options;
  options.formats = {"twin_log"};
  says(failure({write("x", "LIST\nlaser 1\n")}, options), "[source] formats allows only twin_log");
  says(failure({write("y", "Dear diary,\n")}, options), "text file of unknown kind");
}

TEST_F(OpenLogsTest, aFileOfAnotherKindThanItsNameAndACompressedOneAreNamed) {
  says(failure({write("x.bag", "Not found\n")}), "is named .bag, but does not begin as such a log of ROS does");
  says(failure({write("x.bag.xz", std::string("\xfd\x37zXZ\0\0\x04\xe6", 9))}), "unpack it first: xz -dk");
  says(failure({write("x.rawlog.zst", "\x28\xb5\x2f\xfd and so on")}), "unpack it first: zstd -d");
}

TEST_F(OpenLogsTest, ofAFolderOfLogsAllAreNamed) {
  for (const char* name : {"a.bag", "b.bag"}) write(name, "x");
  says(failure({folder_.path()}), "name one of the logs in it: " + (folder_ / "a.bag") + ", " + (folder_ / "b.bag"));
}

TEST_F(OpenLogsTest, aFormatThatIsNotKnownIsNamed) {
  try {
    readSourceOptions(base::Config::fromText("[source]\nformats = list_lgo\n", "x.ini"));
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unknown_plugin);
    says(error, "x.ini:2") && says(error, "did you mean 'list_log'?");
  }
  EXPECT_THROW(openLogAs("none", write("x", "LIST\n"), {}), base::Error);
}

TEST_F(OpenLogsTest, theFolderOfAMapIsNoLogWhateverIsInIt) {
  for (const char* name : {"map.omnimap", "points.pcd", "map.png"}) write(name, "x");
  says(failure({folder_.path()}), "is the folder of a map, no log");
}

TEST_F(OpenLogsTest, openingStopsWhenItIsToldTo) {
  try {
    openLogs({write("x", "LIST\nlaser 1\n")}, {}, [] { return true; });
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::interrupted);
  }
}

}  // namespace
}  // namespace omnimapper::source::open_logs_test
