#include <gtest/gtest.h>
#include <omnimapper/map/KeyFrames.h>

#include "sign_landmarks/SignPayload.h"
#include "sign_landmarks/SignText.h"

namespace omnimapper::plugins::sign_text_test {
namespace {

obs::ObservedDoorSign signOf(const std::vector<obs::ReadText>& lines) {
  obs::ObservedDoorSign sign;
  sign.texts = lines;
  return sign;
}

SignText text(const std::string& number, std::vector<std::string> words = {}) {
  return {number, std::move(words), 0.95};
}

TEST(SignText, theFirstSureLineWithADigitIsTheNumber) {
  const auto read = textOf(signOf({{"Seminar", 0.99}, {"e 25-12", 0.9}, {"3rd floor", 0.95}, {"213", 0.5}}), 0.8);
  EXPECT_EQ(read.number, "E25-12");
  EXPECT_EQ(read.words, (std::vector<std::string>{"SEMINAR", "3RD FLOOR"}));
  EXPECT_EQ(read.confidence, 0.9);
  EXPECT_TRUE(textOf(signOf({{"213", 0.5}, {"", 1}}), 0.8).empty());
  EXPECT_EQ(textOf(signOf({{"Exit", 0.9},
                           {"K\xC3\xBC"
                            "che",
                            0.95}}),
                   0.8)
                .words.back(),
            "K\xC3\xBC"
            "CHE");
}

TEST(SignText, likenessIsTheLongestCommonSubsequenceOverTheLongerText) {
  EXPECT_DOUBLE_EQ(likeness("SEMINAR", "SEMINAR"), 1);
  EXPECT_DOUBLE_EQ(likeness("SEMINAR", "SEMNAR"), 6. / 7);
  EXPECT_DOUBLE_EQ(likeness("ABCD", "BXD"), 0.5);
  EXPECT_DOUBLE_EQ(likeness("", "A"), 0);
  EXPECT_DOUBLE_EQ(likeness("MEN", "WOMEN"), 0.6) << "not more than 60 %, so these are two";
}

TEST(SignText, numbersMustAgreeAndWordsBeAlike) {
  EXPECT_EQ(agreementOf(text("213"), text("213", {"OFFICE"})), Agreement::agrees);
  EXPECT_EQ(agreementOf(text("213", {"OFFICE"}), text("214", {"OFFICE"})), Agreement::contradicts);
  EXPECT_EQ(agreementOf(text("", {"MEN"}), text("", {"WOMEN"})), Agreement::contradicts);
  EXPECT_EQ(agreementOf(text("", {"SEMINAR"}), text("", {"SEMNAR"})), Agreement::agrees);
  EXPECT_EQ(agreementOf(text("213", {"OFFICE"}), text("", {"OFFICE"})), Agreement::partly);
  EXPECT_EQ(agreementOf(text("213", {"OFFICE"}), text("", {"KITCHEN"})), Agreement::contradicts);
  EXPECT_EQ(agreementOf(text("213"), text("", {"KITCHEN"})), Agreement::unknown);
}

TEST(SignText, aLongNumberIsOneSignMoreSurelyThanAShortOne) {
  EXPECT_EQ(oddsOfOneSign(text("213"), text("213")), 100);
  EXPECT_EQ(oddsOfOneSign(text("271B"), text("271B")), 100);
  EXPECT_EQ(oddsOfOneSign(text("1.234"), text("1.234")), 1000);
  EXPECT_EQ(oddsOfOneSign(text("22"), text("22")), 0.1) << "a date";
  EXPECT_EQ(oddsOfOneSign(text("16:00"), text("16:00")), 0.1) << "a time";
  EXPECT_EQ(oddsOfOneSign(text("", {"EXIT"}), text("", {"EXIT"})), 0.1);
}

TEST(SignPayload, whatWasReadMostIsWhatIsWritten) {
  auto sign = std::make_shared<SignPayload>();
  sign = sign->with({"218", {"OFFICE"}, 0.85}, "camera");
  sign = sign->with({"213", {"OFFICE"}, 0.9}, "camera");
  sign = sign->with({"213", {"OFF"}, 0.8}, "camera");
  EXPECT_EQ(sign->title(), "213");
  EXPECT_EQ(sign->text().words, std::vector<std::string>{"OFFICE"});
  EXPECT_EQ(sign->measurements(), 3U);
  auto other = std::make_shared<SignPayload>();
  other = other->with({"218", {}, 1}, "second")->with({"218", {}, 1}, "second");
  const auto both = sign->with(*other);
  EXPECT_EQ(both->title(), "218");
  EXPECT_EQ(both->measurements(), 5U);
  EXPECT_FALSE(both->is_repeated);
  EXPECT_TRUE(both->repeated()->is_repeated);
  const auto shape = sign->shape({Eigen::Vector3d(1, 2, 1.5)}, {});
  EXPECT_EQ(shape.label, "sign");
  EXPECT_EQ(shape.caption, "213");
  EXPECT_EQ(shape.points.front().z(), 1.5);
}

}  // namespace
}  // namespace omnimapper::plugins::sign_text_test
