#include <gtest/gtest.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <vector>

#include "sign_landmarks/SignResection.h"

namespace omnimapper::plugins::sign_resection_test {
namespace {

using Eigen::Vector3d;
using geometry::Se3;

constexpr double kDegree = geometry::kPi / 180;

/// A base that drives along a corridor, with the views of signs on the walls by its camera.
class Drive {
 public:
  std::vector<KnownSignBearing> seen;

  explicit Drive(const Se3& map_from_session) : map_from_session_(map_from_session) {}

  /// `normal_off`: angle of the sign's normal from the direction to the viewpoint [rad].
  void see(std::uint32_t sign, const Vector3d& in_map, const Vector3d& base_in_map, double normal_off = 0,
           const Vector3d& truly_at = Vector3d::Zero()) {
    const Se3 map_from_base{map_from_session_.rotation, base_in_map};
    const Vector3d camera(0.1, 0, 1.4);
    const Vector3d there = truly_at.isZero() ? in_map : truly_at;
    const Vector3d direction = (geometry::inverse(map_from_base) * there - camera).normalized();
    Vector3d normal = map_from_base * camera - in_map;
    normal.z() = 0;
    normal = geometry::expSo3({0, 0, normal_off}) * normal.normalized();
    seen.push_back({{0, sign},
                    true,
                    in_map,
                    normal,
                    geometry::inverse(map_from_session_) * map_from_base,
                    MeasuredDirection(camera, direction),
                    1 * kDegree});
  }

 private:
  Se3 map_from_session_;
};

const Vector3d kFirst(3, 2, 1.5), kSecond(5, -1, 1.5);

Drive pastTwoSigns(const Se3& map_from_session, double normal_off = 0) {
  Drive drive(map_from_session);
  for (const double x : {0., 0.7, 1.4, 2.1}) {
    drive.see(1, kFirst, {x, 0.5, 0}, normal_off);
    drive.see(2, kSecond, {x, 0.5, 0}, normal_off);
  }
  return drive;
}

void expectFound(const Drive& drive, const Se3& map_from_session) {
  const auto found = resection(drive.seen);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->fitting, drive.seen.size());
  const Vector3d base = drive.seen.back().session_from_base.translation;
  EXPECT_LT((found->map_from_session * base - map_from_session * base).norm(), 1e-3);
  EXPECT_LT(found->map_from_session.rotation.angularDistance(map_from_session.rotation), 1e-3);
  EXPECT_LT(found->position_sigma, 0.35);
}

TEST(SignResection, TwoSignsSeenWhileDrivingLocateTheSession) {
  const Se3 map_from_session{geometry::expSo3({0, 0, 2}), {1, -3, 0}};
  expectFound(pastTwoSigns(map_from_session), map_from_session);
}

// A session whose origin is far away, and normals that are only known roughly.
TEST(SignResection, TheOriginOfTheSessionMayBeFarAway) {
  for (const double far : {30., 300., 3000.}) {
    for (const double normal_off : {-0.9, 0.5, 0.9}) {
      const Se3 map_from_session{geometry::expSo3({0, 0, -1}), {far, far, 0}};
      SCOPED_TRACE(far);
      expectFound(pastTwoSigns(map_from_session, normal_off), map_from_session);
    }
  }
}

TEST(SignResection, ASignThatWasMovedIsOutvoted) {
  const Se3 map_from_session{geometry::expSo3({0, 0, 1}), {1, 2, 0}};
  Drive drive(map_from_session);
  for (const double x : {0., 0.7, 1.4, 2.1}) {
    drive.see(1, kFirst, {x, 0.5, 0});
    drive.see(2, kSecond, {x, 0.5, 0});
    if (x > 1) drive.see(3, {2, -1, 1.5}, {x, 0.5, 0}, 0, {6, 2, 1.5});
  }
  const auto found = resection(drive.seen);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->fitting, 8U);
  EXPECT_LT((found->map_from_session.translation - map_from_session.translation).norm(), 0.1);
}

TEST(SignResection, TooFewMeasurementsHaveNoResult) {
  const Se3 here;
  const auto drive = pastTwoSigns(here);
  EXPECT_FALSE(resection({}));
  EXPECT_FALSE(resection({drive.seen.begin(), drive.seen.begin() + 3}));
  Drive one(here), standing(here), unnumbered = drive;
  for (const double x : {0., 0.5, 1., 1.5, 2.}) one.see(1, kFirst, {x, 0.5, 0});
  EXPECT_FALSE(resection(one.seen)) << "one sign";
  for (int i = 0; i < 4; ++i) {
    standing.see(1, kFirst, {0, 0.5, 0});
    standing.see(2, kSecond, {0, 0.5, 0});
  }
  EXPECT_FALSE(resection(standing.seen)) << "from one spot";
  for (auto& seen : unnumbered.seen) seen.is_numbered = false;
  EXPECT_FALSE(resection(unnumbered.seen)) << "words alone";
}

// Over a short distance travelled, two signs are seen under nearly the same angle from a whole arc of places.
TEST(SignResection, AnArcOfPlacesIsNoPlace) {
  Drive drive{Se3()};
  for (const double y : {0., 0.25, 0.5, 0.75}) {
    drive.see(1, {0, 4, 1.4}, {0, y, 0});
    if (y < 0.6) drive.see(2, {-1, 4, 1.4}, {0, y, 0});
  }
  for (auto& seen : drive.seen) seen.sigma = 3 * kDegree;
  EXPECT_FALSE(resection(drive.seen));
}

TEST(SignResection, NonsenseIsNoPlace) {
  auto drive = pastTwoSigns(Se3());
  drive.seen[2].in_map.x() = std::numeric_limits<double>::quiet_NaN();
  drive.seen[3].in_map.y() = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(resection(drive.seen));
}

}  // namespace
}  // namespace omnimapper::plugins::sign_resection_test
