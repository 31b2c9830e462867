// Training and detection on pictures of simulated buildings: the shipped model is tested on other pictures than it was
// trained on, and a new model is trained.
#include <gtest/gtest.h>
#include <omnimapper/testing/SignPictures.h>

#include <cstring>

#include "salient_signs/SalientSignDetector.h"
#include "salient_signs/TrainingRun.h"

namespace omnimapper::signs::simulated_test {
namespace {

constexpr int kPictures = 24;

// Pictures of seed 3; scripts/train-doorsigns takes those of seed 1.
testing::SignPictureOptions optionsOf(const std::string& style) {
  testing::SignPictureOptions options;
  options.style = style;
  options.seed = 3;
  options.places = 1;
  options.width = 640;
  options.height = 480;
  return options;
}

TrainingSet rendered(const std::string& style) {
  const testing::SignPictures pictures(optionsOf(style));
  TrainingSet set;
  set.name = style;
  for (int k = 0; k < kPictures; ++k) {
    auto picture = pictures.picture(k);
    TrainingPicture training{picture.name, [image = picture.image] { return image; }, {}};
    for (const auto& sign : picture.signs) training.signs.push_back({sign.name, sign.corners_px, sign.visible});
    set.pictures.push_back(std::move(training));
  }
  return set;
}

const std::vector<TrainingSet>& buildings() {
  static const std::vector<TrainingSet> sets{rendered("dark"), rendered("white")};
  return sets;
}

TEST(SimulatedSigns, theShippedModelFindsThem) {
  const SalientSignDetector detector({});
  int signs = 0, found = 0, false_alarms = 0, pictures = 0;
  for (const TrainingSet& set : buildings()) {
    for (const PictureTrial& trial : tryDetector(detector, set)) {
      signs += trial.signs, found += trial.found, false_alarms += trial.false_alarms, ++pictures;
    }
  }
  RecordProperty("signs", signs);
  RecordProperty("found", found);
  RecordProperty("false_alarms", false_alarms);
  ASSERT_GE(signs, 4);
  EXPECT_GE(found, 0.8 * signs);
  EXPECT_LE(false_alarms, 0.3 * pictures);
}

TEST(SimulatedSigns, theShippedModelDistinguishesRegions) {
  base::Progress quiet;
  for (const TrainingSet& set : buildings()) {
    const RegionSet regions = gatherRegions(set, SignTrainingOptions(), quiet);
    const SignRates rates = tryClassifier(SignClassifier::known(), regions, SalientSignOptions().min_score);
    EXPECT_GE(rates.truePositive(), 0.9) << set.name << ": " << rates.signs_right << " of " << rates.signs;
    EXPECT_GE(rates.trueNegative(), 0.98) << set.name << ": of " << rates.others;
  }
}

TEST(SimulatedSigns, aModelIsTrainedFromNothingAndTwiceTheSame) {
  base::Progress quiet;
  SignTrainingOptions options;
  options.min_score = 0.6;  // the detector's
  // A single building has too few signs for folds within folds.
  RegionSet both;
  for (const TrainingSet& set : buildings()) {
    const RegionSet regions = gatherRegions(set, options, quiet);
    both.regions.insert(both.regions.end(), regions.regions.begin(), regions.regions.end());
  }
  EXPECT_EQ(trainClassifier({&both}, options).toBytes(), trainClassifier({&both}, options).toBytes());
  const auto trials = crossValidate({both}, options, quiet);
  EXPECT_GE(trials.back().cross_validated.truePositive(), 0.6);
  EXPECT_GE(trials.back().cross_validated.trueNegative(), 0.97);
}

TEST(SimulatedSigns, pictureKIsTheSameWhenItIsRenderedAgain) {
  const auto again = testing::SignPictures(optionsOf("dark")).picture(3).image,
             before = buildings().front().pictures[3].load();
  ASSERT_EQ(again.getHeight(), before.getHeight());
  for (unsigned row = 0; row < again.getHeight(); ++row)
    EXPECT_EQ(0, std::memcmp(again.ptrLine<std::uint8_t>(row), before.ptrLine<std::uint8_t>(row), 3 * 640)) << row;
}

}  // namespace
}  // namespace omnimapper::signs::simulated_test
