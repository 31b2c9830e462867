#include <omnimapper/base/Error.h>
#include <omnimapper/sim/Drive.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>

#include "Carrier.h"
#include "DrivenMotion.h"
#include "Tour.h"

namespace omnimapper::sim {

const base::OptionTable<DriveOptions>& DriveOptions::table() {
  using base::Range;
  using Options = DriveOptions;
  const Range positive = Range::positive(), zero_or_more = Range::notNegative();
  static const auto table =
      base::OptionTable<Options>()
          .choice("mode", &Options::mode,
                  {{"tour", DriveMode::tour}, {"waypoints", DriveMode::waypoints}, {"still", DriveMode::still}},
                  "Motion of the robot: a tour through all rooms so that everything is seen, a drive along waypoints, "
                  "or none.")
          .text("waypoints", &Options::waypoints,
                "Waypoints separated by commas: names of rooms, or places 'x y' or 'x y heading' in metres and "
                "degrees.")
          .text("start", &Options::start,
                "Start of the drive: the name of a room, or a place 'x y' or 'x y heading' in metres and degrees. "
                "Empty means the first place of the route.")
          .list("rooms", &Options::rooms, "Names of the rooms of a tour. Empty means all rooms that can be reached.")
          .number("radius_m", &Options::radius, positive, "Radius of the robot about the origin of its base frame.")
          .number("max_speed_m_s", &Options::max_speed, {0.01, 100}, "Largest speed of the robot.")
          .number("max_turn_per_s_deg", &Options::max_turn, positive, "Largest turn rate of the robot.")
          .number("max_acceleration_m_s2", &Options::max_acceleration, positive,
                  "Largest acceleration of the robot along its path, and also the largest across it.")
          .number("max_turn_acceleration_per_s2_deg", &Options::max_turn_acceleration, positive,
                  "Largest angular acceleration of the robot.")
          .number("pause_s", &Options::pause, {0, 3600},
                  "Time that the robot stays at each waypoint or place of a tour. With 0 it drives past waypoints "
                  "without a heading.")
          .number("look_around_deg", &Options::look_around, zero_or_more,
                  "Angle that the robot turns at each place of a tour.")
          .number("reach_m", &Options::reach, {0.5, 100},
                  "A tour counts as seen what was within this distance of the robot and was not hidden.")
          .integer("repeat", &Options::repeat, {1, 10000}, "Number of times that the robot drives its route.")
          .number("duration_s", &Options::duration, {0, kLongestRun},
                  "Duration of the drive, which is repeated until then and cut off there. 0 means as long as the drive "
                  "takes.")
          .flag("handheld", &Options::handheld,
                "The sensors are carried at eye height by a walking person instead of driven by the robot.")
          .number("eye_height_m", &Options::eye_height, positive,
                  "Height above the floor at which a handheld base is carried.")
          .number("sway_m", &Options::sway, zero_or_more,
                  "Amplitude of the walking person's sway in position, if handheld.")
          .number("sway_deg", &Options::sway_turn, zero_or_more,
                  "Amplitude of the walking person's sway in angle, if handheld.")
          .number("gaze_deg", &Options::gaze, zero_or_more,
                  "Amplitude by which the gaze wanders to the sides, if handheld.")
          .number("shake_m", &Options::shake, zero_or_more,
                  "Amplitude of the shake of the person's hands in position, if handheld.")
          .number("shake_deg", &Options::shake_turn, zero_or_more,
                  "Amplitude of the shake of the person's hands in angle, if handheld.");
  return table;
}

namespace {

std::string format(const Eigen::Vector2d& place) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", place.x(), place.y());
  return text;
}

/// Reads places of section [robot] and refuses those where the robot cannot be.
class Places {
 public:
  Places(const base::Config& config, const World& world, const RobotSpace& plan, double radius)
      : file_(config.file()), world_(world), plan_(plan), radius_(radius) {}

  /// Reads a list of places: at least one, unless the text is empty.
  std::vector<Stop> read(const std::string& key, const std::string& text) const {
    std::vector<Stop> stops;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t comma = std::min(text.find(',', begin), text.size());
      const std::size_t first = text.find_first_not_of(" \t", begin);
      const std::size_t last = text.find_last_not_of(" \t", comma - 1);
      if (first < comma && comma > 0) stops.push_back(readOne(key, text.substr(first, last + 1 - first)));
      begin = comma + 1;
    }
    if (stops.empty() && !text.empty()) fail(base::ExitCode::out_of_range, key, text, "names no place");
    return stops;
  }

  /// Reads one place; none if the text is empty.
  std::optional<Stop> readSingle(const std::string& key, const std::string& text) const {
    const auto stops = read(key, text);
    if (stops.empty()) return {};
    if (stops.size() > 1) fail(base::ExitCode::out_of_range, key, text, "names more than one place");
    return stops.front();
  }

