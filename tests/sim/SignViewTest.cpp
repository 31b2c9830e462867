#include <gtest/gtest.h>
#include <omnimapper/sim/SignView.h>

#include "CameraFixture.h"

namespace sign_view_test {
namespace {

using namespace omnimapper;
using sim::CameraFixture;
using sim::SignView;

constexpr double kFocal = 600, kWidth = 0.4, kHeight = 0.2;  // [pixel], [m], [m]

// Signs in view of a camera of 640 x 480 pixels at the origin that looks along x.
class SignViews : public ::testing::Test {
 protected:
  /// A sign that faces -x, turned to the left; capitals of 6 cm, and of 2 cm below.
  void addSign(const std::string& name, const Eigen::Vector3d& at, double turn = 0) {
    Eigen::Matrix3d axes;  // x to the reader's right, y up, z to the reader
    axes << 0, 0, -1, -1, 0, 0, 0, 1, 0;
    const Eigen::AngleAxisd turned(turn, Eigen::Vector3d::UnitZ());
    const geometry::Se3 map_from_sign{Eigen::Quaterniond(turned * Eigen::Quaterniond(axes)), at};
    sim::MeshBuilder body(name, sim::Track(map_from_sign));
    const double x = kWidth / 2, y = kHeight / 2;
    body.addPlane("", sim::SurfaceKind::sign, {}, {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}});
    fixture_.world.bodies.push_back(body.build());
    fixture_.world.signs.push_back({name, {"118", "Workshop"}, "", map_from_sign, kWidth, kHeight, {0.06, 0.02}});
  }
  std::vector<SignView> seen() {
    fixture_.scenes = std::make_unique<sim::Scenes>(fixture_.world);
    sim::CameraView view;
    view.camera = sim::Pinhole::centred(640, 480, kFocal);
    Eigen::Matrix3d axes;  // x to the right, y down, z ahead
    axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    view.map_from_optical = {Eigen::Quaterniond(axes), Eigen::Vector3d::Zero()};
    return sim::signsInView(fixture_.world, *fixture_.scenes, fixture_.scenes->at(0), view);
  }

