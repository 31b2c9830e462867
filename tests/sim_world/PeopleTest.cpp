#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/interaction/PointingError.h>
#include <omnimapper/sim_world/People.h>
#include <omnimapper/sim_world/Scene.h>

#include <cmath>
#include <functional>

namespace people_test {
namespace {

using namespace omnimapper;
using Eigen::Vector2d;
using Eigen::Vector3d;
using sim::MadePerson;
using sim::PersonSpec;

constexpr double kDegree = M_PI / 180;

Vector3d joint(const MadePerson& made, const std::string& name, double time) {
  for (const auto& joint : made.person.joints) {
    if (joint.name == name) return joint.in_map.at(time)->translation;
  }
  ADD_FAILURE() << "no joint " << name;
  return Vector3d::Zero();
}

const sim::Body& body(const MadePerson& made, const std::string& part) {
  for (const auto& body : made.bodies) {
    if (body.name == made.person.name + "/" + part) return body;
  }
  throw std::invalid_argument(part);
}

double lowestOf(const sim::Body& body, double time) {
  double low = 1e9;
  for (const Vector3d& p : body.vertices_in_body) low = std::min(low, (*body.track.at(time) * p).z());
  return low;
}

double distanceOf(const Vector3d& point, const sim::Body& body, double time) {
  const Vector3d in_body = geometry::inverse(*body.track.at(time)) * point;
  double least = 1e9;
  for (const Vector3d& p : body.vertices_in_body) least = std::min(least, (p - in_body).norm());
  return least;
}

// A person who walks an L and back, and stands for three seconds in between.
PersonSpec walker(double height = 1.72) {
  PersonSpec spec;
  spec.name = "anna";
  spec.height = height;
  spec.floor_z = 0.5;
  spec.waypoints = sim::walkAtSpeed({{0, 0}, {4, 0}, {4, 3}}, 1.2, 1);
  const double rest = spec.waypoints.back().time + 3;
  spec.waypoints.push_back({{4, 3}, rest});
  spec.waypoints.push_back({{0, 3}, rest + 4});
  return spec;
}

PersonSpec pointer(const Vector3d& target, bool right_arm) {
  PersonSpec spec;
  spec.name = "bob";
  spec.waypoints = {{{1, 2}, 0}};
  spec.acts.push_back({3, 5, "cup", target, right_arm});
  return spec;
}

TEST(People, waypointsAreReachedInTime) {
  const MadePerson made = sim::makePerson(walker());
  EXPECT_TRUE(joint(made, "torso", 1).head<2>().isApprox(Vector2d(0, 0), 1e-9) ||
              joint(made, "torso", 1).head<2>().norm() < 1e-9);
  EXPECT_LT((joint(made, "torso", 1 + 4 / 1.2).head<2>() - Vector2d(4, 0)).norm(), 0.04);
  EXPECT_LT((joint(made, "torso", 8.5).head<2>() - Vector2d(4, 3)).norm(), 1e-9);
  EXPECT_LT((joint(made, "head", 100).head<2>() - Vector2d(0, 3)).norm(), 1e-9);
  EXPECT_NEAR(joint(made, "head", 8.5).z(), 0.5 + 0.93 * 1.72, 1e-9);
}

TEST(People, limbsKeepTheirLengths) {
  for (const double height : {1.2, 1.72, 2.0}) {
    PersonSpec spec = walker(height);
    spec.acts.push_back({8.2, 8.9, "", {6, 5, 1.2}, false});
    const MadePerson made = sim::makePerson(spec);
    for (const std::string side : {"left_", "right_"}) {
      for (const auto& [from, to, length] : {std::tuple("hip", "knee", 0.245),
                                             {"knee", "foot", 0.246},
                                             {"shoulder", "elbow", 0.186},
                                             {"elbow", "hand", 0.19}}) {
        for (int i = 0; i < 320; ++i) {
          const double time = i * 0.05;
          const double now = (joint(made, side + from, time) - joint(made, side + to, time)).norm();
          EXPECT_NEAR(now, length * height, 1e-9) << side << from << " at " << time;
          const double between = (joint(made, side + from, time + 0.025) - joint(made, side + to, time + 0.025)).norm();
          EXPECT_NEAR(between, length * height, 0.008) << side << from << " at " << time;
        }
      }
    }
  }
}

TEST(People, aFootIsOnTheFloorAndStaysWhereItIsUntilItSwings) {
  const MadePerson made = sim::makePerson(walker());
  int planted = 0;
  for (int i = 20; i < 320; ++i) {
    const double time = i * 0.05;
    const double left = lowestOf(body(made, "left_foot"), time), right = lowestOf(body(made, "right_foot"), time);
    EXPECT_NEAR(std::min(left, right), 0.5, 1e-9) << time;
    EXPECT_LT(std::max(left, right), 0.58) << time;
    for (const std::string foot : {"left_foot", "right_foot"}) {
      const bool down = lowestOf(body(made, foot), time) < 0.5 + 1e-9;
      const bool was_down = lowestOf(body(made, foot), time - 0.05) < 0.5 + 1e-9;
      if (!down || !was_down || (time > 7 && time < 10)) continue;  // here the person stands and turns on the spot
      ++planted;
      EXPECT_LT((joint(made, foot, time) - joint(made, foot, time - 0.05)).norm(), 0.02) << foot << " " << time;
    }
  }
  EXPECT_GT(planted, 150);
}

TEST(People, feetOvertakeOneAnotherInStepsOfFourTenthsOfTheHeight) {
  PersonSpec spec;
  spec.name = "anna";
  spec.waypoints = sim::walkAtSpeed({{0, 0}, {10, 0}}, 1.3, 0);
  const MadePerson made = sim::makePerson(spec);
  double widest = 0, before = 0;
  int changes = 0;
  for (double time = 1; time < 6.7; time += 0.05) {
    const double apart = joint(made, "left_foot", time).x() - joint(made, "right_foot", time).x();
    widest = std::max(widest, std::abs(apart));
    changes += apart * before < 0;
    before = apart;
    EXPECT_NEAR(joint(made, "left_foot", time).y() - joint(made, "right_foot", time).y(), 0.1 * 1.72, 1e-9);
  }
  EXPECT_NEAR(widest, 0.4 * 1.72, 0.05);
  // 1.3 m/s for 5.7 s in steps of 0.69 to 0.71 m.
  EXPECT_NEAR(changes, 5.7 * 1.3 / 0.7, 1.5);
}

TEST(People, aLaserAtShinHeightSeesTwoLegsOfTwelveCentimetres) {
  PersonSpec spec;
  spec.name = "anna";
  spec.waypoints = {{{0, 0}, 0}};  // looks along x
  const MadePerson made = sim::makePerson(spec);
  sim::World world;
  world.bodies = made.bodies;
  world.people.push_back(made.person);
  sim::validate(world);
  const sim::Scenes scenes(world);
  std::vector<double> widths;
  bool was_hit = false;
  for (double y = -0.5; y < 0.5; y += 0.001) {
    const bool hit = scenes.at(0).cast({{2, y, 0.3}, {-1, 0, 0}}).isHit();
    if (hit && !was_hit) widths.push_back(0);
    if (hit) widths.back() += 0.001;
    was_hit = hit;
  }
  ASSERT_EQ(widths.size(), 2u);
  for (const double width : widths) EXPECT_NEAR(width, 0.12, 0.006);
}

TEST(People, jointsAreInsideTheirBodies) {
  PersonSpec spec = walker();
  spec.acts.push_back({8.2, 8.9, "", {6, 5, 1.2}, true});
  const MadePerson made = sim::makePerson(spec);
  EXPECT_EQ(made.person.joints.size(), 15u);
  EXPECT_EQ(made.person.bodies.size(), made.bodies.size());
  for (const auto& [name, part] : {std::pair("head", "head"),
                                   {"neck", "torso"},
                                   {"torso", "torso"},
                                   {"left_hip", "left_thigh"},
                                   {"left_knee", "left_thigh"},
                                   {"left_knee", "left_shin"},
                                   {"left_foot", "left_shin"},
                                   {"left_foot", "left_foot"},
                                   {"left_shoulder", "left_upper_arm"},
                                   {"left_elbow", "left_upper_arm"},
                                   {"left_elbow", "left_forearm"},
                                   {"left_hand", "left_forearm"},
                                   {"right_hip", "right_thigh"},
                                   {"right_foot", "right_foot"},
                                   {"right_shoulder", "right_upper_arm"},
                                   {"right_hand", "right_forearm"}}) {
    for (double time = 0.5; time < 14; time += 0.35) {
      const double limit = std::string(name) == "torso" || std::string(name) == "head" ? 0.13 : 0.08;
      EXPECT_LT(distanceOf(joint(made, name, time), body(made, part), time), limit) << name << " " << time;
    }
  }
}

TEST(People, headAndHandAimAtTheTargetTheElbowAboveAndInwards) {
  for (const bool right : {true, false}) {
    for (const double direction : {-90.0, -45.0, 0.0, 20.0, 100.0, 180.0}) {
      const Vector3d target(1 + 2 * std::cos(direction * kDegree), 2 + 2 * std::sin(direction * kDegree), 0.8);
      const MadePerson made = sim::makePerson(pointer(target, right));
      const std::string side = right ? "right_" : "left_";
      for (const double time : {3.0, 4.0, 5.0}) {
        const Vector3d hand = joint(made, side + "hand", time), elbow = joint(made, side + "elbow", time),
                       head = joint(made, "head", time), shoulder = joint(made, side + "shoulder", time);
        const auto of_head = interaction::pointingErrorOf(hand, hand - head, target);
        EXPECT_LT(std::hypot(of_head.theta, of_head.psi), 1e-6) << direction;
        const auto of_elbow = interaction::pointingErrorOf(hand, hand - elbow, target);
        const double inwards = right ? -of_elbow.theta : of_elbow.theta;
        EXPECT_GT(of_elbow.psi, 5 * kDegree) << direction;
        EXPECT_LT(of_elbow.psi, 35 * kDegree) << direction;
        EXPECT_GT(inwards, -5 * kDegree) << direction;
        EXPECT_LT(inwards, 35 * kDegree) << direction;
        EXPECT_NEAR((hand - shoulder).norm(), 0.995 * 0.376 * 1.72, 1e-9);
      }
      // Before and after the act the arm hangs.
      EXPECT_LT(joint(made, side + "hand", 2.3).z(), joint(made, side + "shoulder", 2.3).z() - 0.5);
      EXPECT_LT(joint(made, side + "hand", 5.7).z(), joint(made, side + "shoulder", 5.7).z() - 0.5);
    }
  }
}

TEST(People, turnsToWhatTheArmCannotReach) {
  // The person looks along x; the target is behind it.
  const MadePerson made = sim::makePerson(pointer({-2, 2, 1}, true));
  const Vector3d across = joint(made, "left_shoulder", 4) - joint(made, "right_shoulder", 4);
  const Vector2d ahead(across.y(), -across.x());
  const double aside =
      std::atan2(across.head<2>().normalized().dot(Vector2d(-1, 0)), ahead.normalized().dot(Vector2d(-1, 0)));
  EXPECT_GT(aside, -1.91);
  EXPECT_LT(aside, 0.61);
}

TEST(People, sameSpecSamePerson) {
  const MadePerson a = sim::makePerson(walker()), b = sim::makePerson(walker());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].vertices_in_body, b.bodies[i].vertices_in_body);
    const geometry::Se3 one = *a.bodies[i].track.at(3.33), two = *b.bodies[i].track.at(3.33);
    EXPECT_EQ(one.translation, two.translation);
    EXPECT_EQ(one.rotation.coeffs(), two.rotation.coeffs());
    EXPECT_EQ(a.bodies[i].surfaces[0].material.colour, b.bodies[i].surfaces[0].material.colour);
  }
}

