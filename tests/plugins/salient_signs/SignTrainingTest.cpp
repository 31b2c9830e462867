#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/SplitMix.h>

#include <algorithm>
#include <cmath>

#include "salient_signs/Machine.h"
#include "salient_signs/PlattScaling.h"
#include "salient_signs/SignTraining.h"

namespace omnimapper::signs::training_test {
namespace {

SignTrainingOptions smallOptions() {
  SignTrainingOptions options;
  options.hog.columns = options.hog.rows = options.hog.block = 1;
  options.hog.orientations = 2;
  options.gamma = 10;
  return options;
}

// Signs on one side of x + y = 1 and others on the other, with `gap` between them; each region is a separate group.
RegionSet separable(const std::string& name, int count, int gap) {
  base::SplitMix random(7);
  RegionSet set;
  set.name = name;
  for (int i = 0; i < count; ++i) {
    const bool is_sign = i % 3 == 0;
    const int along = random.below(200), off = (gap + random.below(30)) * (is_sign ? 1 : -1);
    const auto byte = [](int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); };
    set.regions.push_back({{byte(along + off), byte(200 - along + off)}, is_sign, name + std::to_string(i)});
  }
  return set;
}

std::vector<const LabelledRegion*> pointers(const RegionSet& set) {
  std::vector<const LabelledRegion*> all;
  for (const auto& region : set.regions) all.push_back(&region);
  return all;
}

// The machine of two points is the plane halfway between them, with equal and opposite weights.
TEST(TrainMachine, twoPointsAreDividedHalfway) {
  RegionSet set;
  set.regions = {{{200, 40}, true, "a"}, {{40, 200}, false, "b"}};
  const SignModel model = trainMachine(pointers(set), smallOptions());
  ASSERT_EQ(model.vectors.size(), 2u);
  EXPECT_NEAR(model.weights[0] + model.weights[1], 0, 1e-6);
  const SignClassifier classifier(model);
  EXPECT_NEAR(classifier.decision({120, 120}), 0, 1e-3);
  EXPECT_NEAR(classifier.decision({200, 40}), 1, 1e-2);
  EXPECT_NEAR(classifier.decision({40, 200}), -1, 1e-2);
}

TEST(TrainClassifier, separablePointsAreAllClassifiedCorrectly) {
  const RegionSet set = separable("a", 150, 25);
  const SignClassifier classifier = trainClassifier({&set}, smallOptions());
  const SignRates rates = tryClassifier(classifier, set, 0.5);
  EXPECT_EQ(rates.signs, 50);
  EXPECT_EQ(rates.others, 100);
  EXPECT_EQ(rates.truePositive(), 1);
  EXPECT_EQ(rates.trueNegative(), 1);
}

TEST(TrainClassifier, theSameRegionsGiveTheSameBytes) {
  const RegionSet set = separable("a", 120, 10);
  EXPECT_EQ(trainClassifier({&set}, smallOptions()).toBytes(), trainClassifier({&set}, smallOptions()).toBytes());
}

// The stored vectors are exactly the training features, because both have 8 bits.
TEST(TrainClassifier, vectorsAreRegionsThatWereLearnt) {
  const RegionSet set = separable("a", 90, 5);
  const SignClassifier classifier = trainClassifier({&set}, smallOptions());
  for (const SignFeatures& vector : classifier.model().vectors) {
    EXPECT_TRUE(std::any_of(set.regions.begin(), set.regions.end(),
                            [&](const LabelledRegion& region) { return region.features == vector; }));
  }
}

TEST(TrainClassifier, tooLittleIsRefused) {
  RegionSet set;
  set.regions = {{{200, 40}, true, "a"}, {{40, 200}, true, "b"}};
  EXPECT_THROW(trainClassifier({&set}, smallOptions()), base::Error);
  EXPECT_THROW(trainClassifier({}, smallOptions()), base::Error);
}

TEST(Folds, aGroupIsInOneFoldAndFoldsAreAboutEven) {
  const auto options = smallOptions();
  std::vector<int> counts(static_cast<std::size_t>(options.folds), 0);
  for (int i = 0; i < 3000; ++i) {
    const LabelledRegion a{{0, 0}, true, "sign " + std::to_string(i)}, b{{9, 9}, false, a.group};
    const int fold = foldOf(a, options, FoldsOf::trial);
    EXPECT_EQ(fold, foldOf(b, options, FoldsOf::trial));
    ++counts[static_cast<std::size_t>(fold)];
  }
  for (const int count : counts) EXPECT_NEAR(count, 1000, 100);
}

TEST(CrossValidate, thereIsARowForEachBuildingAndOneForAll) {
  const std::vector<RegionSet> sets{separable("north", 150, 25), separable("south", 90, 25)};
  base::Progress quiet;
  const auto trials = crossValidate(sets, smallOptions(), quiet);
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[2].name, "north + south");
  EXPECT_EQ(trials[0].cross_validated.signs, 50);
  EXPECT_EQ(trials[2].cross_validated.signs, 80);
  for (const SignTrial& trial : trials) {
    ASSERT_EQ(trial.across.size(), 2u);
    EXPECT_GT(trial.cross_validated.truePositive(), 0.9);
    EXPECT_GT(trial.cross_validated.trueNegative(), 0.9);
  }
  const std::string text = toText(sets, trials);
  EXPECT_NE(text.find("Table 6"), std::string::npos);
  EXPECT_NE(text.find("Table 7"), std::string::npos);
}

TEST(CrossValidate, itEndsWhenItIsStopped) {
  base::Progress quiet;
  EXPECT_THROW(crossValidate({separable("a", 90, 25)}, smallOptions(), quiet, [] { return true; }), base::Error);
}

// Values +1 of signs and -1 of others, n of each: by symmetry the offset is 0, and the probability at +1 is the target
// (n + 1) / (n + 2) = 1 / (1 + exp(slope)).
TEST(FitPlatt, twoValuesHaveTheProbabilitiesOfTheirTargets) {
  const std::vector<double> signs(8, 1), others(8, -1);
  const PlattScaling fit = fitPlatt(signs, others);
  EXPECT_NEAR(fit.offset, 0, 1e-6);
  EXPECT_NEAR(1 / (1 + std::exp(fit.slope + fit.offset)), 9.0 / 10, 1e-6);
}

TEST(FitPlatt, theRarerClassWeighsAsMuch) {
  std::vector<double> signs, others;
  for (int i = 0; i < 100; ++i) signs.insert(signs.end(), {1, 0.5, -0.2});
  for (int i = 0; i < 900; ++i) others.insert(others.end(), {-1, -0.5, 0.2});
  const PlattScaling fit = fitPlatt(signs, others);
  EXPECT_LT(fit.slope, 0);
  EXPECT_NEAR(1 / (1 + std::exp(fit.offset)), 0.5, 0.05);  // of the value 0
}

}  // namespace
}  // namespace omnimapper::signs::training_test
