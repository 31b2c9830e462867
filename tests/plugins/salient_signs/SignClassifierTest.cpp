#include <gtest/gtest.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <future>
#include <ostream>

#include "../../signs/Drawn.h"
#include "salient_signs/SalientSignDetector.h"
#include "salient_signs/SignClassifier.h"

namespace omnimapper::signs::classifier_test {
namespace {

// One cell of 8 x 8 pixels with two orientations: two numbers.
HogOptions smallHog() {
  HogOptions hog;
  hog.columns = hog.rows = hog.block = 1;
  hog.orientations = 2;
  hog.margin = 0;
  return hog;
}

// Two support vectors, one for each class.
SignModel smallModel() {
  SignModel model;
  model.hog = smallHog();
  model.gamma = 2;
  model.bias = 0.25;
  model.slope = -3;
  model.offset = 0.5;
  model.weights = {1.5, -0.75};
  model.vectors = {{255, 0}, {0, 255}};
  return model;
}

TEST(HogOptions, theThesisHas4x4CellsOfNineOrientationsInOneBlock) {
  EXPECT_EQ(HogOptions().length(), 4 * 4 * 9);
  HogOptions overlapping;
  overlapping.block = 2;
  EXPECT_EQ(overlapping.length(), 3 * 3 * 4 * 9);
}

// Brightness grows to the right alone, so that all gradients are along x: angle 0 is on the border of the first and the
// last of nine orientations, which share it evenly. The block weighs its middle more than its corners, by a Gaussian of
// an eighth of its sides' sum.
TEST(Describe, aRampHasEdgesOfOneDirection) {
  Drawn ramp(96, 96, 0);
  for (int column = 0; column < 96; ++column)
    ramp.fill(column, 0, column + 1, 96, static_cast<std::uint8_t>(20 + 2 * column));
  HogOptions hog;
  hog.margin = 0;
  const auto features = describe(ramp.view(), {rectangle(15.5f, 15.5f, 79.5f, 79.5f)}, hog);
  ASSERT_EQ(features.size(), 1u);
  ASSERT_EQ(features[0].size(), 144u);
  double sum_of_squares = 0;
  for (std::size_t i = 0; i < 144; ++i) {
    sum_of_squares += std::pow(features[0][i] / 510.0, 2);
    EXPECT_TRUE(features[0][i] == 0 || i % 9 == 0 || i % 9 == 8) << i;
  }
  for (std::size_t cell = 0; cell < 16; ++cell)
    EXPECT_NEAR(features[0][9 * cell], features[0][9 * cell + 8], 1) << cell;
  EXPECT_GT(features[0][9 * 5], 3 * features[0][0]);
  EXPECT_NEAR(sum_of_squares, 1, 0.02);
}

TEST(Describe, whatIsBrightOnDarkEqualsWhatIsDarkOnBright) {
  Drawn dark(64, 64, 50), bright(64, 64, 200);
  dark.fill(20, 24, 44, 40, 200);
  bright.fill(20, 24, 44, 40, 50);
  HogOptions hog;
  const Corners region = rectangle(11.5f, 11.5f, 51.5f, 51.5f);
  const auto a = describe(dark.view(), {region}, hog), b = describe(bright.view(), {region}, hog);
  for (std::size_t i = 0; i < a[0].size(); ++i) EXPECT_NEAR(a[0][i], b[0][i], 45) << i;
}

TEST(Describe, regionsBesideThePictureOrWithoutExtentSayNothing) {
  const Drawn drawn(64, 64, 50);
  const auto features = describe(drawn.view(), {rectangle(200, 200, 240, 220), rectangle(5, 5, 5, 5)}, HogOptions());
  for (const SignFeatures& each : features) EXPECT_EQ(each, SignFeatures(144, 0));
}

// 255 of 510 is 0.5, so the other vector is 0.5 away along both axes: exp(-2 (0.25 + 0.25)) = exp(-1).
TEST(SignClassifier, theDecisionIsEquation2AndTheProbabilityItsLogistic) {
  const SignClassifier classifier(smallModel());
  const double decision = 1.5 - 0.75 * std::exp(-1.0) + 0.25;
  EXPECT_NEAR(classifier.decision({255, 0}), decision, 1e-12);
  EXPECT_NEAR(classifier.probability({255, 0}), 1 / (1 + std::exp(-3 * decision + 0.5)), 1e-12);
  EXPECT_THROW(classifier.decision({1, 2, 3}), std::invalid_argument);
}

TEST(SignClassifier, aModelWhosePartsDoNotFitIsRefused) {
  auto model = smallModel();
  model.weights.pop_back();
  EXPECT_THROW(SignClassifier{model}, std::invalid_argument);
  model = smallModel();
  model.vectors[1].push_back(0);
  EXPECT_THROW(SignClassifier{model}, std::invalid_argument);
  model = smallModel();
  model.gamma = std::nan("");
  EXPECT_THROW(SignClassifier{model}, std::invalid_argument);
  model = smallModel();
  model.hog.block = 9;
  EXPECT_THROW(SignClassifier{model}, std::invalid_argument);
}

TEST(SignModelFile, whatIsReadIsWhatWasWritten) {
  const testing::ScratchFolder folder;
  const SignClassifier written(smallModel());
  written.write(folder / "signs.svm");
  const SignClassifier read = SignClassifier::read(folder / "signs.svm");
  EXPECT_EQ(read.toBytes(), written.toBytes());
  for (int i = 0; i < 256; i += 5) {
    const SignFeatures features{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i)};
    EXPECT_EQ(read.probability(features), written.probability(features));
  }
}

std::string refusalOf(const std::string& bytes) {
  try {
    SignClassifier::fromBytes(bytes, "the.svm");
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    return error.what();
  }
  return "";
}

TEST(SignModelFile, everyDamageIsRefusedWithTheFilesName) {
  const std::string bytes = SignClassifier(smallModel()).toBytes();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_NE(refusalOf(bytes.substr(0, length)).find("the.svm"), std::string::npos) << length;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x21);
    EXPECT_NE(refusalOf(damaged).find("the.svm"), std::string::npos) << i;
  }
  EXPECT_NE(refusalOf(bytes + "x"), "");
  EXPECT_NE(refusalOf(std::string(100, '\0')).find("omnimapper-train-doorsigns"), std::string::npos);
}

