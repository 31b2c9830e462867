// The whole way on pictures of simulated buildings: the shipped model is tried on others than it was trained on, and
// one is trained from nothing.
#include <gtest/gtest.h>
#include <omnimapper/signs/SalientSignDetector.h>
#include <omnimapper/signs/TrainingRun.h>
#include <omnimapper/testing/SignPictures.h>

#include <cstring>

namespace omnimapper::signs::simulated_test {
namespace {

constexpr int kPictures = 12;

// Pictures of seed 3; scripts/train-doorsigns takes those of seed 1.
TrainingSet rendered(const std::string& style) {
  testing::SignPictureOptions options;
  options.style = style;
  options.seed = 3;
  options.places = 1;
  options.width = 640;
  options.height = 480;
  const testing::SignPictures pictures(options);
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
  EXPECT_GE(found, 0.75 * signs);
  EXPECT_LE(false_alarms, 0.6 * pictures);
}

TEST(SimulatedSigns, theShippedModelTellsRegionsApart) {
  base::Progress quiet;
  const SignTrainingOptions options;
  for (const TrainingSet& set : buildings()) {
    const RegionSet regions = gatherRegions(set, options, quiet);
    const SignRates rates = tryClassifier(SignClassifier::known(), regions, options.min_score);
    EXPECT_GE(rates.truePositive(), 0.9) << set.name << ": " << rates.signs_told << " of " << rates.signs;
    EXPECT_GE(rates.trueNegative(), 0.97) << set.name;
  }
}

TEST(SimulatedSigns, aModelIsTrainedFromNothingAndTwiceTheSame) {
  base::Progress quiet;
  const SignTrainingOptions options;
  std::vector<RegionSet> regions;
  for (const TrainingSet& set : buildings()) regions.push_back(gatherRegions(set, options, quiet));
  const SignClassifier first = trainClassifier({&regions[0], &regions[1]}, options),
                       second = trainClassifier({&regions[0], &regions[1]}, options);
  EXPECT_EQ(first.toBytes(), second.toBytes());
  const auto trials = crossValidate(regions, options, quiet);
  EXPECT_GE(trials.back().cross_validated.truePositive(), 0.6);
  EXPECT_GE(trials.back().cross_validated.trueNegative(), 0.97);
}

TEST(SimulatedSigns, pictureKIsTheSameWhenItIsRenderedAgain) {
  testing::SignPictureOptions options;
  options.places = 1;
  options.width = 160;
  options.height = 120;
  const testing::SignPictures pictures(options);
  const auto a = pictures.picture(3), b = testing::SignPictures(options).picture(3);
  ASSERT_EQ(a.image.getHeight(), b.image.getHeight());
  for (unsigned row = 0; row < a.image.getHeight(); ++row)
    EXPECT_EQ(0, std::memcmp(a.image.ptrLine<std::uint8_t>(row), b.image.ptrLine<std::uint8_t>(row), 480));
}

}  // namespace
}  // namespace omnimapper::signs::simulated_test
