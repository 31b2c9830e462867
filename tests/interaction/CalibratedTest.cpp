#include <gtest/gtest.h>
#include <omnimapper/interaction/PointingTables.h>

#include <array>
#include <cmath>

#include "Gestures.h"

namespace omnimapper::interaction::calibrated_test {
namespace {

using Eigen::Vector3d;

constexpr double kNothing = 0.1;

// Of all stated probabilities within a tenth: their mean, and how often they were right.
struct Bin {
  double stated = 0;
  int right = 0, count = 0;
};

struct Outcome {
  std::array<Bin, 10> bins;
  int sure_and_wrong = 0, gestures = 0;

  void add(double stated, bool is_right) {
    Bin& bin = bins[std::min(9, static_cast<int>(10 * stated))];
    bin.stated += stated, bin.right += is_right, ++bin.count;
  }
};

Vector3d somewhere(DrawnErrors& errors) {
  const double azimuth = errors.uniform(-1, 1), range = errors.uniform(0.7, 1.5);
  return {range * std::cos(azimuth), range * std::sin(azimuth), errors.uniform(0.5, 1.3)};
}

// People point at one of three cans, or one time in ten in a direction in which there is none.
Outcome outcomeOf(double bias_sigma, double least_spread, double most_spread, int gestures, unsigned seed) {
  const PointingRow row = thesisRow(SkeletonSoftware::openni, 2);
  const PointingModel model{{row}};
  DrawnErrors errors(row, seed);
  TargetOptions options;
  options.nothing_prior = kNothing;
  Outcome outcome;
  for (int i = 0; i < gestures; ++i) {
    errors.nextUser(bias_sigma, least_spread, most_spread);
    std::vector<PointedCandidate> cans;
    std::vector<Vector3d> middles;
    for (int k = 0; k < 3; ++k) {
      middles.push_back(somewhere(errors));
      cans.push_back({canAt(middles.back()), {}, true});
    }
    const bool means_nothing = errors.uniform(0, 1) < kNothing;
    Vector3d target = middles[0];
    if (means_nothing) {
      const double azimuth = errors.uniform(-M_PI, M_PI), z = errors.uniform(-0.99, 0.99), level = std::sqrt(1 - z * z);
      target = Vector3d(0, 0, 1.1) + Vector3d(level * std::cos(azimuth), level * std::sin(azimuth), z);
    }
    const auto answer =
        determineTarget(gestureWith(target, errors.elbowHand(), errors.headHand()), cans, model, options);
    for (std::size_t k = 0; k < cans.size(); ++k) outcome.add(answer.probabilities[k], !means_nothing && k == 0);
    outcome.add(answer.nothing, means_nothing);
    const bool is_sure = answer.verdict == TargetVerdict::this_one;
    outcome.sure_and_wrong += is_sure && (means_nothing || answer.candidates[0] != 0);
    ++outcome.gestures;
  }
  return outcome;
}

void expectHeld(const Outcome& outcome, const std::string& who) {
  for (const Bin& bin : outcome.bins) {
    if (bin.count < 150) continue;
    const double stated = bin.stated / bin.count, found = static_cast<double>(bin.right) / bin.count;
    const double chance = std::sqrt(found * (1 - found) / bin.count);
    EXPECT_NEAR(stated, found, 0.05 + chance) << who << ", " << bin.count << " times";
  }
  EXPECT_LE(outcome.sure_and_wrong, 0.02 * outcome.gestures) << who;
}

TEST(Calibrated, statedProbabilitiesHoldForPeopleWhoMissAsTheTableSays) {
  expectHeld(outcomeOf(0, 1, 1, 3000, 1), "as the table");
}

// Each user is biased by half of the table's sigma, and spreads 0.6 to 1.4 times as far: 1.2 times the variance.
TEST(Calibrated, statedProbabilitiesHoldForPeopleWhoMissOtherwise) {
  expectHeld(outcomeOf(0.5, 0.6, 1.4, 3000, 2), "other users");
}

}  // namespace
}  // namespace omnimapper::interaction::calibrated_test