TEST(People, whatNobodyCanDoIsRefusedByName) {
  const auto refused = [](const std::function<void(PersonSpec&)>& change, const std::string& word) {
    PersonSpec spec = walker();
    change(spec);
    try {
      sim::makePerson(spec);
      ADD_FAILURE() << "not refused: " << word;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
      EXPECT_NE(std::string(error.what()).find("'anna'"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused([](PersonSpec& s) { s.height = 3; }, "height");
  refused([](PersonSpec& s) { s.waypoints.clear(); }, "waypoint");
  refused([](PersonSpec& s) { s.waypoints[1].time = 1; }, "comes after");
  refused([](PersonSpec& s) { s.waypoints[1].in_map.x() = 40; }, "m/s");
  refused([](PersonSpec& s) { s.acts.push_back({2, 3, "", {9, 9, 1}, true}); }, "walks");
  refused([](PersonSpec& s) { s.acts.push_back({8.5, 8.4, "", {9, 9, 1}, true}); }, "ends");
  refused([](PersonSpec& s) { s.acts.push_back({8.3, 8.4, "", {4, 3, 2}, true}); }, "nearer");
  refused(
      [](PersonSpec& s) {
        s.acts.push_back({7.9, 8.1, "", {9, 9, 1}, true});
        s.acts.push_back({8.2, 8.4, "", {9, 9, 1}, true});
      },
      "leave");
}

}  // namespace
}  // namespace people_test
