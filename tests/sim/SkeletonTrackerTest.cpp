#include <gtest/gtest.h>
#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/interaction/PointingError.h>
#include <omnimapper/sim_world/People.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "SensorRun.h"
#include "SmallWorlds.h"

namespace skeleton_tracker_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;
using mrpt::obs::CObservationSkeleton;
using small_worlds::at;

constexpr double kDegree = M_PI / 180;

void add(sim::World& world, const sim::PersonSpec& spec) {
  auto made = sim::makePerson(spec);
  for (auto& body : made.bodies) world.bodies.push_back(std::move(body));
  world.people.push_back(std::move(made.person));
}

sim::PersonSpec standing(const std::string& name, double x, double y) {
  sim::PersonSpec spec;
  spec.name = name;
  spec.yaw = M_PI;
  spec.waypoints = {{{x, y}, 0}};
  return spec;
}

// A person two metres before the sensor who points at another target every four seconds.
sim::World pointing(int acts, bool right_arm) {
  auto spec = standing("anna", 2, 0);
  sim::Random random(5, {});
  for (int i = 0; i < acts; ++i) {
    // Targets are before and beside the person, who faces the sensor, as the seven targets of the thesis.
    const double azimuth = M_PI + (right_arm ? -1 : 1) * random.uniform(-0.3, 1.5);
    const Vector3d target(2 + 2 * std::cos(azimuth), 2 * std::sin(azimuth), random.uniform(0.5, 1.8));
    spec.acts.push_back({4.0 * i + 1.0, 4.0 * i + 2.5, "cup", target, right_arm});
  }
  sim::World world;
  add(world, spec);
  return world;
}

Vector3d inMap(const CObservationSkeleton& skeleton, const CObservationSkeleton::TSkeletonJoint& joint,
               const geometry::Se3& map_from_base) {
  return map_from_base * geometry::fromMrpt(skeleton.sensorPose) * Vector3d(joint.x, joint.y, joint.z);
}

struct Moments {
  double sum = 0, squares = 0;
  int count = 0;
  void add(double x) { sum += x, squares += x * x, ++count; }
  double mean() const { return sum / count; }
  double sigma() const { return std::sqrt(squares / count - mean() * mean()); }
};

struct Row {
  const char* keys;
  double elbow[4], head[4];  // mu and sigma of theta, then of psi [deg]
};

// Copied by hand from Tables 12 and 13.
const Row kRows[] = {{"software = ms_sdk", {-11.3, 7.7, 8.5, 4.5}, {-1.1, 8.5, -10.7, 4.8}},
                     {"software = openni", {-11.2, 7.6, 9.6, 6.3}, {-2.4, 9.6, -5.3, 6.4}},
                     {"software = ms_sdk\ntable_target = 7", {-20.8, 3.7, 5.7, 3.4}, {-8.0, 5.5, -15.6, 2.9}},
                     {"software = openni\ntable_target = 4", {-4.0, 4.7, 12.4, 2.5}, {-3.2, 2.5, 1.45, 4.8}}};

