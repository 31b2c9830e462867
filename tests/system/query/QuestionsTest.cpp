// Forty questions about three simulated places, of which the simulator knows the answers, and ten without an answer.
#include <omnimapper/building/Storey.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "SignedOffice.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::sourceFile;
namespace building = omnimapper::building;
using Eigen::Vector2d;

constexpr int kNoAnswer = 20;

/// A simulated place that was mapped by a laser, and the true rooms in the frame of its map.
class MappedPlace {
 public:
  MappedPlace(const std::string& ini, const Texts& settings, bool has_signs) : log_(*scratch_ / "log") {
    Texts command{
        omnimapper::testing::ownProgram("omnimapper-simulate"), "-q", "-i", sourceFile("rawlogs/" + ini), "-o", log_};
    for (const auto& setting : settings) command.insert(command.end(), {std::string("--set"), setting});
    EXPECT_TRUE(endedWith(ExitCode::ok, omnimapper::testing::runProgram(command)));
    const std::string name = ini.substr(0, ini.find('.'));
    Texts mapping{"-q",
                  "-i",
                  sourceFile(has_signs ? "ini/signs.ini" : "ini/laser2d.ini"),
                  "--set",
                  "mapper.output_plugins=trajectory,grid,map",
                  "-r",
                  log_ + "/" + name + ".rawlog",
                  "-o",
                  map()};
    if (has_signs) {
      writeObservedSigns(log_);
      mapping.insert(mapping.end(), {std::string("-r"), log_ + "/signs.rawlog", std::string("--set"),
                                     std::string("perception.extractors=laser_points,laser_lines")});
    }
    EXPECT_TRUE(endedWith(ExitCode::ok, graphslam(mapping)));
    map_from_world_ = omnimapper::geometry::inverse(worldFromMap(log_, map()));
    truth_ = json::parse(readFile(log_ + "/landmarks.json"));
  }
  std::string map() const { return *scratch_ / "map"; }
  Ended ask(const std::string& question) const {
    Texts command{omnimapper::testing::ownProgram("omnimapper-query"), map()};
    for (std::size_t begin = 0; begin < question.size();) {
      const std::size_t end = std::min(question.find(' ', begin), question.size());
      command.push_back(question.substr(begin, end - begin));
      begin = end + 1;
    }
    command.emplace_back("--json");
    return omnimapper::testing::runProgram(command);
  }
  /// The answer; null if there is none.
  json answer(const std::string& question) const {
    const auto ended = ask(question);
    return ended.code == 0 ? json::parse(ended.out) : json();
  }
  Vector2d inMap(const Vector2d& in_world) const {
    return (map_from_world_ * Vector3d(in_world.x(), in_world.y(), 0)).head<2>();
  }
  /// The true room of that name, its outline in the map.
  building::Room trueRoom(const std::string& name) const {
    building::Room room;
    for (const auto& each : truth_["rooms"]) {
      if (each["name"] != name) continue;
      for (const auto& corner : each["outline"])
        room.outline.push_back(inMap(Vector2d(corner[0].get<double>(), corner[1].get<double>())));
    }
    EXPECT_FALSE(room.outline.empty()) << name;
    return room;
  }
  Vector2d middleOf(const std::string& room) const {
    Vector2d sum(0, 0);
    const auto outline = trueRoom(room).outline;
    for (const auto& corner : outline) sum += corner / static_cast<double>(outline.size());
    return sum;
  }
  /// "3.25 -1.00"
  static std::string text(const Vector2d& point, const char* between = " ") {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.2f%s%.2f", point.x(), between, point.y());
    return buffer;
  }
  const json& truth() const { return truth_; }

 private:
  std::unique_ptr<ScratchFolder> scratch_ = std::make_unique<ScratchFolder>();
  std::string log_;
  Se3 map_from_world_;
  json truth_;
};

