#include <gtest/gtest.h>
#include <omnimapper/base/Exceptions.h>

#include <stdexcept>

namespace exceptions_test {
namespace {

using omnimapper::base::sentenceOf;

TEST(Exceptions, OfMrptAreGivenAsTheirSentenceAlone) {
  const std::runtime_error mrpt(
      "==== MRPT exception ====\nMessage:  Cannot write to the file\nLocation: a.cpp:12: [write]\nCall stack: ...");
  EXPECT_EQ(sentenceOf(mrpt), "Cannot write to the file");
  const std::runtime_error passed_on("==== MRPT exception ====\nNo space left on device\nCall stack backtrace:\n[0 ]");
  EXPECT_EQ(sentenceOf(passed_on), "No space left on device");
  EXPECT_EQ(sentenceOf(std::runtime_error("Message: to its end")), "to its end");
  EXPECT_EQ(sentenceOf(std::runtime_error("Message:   ")), "Message:   ");
}

TEST(Exceptions, OfOthersAreGivenAsAWhole) {
  EXPECT_EQ(sentenceOf(std::runtime_error("no such place\nat all")), "no such place\nat all");
  EXPECT_EQ(sentenceOf(std::runtime_error("")), "");
}

}  // namespace
}  // namespace exceptions_test