// With one frame of each of 400 acts, means are within 4 sigma / sqrt(400) and sigmas within 4 sigma / sqrt(800).
TEST(SkeletonTracker, raysMissTheirTargetsAsInTheThesisTables) {
  const int acts = 400;
  for (const bool right : {true, false}) {
    const sim::World world = pointing(acts, right);
    for (const Row& row : kRows) {
      const SensorRun run(world, sim::Track(at(0, 0, 1.2)),
                          std::string("class = SkeletonTracker\nrate_hz = 0.25\nfirst_s = 2\n") + row.keys, 4.0 * acts);
      Moments found[4];
      for (int k = 0; k < acts; ++k) {
        const auto skeleton = run.measure<CObservationSkeleton>(k);
        ASSERT_TRUE(skeleton) << k;
        const Vector3d target = run.world().people[0].pointing[k].target_in_map;
        const auto place = [&](const auto& joint) { return inMap(*skeleton, joint, at(0, 0, 1.2)); };
        const Vector3d hand = place(right ? skeleton->right_hand : skeleton->left_hand),
                       elbow = place(right ? skeleton->right_elbow : skeleton->left_elbow),
                       head = place(skeleton->head);
        const auto of_elbow = interaction::pointingErrorOf(hand, hand - elbow, target),
                   of_head = interaction::pointingErrorOf(hand, hand - head, target);
        const double side = right ? 1 : -1;
        found[0].add(side * of_elbow.theta / kDegree), found[1].add(of_elbow.psi / kDegree);
        found[2].add(side * of_head.theta / kDegree), found[3].add(of_head.psi / kDegree);
      }
      for (int i = 0; i < 4; ++i) {
        const double* wanted = (i < 2 ? row.elbow : row.head) + 2 * (i % 2);
        EXPECT_NEAR(found[i].mean(), wanted[0], 4 * wanted[1] / std::sqrt(acts)) << row.keys << " " << i;
        EXPECT_NEAR(found[i].sigma(), wanted[1], 4 * wanted[1] / std::sqrt(2 * acts)) << row.keys << " " << i;
      }
    }
  }
}

// The table's sigma is that of all acts; within one act a ray varies by frame_share of the variance.
TEST(SkeletonTracker, withinAnActRaysAreClustered) {
  const SensorRun run(pointing(1, true), sim::Track(at(0, 0, 1.2)),
                      "class = SkeletonTracker\nrate_hz = 200\nfirst_s = 1\nframe_share = 0.1", 2.5);
  const Vector3d target = run.world().people[0].pointing[0].target_in_map;
  Moments theta;
  for (int k = 0; k < 300; ++k) {
    const auto skeleton = run.measure<CObservationSkeleton>(k);
    const auto place = [&](const auto& joint) { return inMap(*skeleton, joint, at(0, 0, 1.2)); };
    const Vector3d hand = place(skeleton->right_hand);
    theta.add(interaction::pointingErrorOf(hand, hand - place(skeleton->right_elbow), target).theta / kDegree);
  }
  EXPECT_NEAR(theta.sigma(), 7.6 * std::sqrt(0.1), 0.4);
}

TEST(SkeletonTracker, jointsAreInTheOpticalFrameInMetres) {
  sim::World world;
  add(world, standing("anna", 2, 0));
  const SensorRun run(std::move(world), sim::Track(at(0, 0)),
                      "class = SkeletonTracker\nz_m = 1.2\nbias_sigma_m = 0\nnoise_sigma_m = 0");
  const auto skeleton = run.measure<CObservationSkeleton>(0);
  ASSERT_TRUE(skeleton);
  EXPECT_NEAR(skeleton->head.x, 0, 1e-9);
  EXPECT_NEAR(skeleton->head.y, 1.2 - 0.93 * 1.72, 1e-9);
  EXPECT_NEAR(skeleton->head.z, 2, 1e-9);
  // The person faces the sensor, so its left is on the sensor's right.
  EXPECT_NEAR(skeleton->left_shoulder.x, 0.115 * 1.72, 1e-9);
  EXPECT_EQ(skeleton->head.conf, 1);
  EXPECT_EQ(skeleton->timestamp, base::stampFromUnix(1.6e9));
  const auto truth = nlohmann::json::parse(run.truth(0));
  EXPECT_EQ(truth["person"], "anna");
  EXPECT_NEAR(truth["joints_in_map"]["head"][2].get<double>(), 0.93 * 1.72, 1e-9);
  EXPECT_EQ(truth.count("pointing"), 0u);
}

TEST(SkeletonTracker, truthNamesTheTargetWhileThePersonPoints) {
  const SensorRun run(pointing(2, false), sim::Track(at(0, 0, 1.2)), "class = SkeletonTracker\nrate_hz = 2", 8);
  const auto truth = nlohmann::json::parse(run.truth(3));
  EXPECT_EQ(truth["pointing"]["arm"], "left");
  EXPECT_EQ(truth["pointing"]["target"], "cup");
  EXPECT_EQ(truth["pointing"]["target_in_map"][0], run.world().people[0].pointing[0].target_in_map.x());
  EXPECT_EQ(nlohmann::json::parse(run.truth(6)).count("pointing"), 0u);
}

