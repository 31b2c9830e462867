#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/interaction/PointingTables.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <fstream>

namespace omnimapper::interaction::pointing_model_test {
namespace {

constexpr double kDegree = M_PI / 180;

const auto kRays = {&PointingRow::elbow_hand, &PointingRow::head_hand};
const auto kAngles = {&RayErrors::theta, &RayErrors::psi};

// The thesis pooled the same 180 frames for its column of all targets, so the mixture of its seven rows must give it.
// Its rows are rounded to 0.1 deg; the sigmas differ by up to 0.4 deg, as target 7's misprints show that some are
// wrong.
TEST(PointingModel, theMixtureOfAllRowsIsTheThesissColumnOfAllTargets) {
  for (const auto software : {SkeletonSoftware::ms_sdk, SkeletonSoftware::openni}) {
    const PointingRow mixed = errorsTowards(thesisModel(software), {}), printed = thesisRow(software, 0);
    for (const auto ray : kRays) {
      for (const auto angle : kAngles) {
        EXPECT_NEAR((mixed.*ray.*angle).mean, (printed.*ray.*angle).mean, 0.15 * kDegree);
        EXPECT_NEAR((mixed.*ray.*angle).sigma, (printed.*ray.*angle).sigma, 0.45 * kDegree);
      }
    }
  }
}

TEST(PointingModel, valuesAreThoseOfTheTables) {
  const PointingRow row = thesisRow(SkeletonSoftware::openni, 2);
  EXPECT_NEAR(row.elbow_hand.psi.sigma, 10.9 * kDegree, 1e-12);
  EXPECT_NEAR(row.head_hand.theta.mean, 10.2 * kDegree, 1e-12);
  EXPECT_NEAR(thesisRow(SkeletonSoftware::openni, 7).elbow_hand.psi.sigma, 3.0 * kDegree, 1e-12) << "printed as -3.0";
  EXPECT_THROW(thesisRow(SkeletonSoftware::openni, 8), std::out_of_range);
}

PointingModel twoRows() {
  PointingModel model;
  const AngleError narrow{0.1, 0.02}, wide{-0.1, 0.04};
  model.rows = {{"left", TargetDirection{0.5, 0}, {narrow, narrow}, {narrow, narrow}},
                {"right", TargetDirection{-0.5, 0}, {wide, wide}, {wide, wide}}};
  model.direction_sigma = 0.2;
  return model;
}

// Half way between two rows, both count the same: mean 0, variance the mean of both plus that of the means.
TEST(PointingModel, betweenTwoRowsTheirDisagreementIsUncertainty) {
  const PointingModel model = twoRows();
  const PointingRow middle = errorsTowards(model, TargetDirection{0, 0});
  EXPECT_NEAR(middle.elbow_hand.theta.mean, 0, 1e-12);
  EXPECT_NEAR(middle.elbow_hand.theta.sigma, std::sqrt((0.02 * 0.02 + 0.04 * 0.04) / 2 + 0.01), 1e-12);
  const PointingRow at_left = errorsTowards(model, TargetDirection{0.5, 0});
  EXPECT_NEAR(at_left.elbow_hand.theta.mean, 0.1, 1e-5);
  EXPECT_NEAR(errorsTowards(model, TargetDirection{3, 0}).elbow_hand.theta.mean, 0, 1e-12) << "far from both";
}

TEST(PointingModel, anglesBetweenDirectionsAreThoseOnTheSphere) {
  EXPECT_NEAR(angleBetween({0, 0}, {0.3, 0}), 0.3, 1e-12);
  EXPECT_NEAR(angleBetween({0, M_PI / 2}, {1, M_PI / 2}), 0, 1e-7);
  EXPECT_NEAR(angleBetween({M_PI - 0.1, 0}, {0.1 - M_PI, 0}), 0.2, 1e-12);
}

TEST(PointingModel, isReadAsItIsWritten) {
  testing::ScratchFolder folder;
  const std::string path = folder / "pointing.csv";
  PointingModel model = thesisModel(SkeletonSoftware::openni);
  model.rows[2].direction = TargetDirection{0.25, -0.5};
  model.rows[2].target = "lamp, \"old\"";
  model.theta_correlation = 0.3;
  std::ofstream(path) << tableOf(model);
  const PointingModel read = readPointingModel(path);
  EXPECT_EQ(tableOf(read), tableOf(model));
  ASSERT_TRUE(read.rows[2].direction);
  EXPECT_NEAR(read.rows[2].direction->altitude, -0.5, 1e-6);
  EXPECT_FALSE(read.rows[0].direction);
  EXPECT_EQ(read.rows[2].target, "lamp, \"old\"");
}

TEST(PointingModel, aTableWithoutSenseIsRefusedWithFileAndPlace) {
  testing::ScratchFolder folder;
  const std::string path = folder / "pointing.csv";
  const auto refusal = [&](const std::string& text) -> std::string {
    std::ofstream(path) << text;
    try {
      readPointingModel(path);
    } catch (const base::Error& error) {
      return error.what();
    }
    return "taken";
  };
  const std::string good = tableOf(twoRows());
  EXPECT_EQ(refusal(good), "taken");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_NE(refusal(with(",1.1459,", ",-1.1459,")).find("is not positive"), std::string::npos);
  EXPECT_NE(refusal(with(",1.1459,", ",nan,")).find(path), std::string::npos);
  EXPECT_NE(refusal(with(",0.0000,0.0000\n", ",1.5,0\n")).find("a correlation is not between"), std::string::npos);
  EXPECT_NE(refusal(good.substr(0, good.find('\n') + 1)).find("has no row"), std::string::npos);
  EXPECT_NE(refusal("").find("empty"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::interaction::pointing_model_test
