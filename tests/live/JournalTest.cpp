#include <gtest/gtest.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/Journal.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>
#include <optional>

namespace omnimapper::live::journal_test {
namespace {

using Kind = JournalEvent::Kind;

const std::vector<JournalEvent> kEvents{
    {Kind::add, 0}, {Kind::drop, 1}, {Kind::add, 2}, {Kind::bundle, 0}, {Kind::job, 0}};

void write(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

TEST(Journal, readsWhatWasWritten) {
  const testing::ScratchFolder folder;
  JournalWriter writer(folder / "log.journal");
  for (const auto& event : kEvents) writer.add(event);
  EXPECT_TRUE(writer.flush());
  write(folder / "log.rawlog", "");
  write(folder / "log_001.rawlog", "");
  write(folder / "log_003.rawlog", "");
  const auto journal = Journal::read(folder / "log.journal");
  EXPECT_EQ(journal.events, kEvents);
  EXPECT_EQ(journal.rawlogs, (std::vector<std::string>{folder / "log.rawlog", folder / "log_001.rawlog"}));
}

TEST(Journal, aLineThatWasCutByAKillIsLeftOut) {
  const testing::ScratchFolder folder;
  write(folder / "log.rawlog", "");
  write(folder / "log.journal", "omnimapper journal 1\na 0\nb\na 1");
  EXPECT_EQ(Journal::read(folder / "log.journal").events,
            (std::vector<JournalEvent>{{Kind::add, 0}, {Kind::bundle, 0}}));
}

TEST(Journal, refusesWhatIsNone) {
  const testing::ScratchFolder folder;
  write(folder / "log.rawlog", "");
  const auto problemOf = [&](const std::string& text) -> std::string {
    write(folder / "log.journal", text);
    try {
      Journal::read(folder / "log.journal");
    } catch (const base::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(problemOf("").find("not a journal"), std::string::npos);
  EXPECT_NE(problemOf("omnimapper journal 2\n").find("not a journal"), std::string::npos);
  for (const char* line : {"x", "a", "a ", "a -1", "a 1 2", "b 1", "a 99999999999999999999"})
    EXPECT_NE(problemOf("omnimapper journal 1\na 0\n" + std::string(line) + "\n").find("line 3"), std::string::npos)
        << line;
  EXPECT_THROW(Journal::read(folder / "other.journal"), base::Error);
  EXPECT_THROW(Journal::read(folder / "log.rawlog"), base::Error);
  write(folder / "alone.journal", "omnimapper journal 1\n");
  EXPECT_THROW(Journal::read(folder / "alone.journal"), base::Error);
}

TEST(Journal, isFoundInTheFolderOfARun) {
  const testing::ScratchFolder folder;
  const std::string run = folder / "run";
  std::filesystem::create_directories(run + "/recording");
  EXPECT_EQ(findJournal(run + "/any.journal"), run + "/any.journal") << "a file is taken as it is";
  EXPECT_THROW(findJournal(run), base::Error) << "there is no journal";
  write(run + "/recording/one.journal", "");
  EXPECT_EQ(findJournal(run), run + "/recording/one.journal");
  EXPECT_EQ(findJournal(run + "/recording"), run + "/recording/one.journal");
  EXPECT_EQ(iniOf(findJournal(run)), run + "/recording/one.ini");
  write(run + "/recording/two.journal", "");
  try {
    findJournal(run);
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("recording/one.journal or " + run + "/recording/two.journal"),
              std::string::npos)
        << error.what();
  }
}

// Another INI would be trusted with plugin libraries, and a recording may come from anybody.
TEST(FindIni, takesTheIniOfALiveRunAlone) {
  const testing::ScratchFolder folder;
  const std::string journal = folder / "log.journal";
  EXPECT_EQ(findIni(journal), std::nullopt);
  write(folder / "log.ini", base::kWrittenFromALog + ": how it was mapped.\n[trigger]\ndistance_m = 0.2\n");
  EXPECT_EQ(findIni(journal), std::optional<std::string>(folder / "log.ini"));
  for (const char* text : {"", "[mapper]\nplugin_libraries = theirs.so\n", "; Written"}) {
    write(folder / "log.ini", text);
    EXPECT_THROW(findIni(journal), base::Error) << text;
  }
}

}  // namespace
}  // namespace omnimapper::live::journal_test