TEST(SkeletonTracker, noiseAndBiasAreAsAsked) {
  const int people = 60, frames = 60;
  Moments bias, noise;
  for (int i = 0; i < people; ++i) {
    sim::World world;
    add(world, standing("anna", 2, 0));
    const SensorRun run(std::move(world), sim::Track(at(0, 0, 1.2)),
                        "class = SkeletonTracker\nbias_sigma_m = 0.03\nnoise_sigma_m = 0.01", 6, i);
    Moments x;
    for (int k = 0; k < frames; ++k) x.add(run.measure<CObservationSkeleton>(k)->neck.x);
    bias.add(x.mean());
    noise.add(x.sigma() * x.sigma());
  }
  EXPECT_NEAR(bias.sigma(), 0.03, 4 * 0.03 / std::sqrt(2 * people));
  EXPECT_NEAR(std::sqrt(noise.mean()), 0.01, 0.001);
}

TEST(SkeletonTracker, onlyTheNearestWhoCanBeSeenIsReported) {
  const auto reportedPerson = [](const std::vector<sim::PersonSpec>& people, double wall_x) -> std::string {
    sim::World world;
    for (const auto& spec : people) add(world, spec);
    if (wall_x > 0) {
      small_worlds::addQuad(world, "wall", sim::SurfaceKind::wall, {wall_x, -0.5, 0}, {0, 1, 0}, {0, 0, 2.5});
    }
    const SensorRun run(std::move(world), sim::Track(at(0, 0, 1.2)), "class = SkeletonTracker");
    if (!run.measure<CObservationSkeleton>(0)) return "nobody";
    return nlohmann::json::parse(run.truth(0))["person"];
  };
  EXPECT_EQ(reportedPerson({standing("far", 3, 0.8), standing("near", 2, -0.5)}, 0), "near");
  EXPECT_EQ(reportedPerson({standing("far", 3, 0)}, 1.5), "nobody");
  EXPECT_EQ(reportedPerson({standing("far", 3, 1.5), standing("hidden", 2, 0)}, 1.5), "far");
  EXPECT_EQ(reportedPerson({standing("too_far", 4.2, 0)}, 0), "nobody");
  EXPECT_EQ(reportedPerson({standing("too_near", 0.6, 0)}, 0), "nobody");
  EXPECT_EQ(reportedPerson({standing("behind", -2, 0)}, 0), "nobody");
  EXPECT_EQ(reportedPerson({standing("beside", 1, 2)}, 0), "nobody");
}

TEST(SkeletonTracker, hiddenJointsAreGuessed) {
  sim::World world;
  add(world, standing("anna", 2.5, 0));
  // A counter hides the legs.
  small_worlds::addQuad(world, "counter", sim::SurfaceKind::counter, {1.5, -1, 0}, {0, 2, 0}, {0, 0, 0.9});
  const SensorRun run(std::move(world), sim::Track(at(0, 0, 1.2)), "class = SkeletonTracker");
  const auto skeleton = run.measure<CObservationSkeleton>(0);
  ASSERT_TRUE(skeleton);
  EXPECT_EQ(skeleton->head.conf, 1);
  EXPECT_EQ(skeleton->left_shoulder.conf, 1);
  EXPECT_EQ(skeleton->left_knee.conf, 0.5);
  EXPECT_EQ(skeleton->right_foot.conf, 0.5);
}

TEST(SkeletonTracker, anUnknownTargetOfTheTablesIsRefused) {
  EXPECT_THROW(SensorRun({}, sim::Track(at(0, 0)), "class = SkeletonTracker\ntable_target = 8"), base::Error);
  EXPECT_THROW(SensorRun({}, sim::Track(at(0, 0)), "class = SkeletonTracker\nsoftware = kinect"), base::Error);
}

}  // namespace
}  // namespace skeleton_tracker_test