  int room(const std::string& key, const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < world_.rooms.size(); ++i) {
      names.push_back(world_.rooms[i].name);
      if (names.back() == name) return static_cast<int>(i);
    }
    const std::string near = base::nearestName(name, names);
    fail(base::ExitCode::out_of_range, key, name,
         "there is no room of that name, nor is it a place 'x y' or 'x y heading'" +
             (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }

  void needReach(const std::string& key, const Stop& from, const Stop& to) const {
    if (plan_.canReach(from.in_map, to.in_map)) return;
    refuse(key, to, "no path leads there from " + format(from.in_map) + " that is wide enough for radius_m",
           plan_.nearestFree(to.in_map, from.in_map));
  }

  [[noreturn]] void fail(base::ExitCode code, const std::string& key, const std::string& value,
                         const std::string& what) const {
    throw base::Error(code, file_ + ": [robot] " + key + ": " + value + ": " + what);
  }

 private:
  Stop readOne(const std::string& key, const std::string& text) const {
    std::vector<double> numbers;
    std::istringstream words(text);
    bool is_place = true;
    for (std::string word; is_place && words >> word;) {
      numbers.push_back(0);
      is_place = !base::option_text::parse(word, {}, numbers.back());
    }
    Stop stop{{}, {}, text};
    if (is_place && (numbers.size() == 2 || numbers.size() == 3)) {
      stop.in_map = {numbers[0], numbers[1]};
      if (numbers.size() == 3) stop.yaw = numbers[2] * base::option_text::kRadiansPerDegree;
    } else {
      const Room& found = world_.rooms[room(key, text)];
      const auto place = goodPlaceIn(found, plan_);
      if (!place) fail(base::ExitCode::out_of_range, key, text, "there is no free place in that room for radius_m");
      stop.in_map = *place;
    }
    if (plan_.isFree(stop.in_map)) return stop;
    char radius[32];
    std::snprintf(radius, sizeof radius, "%.2f", radius_);
    refuse(key, stop, std::string("it is in a wall or another obstacle, or nearer to one than radius_m = ") + radius,
           plan_.nearestFree(stop.in_map));
  }

  [[noreturn]] void refuse(const std::string& key, const Stop& stop, const std::string& why,
                           const std::optional<Eigen::Vector2d>& nearest) const {
    const std::string place = format(stop.in_map);
    fail(base::ExitCode::out_of_range, key, stop.name,
         "the robot cannot be at " + place + ": " + why +
             (nearest ? "; the nearest free place is " + format(*nearest) : "; the world has no free place"));
  }

  std::string file_;
  const World& world_;
  const RobotSpace& plan_;
  double radius_;
};

/// Composes the motion of a drive.
class Planner {
 public:
  Planner(const DriveOptions& options, const base::Config& config, const World& world)
      : options_(options), world_(world), plan_(world, options.radius), places_(config, world, plan_, options.radius) {}

  DrivenMotion plan() const {
    auto start = places_.readSingle("start", options_.start);
    std::vector<Stop> stops;
    if (options_.mode == DriveMode::waypoints) stops = waypoints(start);
    if (options_.mode == DriveMode::tour) stops = tour(start);
    if (options_.mode == DriveMode::still) stops = still(start);
    if (!start) start = stops.front();
    const double yaw = start->yaw ? *start->yaw : firstHeading(*start, stops);
    DrivenMotion motion(
        {start->in_map.x(), start->in_map.y(), yaw},
        {options_.max_speed, options_.max_turn, options_.max_acceleration, options_.max_turn_acceleration});
    goAlong(motion, stops);
    return motion;
  }

 private:
  std::vector<Stop> waypoints(const std::optional<Stop>& start) const {
    const auto stops = places_.read("waypoints", options_.waypoints);
    if (stops.empty()) places_.fail(base::ExitCode::out_of_range, "waypoints", "none", "mode = waypoints needs some");
    for (const Stop& stop : stops) places_.needReach("waypoints", start ? *start : stops.front(), stop);
    return stops;
  }

  std::vector<Stop> tour(const std::optional<Stop>& start) const {
    std::vector<int> rooms;
    for (const std::string& name : options_.rooms) rooms.push_back(places_.room("rooms", name));
    for (std::size_t i = 0; options_.rooms.empty() && i < world_.rooms.size(); ++i)
      rooms.push_back(static_cast<int>(i));
    const auto at = start ? std::make_optional(start->in_map) : std::nullopt;
    const auto stops = planTour(world_, rooms, plan_, at, options_.reach);
    if (stops.empty())
      places_.fail(base::ExitCode::out_of_range, "mode", "tour", "no room has a free place that can be reached");
    for (const std::string& name : options_.rooms) {
      const bool seen = std::any_of(stops.begin(), stops.end(), [&](const Stop& stop) { return stop.name == name; });
      if (!seen)
        places_.fail(base::ExitCode::out_of_range, "rooms", name,
                     "no path that is wide enough for radius_m leads into that room");
    }
    return stops;
  }

