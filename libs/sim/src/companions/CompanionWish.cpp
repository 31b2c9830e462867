#include "CompanionWish.h"

#include <omnimapper/sim_world/Random.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

using Eigen::Vector2d;

namespace {

using Place = CompanionPlan::Place;

constexpr std::uint64_t kStopStream = 0x570, kCrossingStream = 0xc05;
constexpr double kFastestWish = 1.4;                      // speed of a wished place [m/s]
constexpr double kUsualBeside = 0.75;                     // [m]
constexpr double kUsualCrossing = 0.9;                    // largest distance from the path of one who crosses it [m]
constexpr double kWalkingSpeed = 1.2;                     // of one who walks ahead to a stop [m/s]
constexpr double kLeastLead = 2, kMostLead = 4.5;         // length of the walk to a stop, beyond the usual distance [m]
constexpr double kStopChance = 0.75;                      // part of the doors at which one stops
constexpr double kBetweenStops = 3;                       // least distance along the path between two stops [m]
constexpr double kLeastDoorless = 6, kMostDoorless = 10;  // distance after which one stops even without a door [m]
constexpr double kStraight = 0.6;                       // least length of the straight line to a stop, over the path's
constexpr double kDoorReach = 0.6;                      // [m]
constexpr double kLeastBetween = 5, kMostBetween = 12;  // time between two crossings [s]
constexpr double kCrossingSpeed = 1.1;                  // across the path [m/s]
constexpr double kTryAgain = 0.6;                       // time after which one without room tries to cross again [s]

/// The robot's path as a person could walk on it: beyond its ends, it goes on only as far as the floor is free.
class WalkedLine {
 public:
  WalkedLine(const RobotPath& robot, const RobotSpace& space) : robot_(robot) {
    after_ = freeBeyond(space, robot.length(), 1);
    before_ = freeBeyond(space, 0, -1);
  }
  Vector2d at(double travel, double side) const {
    const Vector2d along = robot_.directionAt(std::clamp(travel, 0.0, robot_.length()));
    return robot_.pointAt(std::clamp(travel, -before_, robot_.length() + after_)) +
           side * Vector2d(-along.y(), along.x());
  }

 private:
  double freeBeyond(const RobotSpace& space, double end, double sign) const {
    constexpr double kStep = 0.05, kFarthest = 10;  // [m]
    double free = 0;
    while (free < kFarthest && space.isFree(robot_.pointAt(end + sign * (free + kStep)))) free += kStep;
    return free;
  }

  const RobotPath& robot_;
  double before_, after_;  // free length before the beginning and beyond the end [m]
};

/// A place of the path to which one who leads walks ahead, and where one waits for the robot.
struct WaitingPlace {
  double travel, lead;  // along the path, and the length of the walk to there [m]
};

std::vector<WaitingPlace> stopsOf(const CompanionPlan& plan, const RobotPath& robot,
                                  const std::vector<Vector2d>& doors) {
  Random random(plan.seed, {kStopStream});
  std::vector<double> passings;
  for (const Vector2d& door : doors) {
    const auto of_door = robot.passings(door, kDoorReach);
    passings.insert(passings.end(), of_door.begin(), of_door.end());
  }
  std::sort(passings.begin(), passings.end());
  std::vector<WaitingPlace> stops;
  double last = plan.distance;
  auto door = passings.begin();
  while (last < robot.length()) {
    const double doorless = last + random.uniform(kLeastDoorless, kMostDoorless);
    const bool wants = random.chance(kStopChance);
    double lead = random.uniform(kLeastLead, kMostLead);
    while (door != passings.end() && *door < last + kBetweenStops) ++door;
    const bool is_door = door != passings.end() && *door <= doorless;
    const double travel = is_door ? *door : doorless;
    if (is_door) ++door;
    // Where the path turns back, the robot would meet the person who waits for it.
    const auto isStraight = [&] {
      const double length = lead + plan.distance;
      return (robot.pointAt(travel) - robot.pointAt(travel - length)).norm() >= kStraight * length;
    };
    if (!isStraight()) lead *= 0.5;
    if (wants && travel < robot.length() && isStraight()) stops.push_back({travel, lead});
    last = travel;
  }
  return stops;
}

/// The distance along the path of one who leads the robot and stops now and then, for times in order.
class Leader {
 public:
  Leader(const CompanionPlan& plan, const RobotPath& robot, const std::vector<Vector2d>& doors)
      : distance_(plan.distance), stops_(stopsOf(plan, robot, doors)) {}

