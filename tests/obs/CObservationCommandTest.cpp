#include <gtest/gtest.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Error.h>

#include <sstream>

#include "FilledObjects.h"

namespace omnimapper::obs::command_test {
namespace {

TEST(CObservationCommand, isBornWithoutStampAndAsksForNothing) {
  const CObservationCommand command;
  EXPECT_FALSE(base::isValid(command.timestamp));
  EXPECT_EQ(command.kind, CommandKind::standby);
  EXPECT_EQ(command.subject, CommandSubject::any);
  EXPECT_EQ(command.expiry, 0);
}

TEST(CObservationCommand, everyKindAndSubjectIsFoundByItsName) {
  for (int i = 0; i < 9; ++i) {
    const auto kind = static_cast<CommandKind>(i);
    EXPECT_EQ(commandKind(nameOf(kind)), kind) << nameOf(kind);
  }
  for (int i = 0; i < 4; ++i) {
    const auto subject = static_cast<CommandSubject>(i);
    EXPECT_EQ(commandSubject(nameOf(subject)), subject) << nameOf(subject);
  }
  EXPECT_EQ(nameOf(CommandKind::go_to), "go_to");
  EXPECT_EQ(nameOf(static_cast<CommandKind>(9)), "unknown");
  EXPECT_FALSE(commandKind("unknown"));
  EXPECT_FALSE(commandKind(""));
  EXPECT_FALSE(commandSubject("Map"));
}

TEST(CObservationCommand, exportsOneFieldEach) {
  EXPECT_EQ(filledCommand()->exportTxtDataRow(),
            "label object K\xC3\xBC"
            "chen%20tisch anna 30 0.5 -0.33333333333333331 0.10000000000000001");
  std::istringstream header(filledCommand()->exportTxtHeader());
  int fields = 0;
  for (std::string name; header >> name;) ++fields;
  EXPECT_EQ(fields, 8);
}

TEST(CObservationCommand, aTextMovesNoCursorAndBreaksNoRow) {
  auto command = *filledCommand();
  command.text = std::string("\x1b[2J\n\0", 6) + std::string(1 << 20, 'x');
  EXPECT_EQ(command.asString().find('\x1b'), std::string::npos);
  EXPECT_EQ(command.exportTxtDataRow().find('\n'), std::string::npos);
}

TEST(CObservationCommand, describesWhatAPersonWantsToKnow) {
  const std::string text = filledCommand()->asString();
  for (const char* part : {"label \"K\\u00fcchen tisch\", for object", "Asked by \"anna\"", "Valid for 30 s"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

TEST(CObservationCommand, isAtNoPlaceAndDrawsNothing) {
  auto command = *filledCommand();
  mrpt::opengl::CSetOfObjects scene;
  command.getVisualizationInto(scene);
  EXPECT_TRUE(scene.empty());
  EXPECT_THROW(command.setSensorPose(mrpt::poses::CPose3D(1, 0, 0)), base::Error);
  EXPECT_NO_THROW(command.setSensorPose(mrpt::poses::CPose3D()));
}

}  // namespace
}  // namespace omnimapper::obs::command_test
