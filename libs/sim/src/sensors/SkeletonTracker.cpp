#include "SkeletonTracker.h"

#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/interaction/PointingError.h>
#include <omnimapper/sim/Pinhole.h>
#include <omnimapper/sim_world/People.h>

#include <algorithm>
#include <cmath>

#include "../camera/ViewTruth.h"
#include "OptionChecks.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector3d;
using mrpt::obs::CObservationSkeleton;

constexpr std::uint64_t kFrameStream = 1, kPersonStream = 2, kActStream = 3, kActFrameStream = 4;
// A joint lies inside its limb, that of the torso in the middle of it: a hit less than this before a joint is on its
// limb.
constexpr double kFlesh = 0.25;  // [m]
constexpr double kGuessed = 3;   // factor on the noise of a guessed joint

constexpr std::array<CObservationSkeleton::TSkeletonJoint CObservationSkeleton::*, kJointCount> kFields{
    &CObservationSkeleton::head,           &CObservationSkeleton::neck,        &CObservationSkeleton::torso,
    &CObservationSkeleton::left_shoulder,  &CObservationSkeleton::left_elbow,  &CObservationSkeleton::left_hand,
    &CObservationSkeleton::left_hip,       &CObservationSkeleton::left_knee,   &CObservationSkeleton::left_foot,
    &CObservationSkeleton::right_shoulder, &CObservationSkeleton::right_elbow, &CObservationSkeleton::right_hand,
    &CObservationSkeleton::right_hip,      &CObservationSkeleton::right_knee,  &CObservationSkeleton::right_foot};

Vector3d gaussianVector(Random& random, double sigma) {
  Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = random.gaussian(sigma);
  return v;
}

// Share by which the arm is raised: 0 while it hangs, 1 from begin to end.
double raisedEvenly(const Person::Pointing& act, double time) {
  const double outside = std::max({act.begin - time, time - act.end, 0.0});
  return std::max(0.0, 1 - outside / kArmRaiseTime);
}

}  // namespace

/// The scene at one time and the sensor's pose in it.
struct SkeletonTracker::View {
  double time;
  geometry::Se3 map_from_optical;
  Scene scene;
};

const base::OptionTable<SkeletonTrackerOptions>& SkeletonTrackerOptions::table() {
  using base::Range;
  using O = SkeletonTrackerOptions;
  static const auto table =
      base::OptionTable<O>()
          .choice(
              "software", &O::software,
              {{"openni", interaction::SkeletonSoftware::openni}, {"ms_sdk", interaction::SkeletonSoftware::ms_sdk}},
              "Skeleton software whose pointing errors, as the thesis measured them, are simulated.")
          .integer("table_target", &O::table_target, {0, 7},
                   "Target of the thesis's Tables 12 and 13 whose pointing errors are simulated. 0 takes those of all "
                   "targets.")
          .number("width_deg", &O::width, {1, 170}, "Horizontal field of view.")
          .number("height_deg", &O::height, {1, 170}, "Vertical field of view.")
          .number("nearest_m", &O::nearest, Range::notNegative(),
                  "Shortest distance at which the torso of a tracked person can be.")
          .number("farthest_m", &O::farthest, Range::positive(),
                  "Longest distance at which the torso of a tracked person can be.")
          .number("bias_sigma_m", &O::bias_sigma, Range::notNegative(),
                  "Standard deviation on each axis of the joint error that stays constant for a person.")
          .number("noise_sigma_m", &O::noise_sigma, Range::notNegative(),
                  "Standard deviation on each axis of the joint error that is drawn anew in each frame.")
          .number("frame_share", &O::frame_share, {0, 1},
                  "Fraction of the variance of the pointing error that is drawn anew in each frame. The rest stays "
                  "constant during a pointing gesture.");
  return table;
}

SkeletonTracker::SkeletonTracker(const SkeletonTrackerOptions& options, const SensorOptions& mount,
                                 const SensorContext& context)
    : Sensor(mount, context), options_of_tracker_(options) {
  requireBelow(context.place(), "nearest_m", options.nearest, "farthest_m", options.farthest);
}

bool SkeletonTracker::isInView(const Vector3d& in_optical) const {
  return in_optical.z() > 0 && std::abs(in_optical.x()) <= in_optical.z() * std::tan(options_of_tracker_.width / 2) &&
         std::abs(in_optical.y()) <= in_optical.z() * std::tan(options_of_tracker_.height / 2);
}

bool SkeletonTracker::isHidden(const View& view, const Vector3d& in_map) const {
  const Vector3d& eye = view.map_from_optical.translation;
  const double distance = (in_map - eye).norm();
  if (distance <= kFlesh) return false;
  return view.scene.cast({eye, (in_map - eye) / distance, 0, distance - kFlesh}).isHit();
}

Skeleton SkeletonTracker::trueSkeleton(int person, double time) const {
  Skeleton in_map;
  for (const Person::Joint& joint : context().world->people[person].joints) {
    const auto place = std::find(kJointNames.begin(), kJointNames.end(), joint.name);
    if (place != kJointNames.end()) in_map.places[place - kJointNames.begin()] = joint.in_map.at(time)->translation;
  }
  return in_map;
}