  double travelAt(double time, double robot_travel) {
    const double usual = robot_travel + distance_;
    while (next_ < stops_.size() && usual >= stops_[next_].travel) ++next_, begin_ = -1;
    if (next_ == stops_.size()) return usual;
    const WaitingPlace& stop = stops_[next_];
    const double walk_from = stop.travel - stop.lead;
    if (usual < walk_from) return usual;
    if (begin_ < 0) begin_ = time, from_ = usual;
    return std::max(usual, std::min(stop.travel, from_ + kWalkingSpeed * (time - begin_)));
  }

 private:
  double distance_;
  std::vector<WaitingPlace> stops_;
  std::size_t next_ = 0;
  double begin_ = -1, from_ = 0;  // [s], [m] of the walk to the next stop; negative: it has not begun
};

/// The side of the path of one who crosses it, for times in order.
class Crosser {
 public:
  Crosser(const CompanionPlan& plan, const WalkedLine& line, const RobotSpace& space)
      : line_(line),
        space_(space),
        random_(plan.seed, {kCrossingStream}),
        half_(plan.side == 0 ? kUsualCrossing : std::abs(plan.side)) {
    sign_ = random_.chance(0.5) ? 1 : -1;
    next_ = plan.from + random_.uniform(0.5 * kLeastBetween, kLeastBetween);
  }

  double sideAt(double time, double travel) {
    const double lasts = 2 * half_ / kCrossingSpeed;
    if (!is_crossing_ && time >= next_) {
      is_crossing_ = space_.isFree(line_.at(travel, half_), line_.at(travel, -half_));
      if (!is_crossing_) next_ = time + kTryAgain;
    }
    if (!is_crossing_) return sign_ * half_;
    if (time < next_ + lasts) return sign_ * half_ * (1 - 2 * (time - next_) / lasts);
    is_crossing_ = false;
    sign_ = -sign_;
    next_ = time + random_.uniform(kLeastBetween, kMostBetween);
    return sign_ * half_;
  }

 private:
  const WalkedLine& line_;
  const RobotSpace& space_;
  Random random_;
  double half_, sign_, next_;  // [m], 1 to the left of the path or -1, [s]
  bool is_crossing_ = false;
};

// A wished place that jumps, because the path turns back, is followed at a walker's speed.
void limitSpeed(Polyline& places) {
  constexpr double kLongest = kFastestWish * kCompanionStep;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vector2d move = places[i] - places[i - 1];
    if (move.norm() > kLongest) places[i] = places[i - 1] + kLongest * move.normalized();
  }
}

// Rounds changes of speed and direction; a steady motion stays as it is.
void roundChanges(Polyline& places) {
  constexpr int kPasses = 4;
  for (int pass = 0; pass < kPasses; ++pass) {
    const Polyline before = places;
    for (std::size_t i = 1; i + 1 < places.size(); ++i) places[i] = (before[i - 1] + 2 * before[i] + before[i + 1]) / 4;
  }
}

}  // namespace

Polyline wishedPlaces(const CompanionPlan& plan, const RobotPath& robot, const RobotSpace& space,
                      const std::vector<Vector2d>& doors, std::size_t count) {
  const WalkedLine line(robot, space);
  Leader leader(plan, robot, doors);
  Crosser crosser(plan, line, space);
  const double until = plan.until > 0 ? plan.until : robot.end();
  Polyline places;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = std::clamp(static_cast<double>(i) * kCompanionStep, std::min(plan.from, until), until);
    const double travel = robot.travelAt(time);
    switch (plan.place) {
      case Place::ahead:
        places.push_back(line.at(travel + plan.distance, plan.side));
        break;
      case Place::behind:
        places.push_back(line.at(travel - plan.distance, plan.side));
        break;
      case Place::beside:
        places.push_back(line.at(travel, plan.side == 0 ? kUsualBeside : plan.side));
        break;
      case Place::crossing:
        places.push_back(line.at(travel + plan.distance, crosser.sideAt(time, travel + plan.distance)));
        break;
      case Place::stops:
        places.push_back(line.at(leader.travelAt(time, travel), plan.side));
        break;
    }
  }
  limitSpeed(places);
  roundChanges(places);
  return places;
}

}  // namespace omnimapper::sim