class Questions : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Texts fast{"simulation.sensors=laser,odometry", "laser.rate_hz=4", "robot.max_speed_m_s=1"};
    const auto with = [&](Texts more) -> Texts {
      more.insert(more.end(), fast.begin(), fast.end());
      return more;
    };
    home_ = std::make_unique<MappedPlace>("home.ini", with(Texts{"robot.repeat=1", "world.move_time_s=-1"}), false);
    office_ = std::make_unique<MappedPlace>("signs_office.ini", with(Texts{"simulation.duration_s=115"}), true);
    laboratory_ = std::make_unique<MappedPlace>("laboratory.ini", with(Texts{}), false);
  }
  static void TearDownTestSuite() {
    home_.reset();
    office_.reset();
    laboratory_.reset();
  }
  static void expect(bool is_right, const std::string& question) {
    ++asked_;
    if (is_right) ++right_;
    EXPECT_TRUE(is_right) << question;
  }
  /// The room at the middle of a true room has its centre in it.
  static void whereAmI(const MappedPlace& place, const std::string& room) {
    const std::string question = "where am i " + MappedPlace::text(place.middleOf(room));
    const json answer = place.answer(question);
    expect(!answer.is_null() && building::contains(place.trueRoom(room), pointOf(answer["room"]["centre_m"])),
           question + " " + room);
  }
  /// The goal of the room at the middle of a true room is in it, and reached.
  static void goal(const MappedPlace& place, const std::string& room) {
    const json at = place.answer("where am i " + MappedPlace::text(place.middleOf(room)));
    const json answer = at.is_null() ? at : place.answer("goal " + at["room"]["id"].get<std::string>());
    expect(!answer.is_null() && !answer["goal"].is_null() && answer["goal"]["connected"] == true &&
               building::contains(place.trueRoom(room),
                                  Vector2d(answer["goal"]["x_m"].get<double>(), answer["goal"]["y_m"].get<double>())),
           "goal " + room);
  }
  /// The way between two rooms is at least about as long as the straight line between their centres and at most
  /// `detour` times that, and passes all of `through`.
  static void path(const MappedPlace& place, const std::string& from, const std::string& to, const Texts& through,
                   double detour) {
    const auto roomAt = [&](const std::string& room) {
      const json answer = place.answer("where am i " + MappedPlace::text(place.middleOf(room)));
      return answer.is_null() ? answer : answer["room"];
    };
    const json start = roomAt(from), end = roomAt(to);
    const json answer =
        start.is_null() || end.is_null()
            ? json()
            : place.answer("path " + start["id"].get<std::string>() + " to " + end["id"].get<std::string>());
    bool is_right = !answer.is_null();
    if (is_right) {
      const double straight = (pointOf(end["centre_m"]) - pointOf(start["centre_m"])).norm();
      is_right = answer["length_m"] > 0.8 * straight && answer["length_m"] < detour * straight;
      for (const auto& room : through) {
        const auto outline = place.trueRoom(room);
        is_right =
            is_right && std::any_of(answer["points_m"].begin(), answer["points_m"].end(),
                                    [&](const json& point) { return building::contains(outline, pointOf(point)); });
      }
    }
    expect(is_right, "path " + from + " to " + to + "\n" + answer.dump());
  }
  /// A sign with that number is found where it is.
  static void findSign(const MappedPlace& place, const std::string& verb, const std::string& number) {
    const json answer = place.answer(verb + number);
    double least = 1e9;
    for (const auto& sign : trueSigns(place.map() + "/../log"))
      if (sign.has(number) && !answer.is_null())
        least = std::min(least,
                         (place.inMap(sign.position.head<2>()) - pointOf(answer["matches"][0]["position_m"])).norm());
    expect(least < 0.5, verb + number);
  }
  static Vector2d pointOf(const json& point) { return {point[0].get<double>(), point[1].get<double>()}; }

  static std::unique_ptr<MappedPlace> home_, office_, laboratory_;
  static int asked_, right_;
};
std::unique_ptr<MappedPlace> Questions::home_, Questions::office_, Questions::laboratory_;
int Questions::asked_ = 0, Questions::right_ = 0;

TEST_F(Questions, FortyAreAnsweredAsInTheTruth) {
  for (const char* room : {"living_room", "kitchen", "hallway", "bedroom", "bathroom", "study"}) {
    whereAmI(*home_, room);
    goal(*home_, room);
  }
  path(*home_, "kitchen", "bedroom", {"hallway"}, 2.5);
  path(*home_, "bathroom", "study", {"hallway"}, 2.5);
  path(*home_, "study", "living_room", {"hallway"}, 2.5);
  for (const char* room : {"laboratory", "office_211", "storage_212", "office_213"}) whereAmI(*laboratory_, room);
  for (const char* room : {"laboratory", "office_213"}) goal(*laboratory_, room);
  path(*laboratory_, "office_211", "office_213", {"north_hall"}, 2.5);
  for (const char* number : {"118", "124", "131", "141", "145"}) findSign(*office_, "find ", number);
  for (const char* hall : {"north_hall", "south_hall"}) {
    const json answer = office_->answer("where am i " + MappedPlace::text(office_->middleOf(hall)));
    expect(!answer.is_null() && answer["room"]["kind"] == "corridor", std::string("where am i: ") + hall);
  }
  for (const char* number : {"118", "124", "131"}) {
    // Its own room, or "not seen": never another one.
    const json answer = office_->answer(std::string("in ") + number);
    expect(!answer.is_null() && answer["rooms"][0]["name"] == number, std::string("in ") + number);
  }
  for (const char* number : {"118", "131"}) {
    const json answer = office_->answer(std::string("path here to ") + number);
    expect(!answer.is_null() && answer["length_m"] > 1, std::string("path here to ") + number);
  }
  for (const char* number : {"124", "141"}) {
    const json answer = office_->answer(std::string("which room is ") + number + " in");
    expect(!answer.is_null() && answer["matches"][0]["room"].is_object(), std::string("which room is ") + number);
  }
  for (const char* number : {"147", "149"}) {
    const json answer = office_->answer(std::string("goal ") + number);
    expect(!answer.is_null() && answer["goal"]["connected"] == true, std::string("goal ") + number);
  }
  const json rooms = home_->answer("rooms");
  expect(rooms["rooms"].size() >= 6, "rooms");
  const json between = office_->answer("between 118 and 120");
  expect(!between.is_null(), "between 118 and 120");
  EXPECT_EQ(asked_, 40);
}

TEST_F(Questions, TenWithoutAnAnswerGetNone) {
  for (const char* question : {"where am i 500 500", "in attic", "goal garage", "path here to attic", "in 999"})
    EXPECT_EQ(home_->ask(question).code, kNoAnswer) << question;
  for (const char* question :
       {"777", "in 119", "which room is piano in", "between 118 and helipad", "path 118 to 400,400"})
    EXPECT_EQ(office_->ask(question).code, kNoAnswer) << question;
}

}  // namespace