  CameraFixture fixture_;
};

// At 2 m and a focal length of 600, 6 cm are 600 * 0.06 / 2 = 18 pixels, 2 cm are 6, and 40 x 20 cm are 120 x 60
// pixels.
TEST_F(SignViews, capitalsAndCornersAreThoseOfThePinhole) {
  addSign("ahead", {2, 0, 0});
  const auto signs = seen();
  ASSERT_EQ(signs.size(), 1u);
  EXPECT_NEAR(signs[0].capitals, 18, 1e-9);
  EXPECT_NEAR(signs[0].least_capitals, 6, 1e-9);
  EXPECT_NEAR(signs[0].distance, 2, 1e-12);
  EXPECT_NEAR(signs[0].incidence, 0, 1e-7);
  EXPECT_EQ(signs[0].visible, 1);
  EXPECT_TRUE(signs[0].is_whole);
  EXPECT_TRUE(isLegible(signs[0]));
  const Eigen::Vector2d middle(319.5, 239.5);
  EXPECT_TRUE(signs[0].corners[0].isApprox(middle + Eigen::Vector2d(-60, -30)));
  EXPECT_TRUE(signs[0].corners[1].isApprox(middle + Eigen::Vector2d(60, -30)));
  EXPECT_TRUE(signs[0].corners[2].isApprox(middle + Eigen::Vector2d(60, 30)));
  EXPECT_TRUE(signs[0].corners[3].isApprox(middle + Eigen::Vector2d(-60, 30)));
}

// The depth of its middle is the same, and so is the height of its capitals; beyond 60 deg it is not legible.
TEST_F(SignViews, aTurnedSignIsSeenUnderTheAngleItIsTurnedBy) {
  addSign("turned", {2, 0, 0}, 50 * M_PI / 180);
  addSign("slanted", {2, 0, 0.5}, -61 * M_PI / 180);
  const auto signs = seen();
  ASSERT_EQ(signs.size(), 2u);
  EXPECT_NEAR(signs[0].incidence * 180 / M_PI, 50, 1e-9);
  EXPECT_NEAR(signs[0].capitals, 18, 1e-9);
  EXPECT_TRUE(isLegible(signs[0]));
  EXPECT_GT(signs[1].incidence * 180 / M_PI, 61);
  EXPECT_FALSE(isLegible(signs[1]));
}

// 600 * 0.06 / 2.2 = 16.36 pixels and 600 * 0.06 / 2.3 = 15.65.
TEST_F(SignViews, capitalsOf16PixelsAreLegibleAndSmallerOnesAreNot) {
  addSign("near", {2.2, 0.3, 0});
  addSign("far", {2.3, -0.3, 0});
  const auto signs = seen();
  ASSERT_EQ(signs.size(), 2u);
  EXPECT_TRUE(isLegible(signs[0]));
  EXPECT_NEAR(signs[1].capitals, 15.652, 1e-3);
  EXPECT_FALSE(isLegible(signs[1]));
}

// The five columns of rays are at y = 1.16, 1.08, 1, 0.92, 0.84 m; the first two are at -28.5 and -4.5 pixels.
TEST_F(SignViews, whatIsOutOfThePictureIsNotVisible) {
  addSign("aside", {2, 1, 0});
  const auto signs = seen();
  ASSERT_EQ(signs.size(), 1u);
  EXPECT_NEAR(signs[0].corners[0].x(), 319.5 - 600 * 1.2 / 2, 1e-9);
  EXPECT_NEAR(signs[0].visible, 0.6, 1e-12);
  EXPECT_FALSE(signs[0].is_whole);
  EXPECT_FALSE(isLegible(signs[0]));
}

// A board at 1 m from y = 0.02 to 0.2 m hides y = 0.04 to 0.4 m at 2 m, that is, the columns at 0.16 and 0.08 m.
TEST_F(SignViews, whatStandsBeforeASignHidesItsPart) {
  addSign("sign", {2, 0, 0});
  fixture_.addBoard("post", 1, 0.11, 0, 0.18, 3);
  const auto signs = seen();
  ASSERT_EQ(signs.size(), 1u);
  EXPECT_NEAR(signs[0].visible, 0.6, 1e-12);
  EXPECT_TRUE(signs[0].is_whole);
  EXPECT_FALSE(isLegible(signs[0]));
}

TEST_F(SignViews, aSignBehindAWallOrSeenFromBehindIsNotInView) {
  addSign("behind_wall", {2, 0.5, 0});
  addSign("from_behind", {2, -0.5, 0}, M_PI);
  fixture_.addBoard("wall", 1, 0.5, 0, 0.9, 3);
  EXPECT_TRUE(seen().empty());
}

TEST_F(SignViews, aPaneHidesNothing) {
  addSign("sign", {2, 0, 0});
  sim::Material glass;
  glass.transmission = 0.9f;
  fixture_.addBoard("pane", 1, 0, 0, 2, 2, glass);
  const auto signs = seen();
  ASSERT_EQ(signs.size(), 1u);
  EXPECT_EQ(signs[0].visible, 1);
}

TEST(SignCounter, countsPicturesAndVisitsMoreThanHalfAMinuteApart) {
  SignView legible, slanted;
  legible.is_whole = slanted.is_whole = true;
  legible.capitals = slanted.capitals = 20;
  legible.visible = slanted.visible = 1;
  slanted.incidence = 1.2;
  slanted.sign = 1;
  sim::SignCounter counter(3);
  for (const double time : {0.0, 1.0, 31.0, 62.0, 200.0}) counter.add(time, {legible, slanted});
  EXPECT_EQ(counter.readings()[0].pictures, 5);
  EXPECT_EQ(counter.readings()[0].visits, 3);
  EXPECT_EQ(counter.readings()[1].pictures, 0);
  EXPECT_EQ(counter.inPictures(1), 1);
  EXPECT_EQ(counter.onVisits(3), 1);
  EXPECT_EQ(counter.onVisits(4), 0);
}

}  // namespace
}  // namespace sign_view_test
