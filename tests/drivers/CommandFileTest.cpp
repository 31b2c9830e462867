#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <omnimapper/drivers/CCommandFile.h>
#include <omnimapper/live/HostClock.h>
#include <omnimapper/live/SensorDriver.h>
#include <omnimapper/obs/CommandTable.h>
#include <omnimapper/testing/Fixtures.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace omnimapper::drivers::command_file_test {
namespace {

class CommandFileTest : public ::testing::Test {
 protected:
  CommandFileTest() {
    mrpt::config::CConfigFileMemory ini;
    ini.setContent("[page]\nsensorLabel = page\nfile = " + file_ + "\n");
    sensor_.loadConfig(ini, "page");
  }
  void append(const std::string& bytes) { std::ofstream(file_, std::ios::binary | std::ios::app) << bytes; }
  static std::string row(double age, const std::string& kind, const std::string& text, double expiry = 0) {
    obs::CObservationCommand command;
    command.timestamp = live::hostNow() - base::durationFromSeconds(age);
    command.kind = *obs::commandKind(kind);
    command.text = text;
    command.expiry = expiry;
    return obs::commandRow(command) + "\n";
  }
  std::vector<std::string> texts() {
    sensor_.doProcess();
    std::vector<std::string> texts;
    for (const auto& [stamp, object] : sensor_.getObservations()) {
      const auto command = std::dynamic_pointer_cast<obs::CObservationCommand>(object);
      EXPECT_TRUE(command);
      EXPECT_EQ(command->sensorLabel, "page");
      texts.push_back(command->text);
    }
    return texts;
  }
  using Texts = std::vector<std::string>;

  testing::ScratchFolder folder_;
  const std::string file_ = folder_ / "commands.csv", columns_ = std::string(obs::kCommandColumns) + "\n";
  CCommandFile sensor_;
};

TEST_F(CommandFileTest, WhatIsAppendedIsGivenOnceAndInOrder) {
  sensor_.initialize();
  EXPECT_EQ(texts(), Texts{}) << "the file may come later";
  append(columns_ + row(0.3, "go_to", "kitchen, the \"big\" one") + row(0.2, "edit", "undo"));
  EXPECT_EQ(texts(), (Texts{"kitchen, the \"big\" one", "undo"}));
  EXPECT_EQ(texts(), Texts{});
  const std::string next = row(0.1, "edit", "delete x");
  append(next.substr(0, 20));
  EXPECT_EQ(texts(), Texts{}) << "a line without an end is not read";
  append(next.substr(20));
  EXPECT_EQ(texts(), Texts{"delete x"});
  EXPECT_EQ(sensor_.leftOut(), 0U);
}

TEST_F(CommandFileTest, CommandsOfAnEarlierRunAreNotGiven) {
  append(columns_ + row(1, "go_to", "old"));
  sensor_.initialize();
  append(row(0, "go_to", "new"));
  EXPECT_EQ(texts(), Texts{"new"});
}

TEST_F(CommandFileTest, WhatExpiredOrIsRepeatedOrIsNoCommandIsRejected) {
  sensor_.initialize();
  const std::string good = row(0.5, "go_to", "kitchen", 60);
  append(columns_ + row(3, "go_to", "too late", 2) + row(100, "go_to", "of another clock") + good + good +
         "1,burn,x\nno command\n" + std::string(5000, 'x') + "\n" + row(0.1, "stop", ""));
  EXPECT_EQ(texts(), (Texts{"kitchen", ""}));
  EXPECT_EQ(sensor_.leftOut(), 6U);
  for (const char* reason : {"1 that expired", "1 whose stamp", "1 not later", "2 that are no commands", "1 of more"})
    EXPECT_NE(sensor_.leftOutByReason().find(reason), std::string::npos) << sensor_.leftOutByReason();
}

TEST_F(CommandFileTest, AStopIsGivenWhateverTheClocksSay) {
  sensor_.initialize();
  const base::Stamp before = live::hostNow();
  append(columns_ + row(-5, "go_to", "kitchen") + row(100, "stop", "read late") +
         row(-3600, "stop", "of another clock") + row(3, "stop", "expired", 2) + row(0, "stop", "before the goal") +
         row(0, "go_to", "before the goal"));
  sensor_.doProcess();
  int stops = 0;
  for (const auto& [stamp, object] : sensor_.getObservations()) {
    const auto command = std::dynamic_pointer_cast<obs::CObservationCommand>(object);
    ASSERT_TRUE(command);
    if (command->kind != obs::CommandKind::stop) continue;
    ++stops;
    EXPECT_TRUE(before <= command->timestamp && command->timestamp <= live::hostNow()) << command->text;
  }
  EXPECT_EQ(stops, 4);
  EXPECT_EQ(sensor_.leftOut(), 1U) << "a goal is rejected: " << sensor_.leftOutByReason();
}

/// While it exists, this process has the rights of a user who is not root.
class WithoutRoot {
 public:
  WithoutRoot() { set(65534); }
  ~WithoutRoot() { set(0); }
  WithoutRoot(const WithoutRoot&) = delete;
  WithoutRoot& operator=(const WithoutRoot&) = delete;

 private:
  void set(uid_t user) const {
    if (!is_root_) return;
    EXPECT_EQ(::seteuid(user), 0);
  }
  const bool is_root_ = ::geteuid() == 0;
};

TEST_F(CommandFileTest, AFileThatCannotBeOpenedIsReported) {
  sensor_.initialize();
  append(columns_ + row(0, "stop", ""));
  std::filesystem::permissions(file_, std::filesystem::perms::none);
  const WithoutRoot user;
  for (const bool begins : {false, true}) {
    try {
      begins ? sensor_.initialize() : sensor_.doProcess();
      ADD_FAILURE() << "it was read";
    } catch (const base::Error& error) {
      EXPECT_NE(std::string(error.what()).find("another user"), std::string::npos) << error.what();
    }
  }
}

TEST_F(CommandFileTest, AFileThatIsReplacedIsReadFromItsBeginning) {
  append(columns_ + row(2, "go_to", "a long text that makes the first file long"));
  sensor_.initialize();
  std::ofstream(file_, std::ios::binary) << columns_ << row(0, "stop", "");
  EXPECT_EQ(texts(), Texts{""});
}

TEST_F(CommandFileTest, ItIsADriverThatAnIniMayName) {
  const auto ini = std::make_shared<mrpt::config::CConfigFileMemory>();
  ini->setContent("[page]\ndriver = CCommandFile\nfile = " + file_ + "\n");
  live::SensorSection section;
  section.name = "page";
  section.driver = "CCommandFile";
  section.ini = ini;
  EXPECT_EQ(live::makeDriver(section)->label(), "commands");
  const auto without_file = std::make_shared<mrpt::config::CConfigFileMemory>();
  without_file->setContent("[page]\ndriver = CCommandFile\n");
  section.ini = without_file;
  EXPECT_THROW(live::makeDriver(section), base::Error) << "a file must be named";
}

}  // namespace
}  // namespace omnimapper::drivers::command_file_test
