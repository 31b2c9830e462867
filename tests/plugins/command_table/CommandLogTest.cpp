#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>

#include "command_table/CommandLog.h"

namespace omnimapper::source::command_log_test {
namespace {

class CommandLogOf : public ::testing::Test {
 protected:
  std::vector<obs::CObservationCommand> read(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    CommandLog log(path_);
    std::vector<obs::CObservationCommand> commands;
    while (const auto command = log.next()) commands.push_back(dynamic_cast<const obs::CObservationCommand&>(*command));
    EXPECT_EQ(log.report().ending, SourceReport::Ending::complete);
    EXPECT_EQ(log.report().observations(), commands.size());
    return commands;
  }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const base::Error& error) {
      return error.what();
    }
    return "taken";
  }
  void expectRefused(const std::string& text, const std::string& why) const {
    EXPECT_NE(refusal(text).find(why), std::string::npos) << refusal(text);
  }
  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "tour.csv";
};

TEST_F(CommandLogOf, isReadInTheOrderOfItsStamps) {
  const auto commands = read(
      "stamp_s,kind,text,subject,origin,expiry_s,turn_deg\n"
      "1600000012.5000001,label,\"table, kitchen\",map,anna,20,\n"
      "1600000003,move,,,,,90\n");
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commands[0].kind, obs::CommandKind::move);
  EXPECT_NEAR(commands[0].motion.z(), 1.5707963267948966, 1e-15);
  EXPECT_EQ(commands[1].text, "table, kitchen");
  EXPECT_EQ(commands[1].subject, obs::CommandSubject::map);
  EXPECT_EQ(commands[1].origin, "anna");
  EXPECT_EQ(commands[1].expiry, 20);
  EXPECT_EQ(commands[1].sensorLabel, "commands");
  EXPECT_EQ(base::formatUnix(commands[1].timestamp), "1600000012.5000001");
}

TEST_F(CommandLogOf, refusesWhatIsNoCommandAndNamesTheLine) {
  const std::string head = "stamp_s,kind,text,subject\n";
  expectRefused(head, "has no row");
  expectRefused("kind,text\nstop,\n", "stamp_s");
  expectRefused(head + "1600000000,stop,,\n1600000001,sit,,\n", ":3");
  expectRefused(head + "1600000000,sit,,\n", "there is no command 'sit': it is label, go_to");
  expectRefused(head + "1600000000,label,cup,thing\n", "there is no subject 'thing'");
  expectRefused(head + "1600000000,label,,object\n", "a command label needs a text");
  expectRefused(head + "nan,stop,,\n", "no Unix time");
  expectRefused(head + "3,stop,,\n", "taken");
  expectRefused("stamp_s,kind,expiry_s\n1600000000,stop,-1\n", "expiry_s is below 0");
  expectRefused("stamp_s,kind,forward_m\n1600000000,move,inf\n", "forward_m");
}

TEST_F(CommandLogOf, isRecognizedByItsColumns) {
  LogLook look;
  look.head = "kind,text,stamp_s\r\nstop,,1600000000\r\n";
  EXPECT_TRUE(CommandLog::recognizes(look));
  look.head = "stamp_s,kind\n";
  EXPECT_TRUE(CommandLog::recognizes(look));
  look.head = "stamp_s,x_m\nkind,stamp_s\n";
  EXPECT_FALSE(CommandLog::recognizes(look));
  look.is_folder = true;
  EXPECT_FALSE(CommandLog::recognizes(look));
}

TEST_F(CommandLogOf, isOpenedAsALogAmongOthers) {
  std::ofstream(path_, std::ios::binary) << "stamp_s,kind,text\n1600000000,label,cup\n";
  const auto log = openLogs({path_}, {});
  const auto first = log->next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sensorLabel, "commands");
  EXPECT_FALSE(log->next());
}

}  // namespace
}  // namespace omnimapper::source::command_log_test