TEST(SignModelFile, aLaterVersionAndAMissingFileSayWhatHelps) {
  std::string later = SignClassifier(smallModel()).toBytes();
  later[16] = 2;
  EXPECT_NE(refusalOf(later).find("version 2"), std::string::npos);
  EXPECT_THROW(SignClassifier::read("/nowhere/signs.svm"), base::Error);
}

TEST(SignClassifier, theShippedModelIsSmallAndReads) {
  const SignClassifier& known = SignClassifier::known();
  EXPECT_LT(known.toBytes().size(), 1000000u);
  EXPECT_EQ(known.model().hog.length(), HogOptions().length());
}

TEST(SalientSignDetector, onePictureGivesTheSameBitsTwiceAndFromThreads) {
  Drawn drawn(640, 480, 180);
  for (int k = 0; k < 5; ++k) {
    drawn.fill(40 + 110 * k, 150, 120 + 110 * k, 190, 60);
    for (int i = 0; i < 6; ++i) drawn.fill(50 + 110 * k + 10 * i, 160, 54 + 110 * k + 10 * i, 172 + k, 230);
  }
  SalientSignOptions options;
  options.min_score = 0;
  const SalientSignDetector detector(options);
  const auto first = detector.detect(drawn.view());
  ASSERT_FALSE(first.empty());
  std::vector<std::future<std::vector<SignRegion>>> others;
  for (int i = 0; i < 4; ++i)
    others.push_back(std::async(std::launch::async, [&] { return detector.detect(drawn.view()); }));
  for (auto& other : others) {
    const auto again = other.get();
    ASSERT_EQ(again.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(again[i].score, first[i].score);
      EXPECT_EQ(again[i].corners_px, first[i].corners_px);
    }
  }
}

TEST(SalientSignDetector, scoresFallAndReportedRegionsDoNotLieOnOneAnother) {
  Drawn drawn(640, 480, 180);
  drawn.fill(100, 150, 220, 210, 60);
  drawn.fill(110, 160, 200, 180, 230);
  SalientSignOptions options;
  options.min_score = 0;
  const auto signs = SalientSignDetector(options).detect(drawn.view());
  for (std::size_t i = 1; i < signs.size(); ++i) EXPECT_LE(signs[i].score, signs[i - 1].score);
  options.min_score = 1;
  EXPECT_TRUE(SalientSignDetector(options).detect(drawn.view()).empty());
}

}  // namespace
}  // namespace omnimapper::signs::classifier_test
