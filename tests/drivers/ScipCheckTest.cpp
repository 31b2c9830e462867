#include <gtest/gtest.h>
#include <hokuyo/ScipCheck.h>

#include "ScipCodec.h"

namespace omnimapper::drivers::scip_check_test {
namespace {

const std::string kCommand = "MD0000000201000";

std::string scan(const std::string& data = "0Uo0Cl0Mn") {
  return kCommand + "\n" + players::withScipSum("99") + players::withScipSum("0000") + players::scipBlock(data) + "\n";
}

std::string checked(const std::string& bytes, std::uint64_t damaged, std::size_t piece = std::string::npos) {
  ScipCheck check;
  check.setCommand(kCommand + "\n");
  for (std::size_t begin = 0; begin < bytes.size(); begin += std::min(piece, bytes.size()))
    check.add(std::string_view(bytes).substr(begin, piece));
  EXPECT_EQ(check.damaged(), damaged);
  return check.take();
}

// The specification's example of a checksum: C-42-03320B, "Hokuyo" has the checksum 'o'.
TEST(ScipCheck, checksumsAreThoseOfTheSpecification) {
  EXPECT_EQ(players::scipSum("Hokuyo"), 'o');
  EXPECT_EQ(players::encodeScip(5432, 3), "1Dh");
}

TEST(ScipCheck, validMessagesPassWholeInWhateverPieces) {
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::string::npos})
    EXPECT_EQ(checked(scan() + scan("0Uo0Cl0Mm"), 0, piece), scan() + scan("0Uo0Cl0Mm"));
}

TEST(ScipCheck, noAlteredByteOfAMessagePasses) {
  const std::string message = scan(std::string(200, '0') + "0Uo");
  for (std::size_t i = 0; i < message.size(); ++i) {
    std::string altered = message;
    altered[i] = static_cast<char>(altered[i] ^ 1);
    ScipCheck check;
    check.setCommand(kCommand);
    check.add(altered + scan());
    EXPECT_EQ(check.take(), scan()) << "byte " << i;
    // With another echo, a message is the answer to another command.
    EXPECT_EQ(check.damaged(), i < kCommand.size() ? 0u : 1u) << "byte " << i;
  }
}

TEST(ScipCheck, ofAMessageThatWasCutOffTheNextIsValid) {
  const std::string message = scan();
  for (std::size_t size = 1; size + 2 < message.size(); ++size)
    EXPECT_EQ(checked(message.substr(0, size) + message, 1), message) << size;
}

TEST(ScipCheck, answersToOtherCommandsAreLeftOutUncounted) {
  EXPECT_EQ(checked("QT\n" + players::withScipSum("00") + "\n" + scan(), 0), scan());
}

TEST(ScipCheck, informationHasItsChecksumBeforeTheSemicolon) {
  ScipCheck check;
  check.setCommand("PP");
  const std::string message = "PP\n" + players::withScipSum("00") + players::scipInformation("DMIN:20") +
                              players::scipInformation("DMAX:30000") + "\n";
  check.add(message);
  EXPECT_EQ(check.take(), message);
}

// A checksum of six bits is right by chance once in 64 times; the format of the lines reveals most of these cases.
TEST(ScipCheck, bytesThatNoScanHasDoNotPassByChecksumsThatAreRight) {
  const auto withLine = [](const std::string& line) {
    return kCommand + "\n" + players::withScipSum("99") + players::withScipSum("0000") + players::withScipSum(line) +
           players::scipBlock("0Uo") + "\n";
  };
  const std::string whole(64, '0');
  EXPECT_EQ(checked(withLine(whole), 0), withLine(whole));
  EXPECT_EQ(checked(withLine(whole + "0"), 1), "");
  EXPECT_EQ(checked(withLine(whole.substr(1)), 1), "");
  EXPECT_EQ(checked(withLine(whole.substr(1) + "\x7f"), 1), "");
  EXPECT_EQ(checked(withLine(whole.substr(1) + " "), 1), "");
}

TEST(ScipCheck, whatNeverEndsIsNotKept) {
  ScipCheck check;
  check.setCommand(kCommand);
  for (int i = 0; i < 100; ++i) check.add(std::string(10'000, '0'));
  EXPECT_GE(check.damaged(), 10u);
  check.add("\n\n" + scan());
  EXPECT_EQ(check.take(), scan());
}

}  // namespace
}  // namespace omnimapper::drivers::scip_check_test