  std::vector<Stop> still(const std::optional<Stop>& start) const {
    if (start) return {*start};
    if (const auto place = places_.readSingle("waypoints", options_.waypoints)) return {*place};
    for (const Room& room : world_.rooms) {
      if (const auto place = goodPlaceIn(room, plan_)) return {{*place, {}, room.name}};
    }
    places_.fail(base::ExitCode::out_of_range, "mode", "still", "no room has a free place: give a start");
  }

  double firstHeading(const Stop& start, const std::vector<Stop>& stops) const {
    for (const Stop& stop : stops) {
      if ((stop.in_map - start.in_map).norm() < RobotSpace::kCell) continue;
      const Eigen::Vector2d first = (*plan_.findPath(start.in_map, stop.in_map))[1] - start.in_map;
      return std::atan2(first.y(), first.x());
    }
    return 0;
  }

  bool isStop(const Stop& stop) const {
    return stop.yaw || options_.pause > 0 || (options_.mode == DriveMode::tour && options_.look_around > 0);
  }

  void goAlong(DrivenMotion& motion, const std::vector<Stop>& stops) const {
    std::map<std::pair<std::size_t, std::size_t>, Polyline> known;  // paths from stop to stop
    Polyline path{motion.end().translation()};
    std::optional<std::size_t> from;
    // The rest of the path takes at least its length at full speed; rounded corners make it up to 30 % shorter.
    const auto isDone = [&] {
      double length = 0;
      for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
      return options_.duration > 0 && motion.duration() + 0.7 * length / options_.max_speed >= options_.duration;
    };
    const auto flush = [&] {
      motion.follow(path, plan_);
      path.assign(1, motion.end().translation());
    };
    for (int round = 0; options_.duration > 0 ? !isDone() : round < options_.repeat; ++round) {
      const double before = motion.duration();
      const std::size_t corners = path.size();
      for (std::size_t i = 0; i < stops.size() && !isDone(); ++i) {
        Polyline leg =
            from && known.count({*from, i}) ? known[{*from, i}] : *plan_.findPath(path.back(), stops[i].in_map);
        path.insert(path.end(), leg.begin() + 1, leg.end());
        if (from) known[{*from, i}] = std::move(leg);
        from = i;
        if (!isStop(stops[i])) continue;
        flush();
        if (stops[i].yaw) motion.turnTo(*stops[i].yaw);
        if (options_.mode == DriveMode::tour) motion.turn(options_.look_around);
        motion.wait(options_.pause);
        refuseTooLong(motion);
      }
      const bool moved = motion.duration() > before || path.size() > corners;
      if (options_.duration > 0 && (!moved || stops.size() < 2)) {
        flush();
        motion.wait(options_.duration - motion.duration());
      }
    }
    flush();
    refuseTooLong(motion);
  }

  // Where duration_s cuts a drive off, the rest of it does not count.
  void refuseTooLong(const DrivenMotion& motion) const {
    if (options_.duration > 0 || motion.duration() <= kLongestRun) return;
    places_.fail(base::ExitCode::out_of_range, "duration_s", "0",
                 "the whole drive takes more than " + base::option_text::format(kLongestRun) +
                     " s: set duration_s, make it shorter or the robot faster");
  }

  const DriveOptions& options_;
  const World& world_;
  RobotSpace plan_;
  Places places_;
};

}  // namespace

Track planDrive(const base::Config& config, const World& world) {
  if (world.rooms.empty()) {
    throw base::Error(base::ExitCode::out_of_range,
                      config.file() +
                          ": [world] has no rooms: give it a generator, or name their sections in rooms; "
                          "INI files of the mapper describe no world");
  }
  const auto options = config.section("robot").read<DriveOptions>();
  const DrivenMotion motion = Planner(options, config, world).plan();
  constexpr double kStep = 1.0 / kDriveRate;
  auto poses = poseOnGround(motion.sampled(kStep, options.duration > 0 ? options.duration : motion.duration()), world,
                            options.radius);
  if (options.handheld) carryByHand(poses, options, world.seed);
  std::vector<Track::Place> places;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double time = static_cast<double>(i) * kStep;
    if (options.duration > 0 && time > options.duration + 0.5 * kStep) break;
    places.push_back({time, poses[i]});
  }
  return {Track::Kind::motion, std::move(places)};
}

std::vector<Visit> visitsOf(const World& world, const Track& map_from_base) {
  std::vector<Visit> visits;
  for (const Track::Place& place : map_from_base.places()) {
    const Eigen::Vector2d point = place.map_from_body->translation.head<2>();
    const auto isIn = [&](int room) { return contains(world.rooms[room].outline, point); };
    if (visits.empty() || !isIn(visits.back().room)) {
      for (int room = 0; room < static_cast<int>(world.rooms.size()); ++room) {
        if (!isIn(room)) continue;
        visits.push_back({room, place.time, place.time});
        break;
      }
    }
    if (!visits.empty()) visits.back().leave = place.time;
  }
  return visits;
}

}  // namespace omnimapper::sim