int SkeletonTracker::nearestPerson(const View& view) const {
  const geometry::Se3 optical_from_map = geometry::inverse(view.map_from_optical);
  int nearest = -1;
  double least = options_of_tracker_.farthest;
  for (std::size_t i = 0; i < context().world->people.size(); ++i) {
    const Skeleton in_map = trueSkeleton(static_cast<int>(i), view.time);
    const double distance = (optical_from_map * in_map[Joint::torso]).norm();
    if (distance < options_of_tracker_.nearest || distance > least) continue;
    const auto isSeen = [&](Joint joint) {
      return isInView(optical_from_map * in_map[joint]) && !isHidden(view, in_map[joint]);
    };
    if (!isSeen(Joint::head) && !isSeen(Joint::torso)) continue;
    nearest = static_cast<int>(i);
    least = distance;
  }
  return nearest;
}

void SkeletonTracker::blur(const View& view, int k, int person, Skeleton& in_map, std::vector<bool>& guessed) const {
  const geometry::Se3 optical_from_map = geometry::inverse(view.map_from_optical);
  Random of_person = randomOf(person, kPersonStream), of_frame = randomOf(k, kFrameStream);
  guessed.assign(kJointCount, false);
  for (int i = 0; i < kJointCount; ++i) {
    Vector3d& place = in_map.places[i];
    guessed[i] = !isInView(optical_from_map * place) || isHidden(view, place);
    const double scale = guessed[i] ? kGuessed : 1;
    place += gaussianVector(of_person, options_of_tracker_.bias_sigma);
    place += gaussianVector(of_frame, scale * options_of_tracker_.noise_sigma);
  }
}

void SkeletonTracker::missTarget(const View& view, int k, int person, Skeleton& in_map) const {
  const auto& acts = context().world->people[person].pointing;
  const interaction::PointingRow row =
      interaction::thesisRow(options_of_tracker_.software, options_of_tracker_.table_target);
  const double frame_part = std::sqrt(options_of_tracker_.frame_share),
               act_part = std::sqrt(1 - options_of_tracker_.frame_share);
  Random of_frame = randomOf(k, kActFrameStream);
  for (std::size_t i = 0; i < acts.size(); ++i) {
    const Person::Pointing& act = acts[i];
    const double share = raisedEvenly(act, view.time);
    if (share <= 0) continue;
    constexpr int kMostActs = 1 << 12;  // largest number of one person, for numbers that are unique among all people
    Random of_act = randomOf(person * kMostActs + static_cast<int>(i), kActStream);
    const auto draw = [&](const interaction::AngleError& error) {
      const double of_this_act = of_act.gaussian(), of_this_frame = of_frame.gaussian();
      return error.mean + error.sigma * (act_part * of_this_act + frame_part * of_this_frame);
    };
    const Vector3d hand = in_map[jointOf(act.right_arm, Limb::hand)];
    const auto move = [&](Vector3d& joint, const interaction::RayErrors& errors) {
      const double side = act.right_arm ? 1 : -1, theta = draw(errors.theta);
      const interaction::PointingError error{side * theta, draw(errors.psi)};
      const Vector3d there =
          hand - (hand - joint).norm() * interaction::directionWithError(hand, act.target_in_map, error);
      joint += share * (there - joint);
    };
    move(in_map[jointOf(act.right_arm, Limb::elbow)], row.elbow_hand);
    move(in_map[Joint::head], row.head_hand);
  }
}

std::string SkeletonTracker::truthOf(const View& view, int person, const Skeleton& in_map) const {
  const auto list = [](const Vector3d& p) { return nlohmann::json{p.x(), p.y(), p.z()}; };
  const Person& who = context().world->people[person];
  nlohmann::json truth{
      {"time_s", view.time}, {"person", who.name}, {"map_from_sensor", poseJson(view.map_from_optical)}};
  for (int i = 0; i < kJointCount; ++i) truth["joints_in_map"][kJointNames[i]] = list(in_map.places[i]);
  for (const Person::Pointing& act : who.pointing) {
    if (view.time < act.begin || view.time > act.end) continue;
    truth["pointing"] = {{"arm", act.right_arm ? "right" : "left"},
                         {"target", act.target},
                         {"target_in_map", list(act.target_in_map)},
                         {"begin_s", act.begin},
                         {"end_s", act.end}};
  }
  return truth.dump();
}

Measurement SkeletonTracker::measure(int k) const {
  const double time = timeOf(k);
  const View view{time, mapFromSensor(time) * geometry::sensorFromOptical(), context().scenes->at(time)};
  const int person = nearestPerson(view);
  if (person < 0) return {};
  const Skeleton true_in_map = trueSkeleton(person, time);
  Skeleton in_map = true_in_map;
  std::vector<bool> guessed;
  blur(view, k, person, in_map, guessed);
  missTarget(view, k, person, in_map);

  auto observation = CObservationSkeleton::Create();
  stamp(*observation, k);
  observation->sensorPose = geometry::toMrpt(baseFromSensor() * geometry::sensorFromOptical());
  const geometry::Se3 optical_from_map = geometry::inverse(view.map_from_optical);
  for (int i = 0; i < kJointCount; ++i) {
    const Vector3d in_optical = optical_from_map * in_map.places[i];
    auto& joint = *observation.*kFields[i];
    joint.x = in_optical.x();
    joint.y = in_optical.y();
    joint.z = in_optical.z();
    joint.conf = guessed[i] ? 0.5 : 1;
  }
  return {observation, truthOf(view, person, true_in_map), {}};
}

}  // namespace omnimapper::sim
