#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>

#include "LineReader.h"
#include "NetworkReader.h"

namespace omnimapper::signs {
namespace {

TEST(Alphabet, takesWhatItHasAndADotForAHyphen) {
  const Alphabet common(Alphabet::common()), digits("0123456789"), greek("αβγ");
  EXPECT_EQ(common.letterFor("A"), "A");
  EXPECT_EQ(common.letterFor("\u00b7"), "-");
  EXPECT_EQ(common.letterFor("个"), "") << "an arrow may be read as this letter";
  EXPECT_EQ(common.letterFor(" "), " ");
  EXPECT_EQ(digits.letterFor("\u00b7"), "");
  EXPECT_EQ(digits.letterFor("O"), "");
  EXPECT_EQ(greek.letterFor("β"), "β");
}

TEST(Alphabet, damagedUtf8IsLeftOut) {
  EXPECT_EQ(lettersOf("a\xFFä\xC3"), (std::vector<std::string>{"a", "ä"}));
  EXPECT_TRUE(lettersOf("\xE4\xB8").empty());
}

TEST(DecodeSteps, lettersOnceUnlessABlankPartsThem) {
  // The classes are the blank, A, one whose letter is not in the alphabet, and B.
  const std::vector<std::string> letters{"", "A", "", "B"};
  const std::vector<float> steps{0.1f, 0.7f, 0.1f, 0.1f, 0.1f, 0.6f, 0.2f, 0.1f, 0.8f, 0.1f, 0,    0.1f,
                                 0.1f, 0.5f, 0.4f, 0,    0,    0.1f, 0.8f, 0.1f, 0.2f, 0.1f, 0.3f, 0.4f};
  const auto reading = decodeSteps(steps.data(), 6, letters);
  // The fifth step gives the letter A, as the step before: its class is the likeliest after the one without a letter.
  EXPECT_EQ(reading.text, "AAB");
  ASSERT_EQ(reading.probabilities.size(), 3u);
  EXPECT_FLOAT_EQ(static_cast<float>(reading.probabilities[0]), 0.7f);
  EXPECT_FLOAT_EQ(static_cast<float>(reading.probabilities[2]), 0.4f);
  EXPECT_FLOAT_EQ(static_cast<float>(reading.of_left_out), 0.1f)
      << "the probability of the letter taken in the fifth step";
}

TEST(NetworkReader, aFileWithoutLettersIsRefused) {
  const testing::ScratchFolder folder;
  std::ofstream(folder / "empty.txt");
  std::ofstream(folder / "damaged.txt") << "A\n\xC3\nB\n";
  std::ofstream(folder / "words.txt") << "A\nBC\n";
  for (const auto& [name, said] : {std::pair{"empty.txt", "empty.txt: has no letters"},
                                   {"missing.txt", "missing.txt: has no letters"},
                                   {"damaged.txt", "damaged.txt:2: is not one letter"},
                                   {"words.txt", "words.txt:2: is not one letter"}}) {
    try {
      NetworkReader(nullptr, folder / name, Alphabet("A"));
      ADD_FAILURE() << name << " was taken";
    } catch (const base::Error& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
}

// Returns prepared readings by the width of the patch.
class Scripted : public TextReader {
 public:
  explicit Scripted(std::vector<Reading> readings) : readings_(std::move(readings)) {}
  Reading read(const camera::ColourImage& patch) const override {
    return readings_[std::min<std::size_t>(patch.width / 30 - 3, 2)];
  }

 private:
  std::vector<Reading> readings_;
};

// A line of 100 x 20 px gives patches of 100, 112 (twice, once with stretched contrast) and 120 px.
const Corners kLine = {Eigen::Vector2f(100, 100), {200, 100}, {200, 120}, {100, 120}};

// Bars instead of letters, 5 px from the ends of the line.
cv::Mat pictureOfLine() {
  cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(120, 130, 140));
  for (int x = 105; x < 195; x += 8) picture(cv::Rect(x, 104, 3, 12)) = cv::Scalar(230, 230, 230);
  return picture;
}
const cv::Mat kPicture = pictureOfLine();

TEST(ReadLine, readingsThatAgreeAreTaken) {
  const Reading all{" 213 ", {0.9, 0.8, 0.95}};
  const auto line = readLine(kPicture, kLine, Scripted({all, all, all}));
  EXPECT_EQ(line.text, "213");
  EXPECT_EQ(line.evidence.agreement, 1);
  EXPECT_EQ(line.evidence.weakest_letter, 0.8);
  EXPECT_NEAR(line.evidence.height_px, 20, 1e-3);
  EXPECT_NEAR(line.evidence.clearance, 0.5, 0.01);
  EXPECT_GT(confidenceOf(line.evidence), 0.9);
}

// Reads one letter if the patch has strokes of one line, and none if of more.
class OneLine : public TextReader {
 public:
  Reading read(const camera::ColourImage& patch) const override {
    if (patch.height > 60) return {"?", {0.2}};
    return patch.width > 120 ? Reading{"WIDE", {1, 1, 1, 1}} : Reading{"NARROW", {1, 1, 1, 1, 1, 1}};
  }
};

TEST(ReadLines, whatIsNotSureIsReadInPartsIfTheseAreSurer) {
  cv::Mat picture(160, 320, CV_8UC3, cv::Scalar::all(40));
  for (int x = 80; x < 240; x += 8) picture(cv::Rect(x, 40, 4, 30)) = cv::Scalar::all(220);
  for (int x = 130; x < 190; x += 8) picture(cv::Rect(x, 85, 4, 20)) = cv::Scalar::all(220);
  const Corners both{Eigen::Vector2f(70, 35), {250, 35}, {250, 110}, {70, 110}};
  const auto lines = readLines(picture, both, OneLine());
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].reading.text, "WIDE");
  EXPECT_EQ(lines[1].reading.text, "NARROW");
  EXPECT_LT(lines[0].quad[2].y(), lines[1].quad[2].y());
}

TEST(ReadLine, readingsThatDifferAreNotSure) {
  const auto line = readLine(kPicture, kLine, Scripted({{"13", {1, 1}}, {"213", {0.9, 1, 1}}, {"213", {0.9, 1, 1}}}));
  EXPECT_EQ(line.text, "13") << "three of four patches are narrow";
  EXPECT_EQ(line.evidence.agreement, 0.75);
  EXPECT_LT(confidenceOf(line.evidence), 0.9);
  EXPECT_EQ(readLine(kPicture, kLine, Scripted({{}, {}, {}})).text, "");
}

TEST(ReadLine, aTextThatAnEdgeOrTheEndOfThePictureMayCutIsNotSure) {
  const Reading all{"213", {1, 1, 1}};
  const Scripted reader({all, all, all});
  cv::Mat cut = kPicture.clone();
  cut(cv::Rect(195, 0, 125, 240)) = cv::Scalar(20, 20, 20);
  const auto beside_an_edge = readLine(cut, kLine, reader);
  EXPECT_LT(beside_an_edge.evidence.clearance, 0.2);
  EXPECT_LT(confidenceOf(beside_an_edge.evidence), 0.9);
  cv::Mat half = kPicture(cv::Rect(0, 0, 195, 240)).clone();
  EXPECT_LT(readLine(half, kLine, reader).evidence.clearance, 0.2);
  cut(cv::Rect(195, 0, 125, 240)) = cv::Scalar(0, 0, 0);
  EXPECT_LT(readLine(cut, kLine, reader).evidence.clearance, 0.2);
}

}  // namespace
}  // namespace omnimapper::signs
