#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Furniture.h>
#include <omnimapper/sim_world/MarkerMaking.h>
#include <omnimapper/sim_world/PosterMaking.h>
#include <omnimapper/sim_world/SignMaking.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <algorithm>

#include "HandCarrying.h"
#include "ObjectPlacing.h"
#include "PlanChecks.h"
#include "StandingThings.h"
#include "WallThings.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector3d;

constexpr double kRobotHeight = 1.3;  // furniture that begins higher is no obstacle to robots [m]
// Random streams of the world's seed, one for each kind of item.
enum Stream : std::uint64_t { kFurnitureStream = 1, kObjectStream, kPosterStream };

// The middle of a body or of a planar surface at a time.
std::optional<Vector3d> middleOf(const World& world, const std::string& name, double time) {
  for (const Body& body : world.bodies) {
    const auto pose = body.track.at(time);
    if (!pose) continue;
    std::vector<Vector3d> points;
    if (body.name == name) points = body.vertices_in_body;
    for (const Surface& surface : body.surfaces) {
      if (surface.name == name && surface.face) points = surface.face->outline_in_body;
    }
    if (points.empty()) continue;
    Vector3d low = points.front(), high = low;
    for (const Vector3d& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    return *pose * Vector3d((low + high) / 2);
  }
  return {};
}

class WorldMaker {
 public:
  explicit WorldMaker(const WorldPlan& plan)
      : plan_(plan), building_(makeBuilding(plan)), walls_(plan, building_), floor_(plan, building_) {}

  World make() {
    world_.seed = plan_.seed;
    world_.wear = plan_.wear;
    world_.rooms = building_.rooms;
    world_.openings = building_.openings;
    world_.bodies = building_.bodies;
    world_.obstacles = building_.obstacles;
    for (std::size_t i = 0; i < plan_.furniture.size(); ++i) add(plan_.furniture[i], i);
    addObjects();
    for (const SignPlan& sign : plan_.signs) add(sign);
    for (const MarkerPlan& marker : plan_.markers) add(marker);
    for (std::size_t i = 0; i < plan_.posters.size(); ++i) add(plan_.posters[i], i);
    for (const LandmarkPlan& landmark : plan_.landmarks) add(landmark);
    for (const PersonSpec& person : plan_.people) add(person);
    moveByHand(plan_, floor_, std::move(carried_), world_);
    validate(world_);
    return std::move(world_);
  }

 private:
  void add(const FurniturePlan& plan, std::size_t number) {
    const FurnitureShape* shape = findFurnitureShape(plan.shape);
    if (!shape) refuse(plan_, plan.name, "class", "no furniture is called '" + plan.shape + "'");
    const FurniturePlan sized = withUsualSize(plan, *shape);
    refuseUnknownMaterial(plan_, plan.name, "material", sized.material);
    const geometry::Se3 map_from_body = floor_.put(sized, shape->follows_slope);
    world_.bodies.push_back(
        makeFurniture(sized, *shape, Track(map_from_body), Random(plan_.seed, {kFurnitureStream, number})));
    floor_.addFurnitureTops(world_.bodies.back());
    if (sized.z < kRobotHeight)
      world_.obstacles.push_back(rectangle({sized.x, sized.y}, sized.length, sized.width, sized.yaw));
  }

  void addObjects() {
    std::vector<MadeObject> made = placeObjects(plan_, floor_);
    for (std::size_t i = 0; i < made.size(); ++i) {
      PlacePlan first = plan_.objects[i].place;
      const Vector3d& stands = made[i].body.track.places().front().map_from_body->translation;
      first.x = stands.x(), first.y = stands.y();  // which differ if it is slid against another object
      blockFloor(first, plan_.objects[i].moves, reachOf(made[i].body));
      made[i].object.stands = standsOf(plan_.objects[i]);
      world_.bodies.push_back(std::move(made[i].body));
      world_.objects.push_back(std::move(made[i].object));
    }
  }

  std::vector<Object::Stand> standsOf(const ObjectPlan& object) const {
    const auto nameOf = [&](const PlacePlan& place) {
      if (!place.on.empty()) return place.on;
      return building_.rooms[static_cast<std::size_t>(*roomAt(building_.rooms, {place.x, place.y}))].name + "/floor";
    };
    std::vector<Object::Stand> stands{{0, nameOf(object.place)}};
    for (const MovePlan& move : object.moves)
      stands.push_back({move.time, move.place ? nameOf(*move.place) : move.person});
    return stands;
  }

  // Robots plan one path for the whole run, so they keep away from places where something stands at any time.
  void blockFloor(const PlacePlan& first, const std::vector<MovePlan>& moves, const Vector3d& extents) {
    const auto block = [&](const PlacePlan& place) {
      if (place.on.empty())
        world_.obstacles.push_back(rectangle({place.x, place.y}, extents.x(), extents.y(), place.yaw));
    };
    block(first);
    for (const MovePlan& move : moves) {
      if (move.place) block(*move.place);
    }
  }

  void add(const SignPlan& plan) {
    const auto room =
        std::find_if(plan_.rooms.begin(), plan_.rooms.end(), [&](const RoomPlan& r) { return r.name == plan.room; });
    if (!plan.room.empty() && room == plan_.rooms.end() && plan.lines.empty())
      refuse(plan_, plan.name, "room", "there is no room '" + plan.room + "'");
    SignSpec spec;
    spec.name = plan.name;
    spec.room = plan.room;
    spec.lines = plan.lines;
    if (spec.lines.empty() && room != plan_.rooms.end()) {
      if (!room->number.empty()) spec.lines.push_back(room->number);
      if (room->number.empty() || room->name != room->number) spec.lines.push_back(spoken(room->name));
    }
    spec.style = signStyleOf(plan.style);
    spec.width = plan.width;
    spec.height = plan.height;
    if (spec.lines.empty()) refuse(plan_, plan.name, "text", "must not be empty, unless 'room' names a room");
    MadeSign made = makeOrRefuse(plan.name, "text", [&] { return makeSign(spec); });
    made.sign.map_from_sign = walls_.hang(plan.name, plan.at, made.sign.width, made.sign.height, kSignThickness);
    made.body.track = Track(made.sign.map_from_sign);
    world_.bodies.push_back(std::move(made.body));
    world_.signs.push_back(std::move(made.sign));
  }

  static std::string spoken(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    if (!name.empty()) name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    return name;
  }

  void add(const PosterPlan& plan, std::size_t number) {
    const auto& kinds = posterKindNames();
    PosterSpec spec;
    spec.name = plan.name;
    spec.kind = static_cast<PosterKind>(std::find(kinds.begin(), kinds.end(), plan.kind) - kinds.begin());
    spec.seed = Random(plan_.seed, {kPosterStream, number}).bits();
    spec.width = plan.width;
    spec.height = plan.height;
    Body body = makePoster(spec);
    const Vector3d extents = extentsOf(body);
    body.track = Track(walls_.hang(plan.name, plan.at, extents.x(), extents.y(), kPosterThickness));
    world_.bodies.push_back(std::move(body));
  }

  void add(const MarkerPlan& plan) {
    MarkerSpec spec;
    spec.name = plan.name;
    spec.id = plan.id;
    spec.side = plan.side;
    MadeMarker made = makeOrRefuse(plan.name, "id", [&] { return makeMarker(spec); });
    const Vector3d extents = extentsOf(made.body);
    if (plan.on_wall) {
      made.body.track = Track(walls_.hang(plan.name, plan.at, extents.x(), extents.y(), kMarkerThickness));
    } else {
      made.body.track = standing(plan, extents);
      world_.bodies.push_back(footOf(plan.name, extents, made.body.track));
    }
    world_.bodies.push_back(std::move(made.body));
    world_.markers.push_back(made.marker);
    if (plan.is_landmark) world_.point_landmarks.push_back({plan.name, plan.id, Vector3d::Zero(), plan.name});
  }

  // The track of a marker in a frame on a foot: it is upright and faces -y of the place.
  Track standing(const MarkerPlan& plan, const Vector3d& plate) {
    const Vector3d extents(plate.x(), kFootDepth, plate.y());
    const Track foot = floor_.trackOf({plan.name, plan.place, plan.moves, boxSpace(extents)});
    blockFloor(plan.place, plan.moves, extents);
    const geometry::Se3 foot_from_marker{Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX())),
                                         {0, -kFootDepth / 2 + kMarkerThickness, plate.y() / 2}};
    std::vector<Track::Place> places = foot.places();
    for (Track::Place& place : places) {
      if (place.map_from_body) place.map_from_body = *place.map_from_body * foot_from_marker;
    }
    return places.size() == 1 ? Track(*places.front().map_from_body) : Track(Track::Kind::steps, std::move(places));
  }

  static Body footOf(const std::string& name, const Vector3d& plate, const Track& track) {
    MeshBuilder builder(name + "_foot", track);
    const NamedMaterial look = materialNamed("black_plastic");
    const int foot = builder.addSurface("", SurfaceKind::clutter, look.material);
    builder.addBox(foot, {-0.04, -plate.y() / 2, -kFootDepth + kMarkerThickness},
                   {0.04, -plate.y() / 2 + 0.01, -kMarkerThickness});
    return builder.build();
  }

  void add(const LandmarkPlan& plan) {
    const Vector3d point(plan.x, plan.y, plan.z);
    const auto number = roomAt(building_.rooms, point.head<2>());
    if (!number) refuse(plan_, plan.name, "x_m", "x_m, y_m lies in no room");
    const Room& room = building_.rooms[*number];
    const double above_floor = plan.z - room.floorAt(point.head<2>());
    if (!room.is_outdoors && (above_floor < 0 || above_floor > room.height))
      refuse(plan_, plan.name, "z_m", "lies below the floor or above the ceiling of '" + room.name + "'");
    world_.point_landmarks.push_back({plan.name, plan.id, point, ""});
  }

  void add(PersonSpec person) {
    for (const auto& waypoint : person.waypoints) {
      const auto room = roomAt(building_.rooms, waypoint.in_map);
      if (!room) refuse(plan_, person.name, "path", "goes through a place that lies in no room");
      if (&waypoint == &person.waypoints.front()) person.floor_z = building_.rooms[*room].floorAt(waypoint.in_map);
    }
    floor_.refuseBlockedPath(person);
    for (Person::Pointing& act : person.acts) {
      if (act.target.empty()) continue;
      const auto target = middleOf(world_, act.target, act.begin);
      if (!target) refuse(plan_, person.name, "pointing", "nothing is called '" + act.target + "' at that time");
      act.target_in_map = *target;
    }
    person.carryings = carryingsOf(plan_, person.name, world_);
    const char* const key = person.carryings.empty() ? "path" : "path or carrying";
    MadePerson made = makeOrRefuse(person.name, key, [&] { return makePerson(person); });
    for (auto& carried : made.carried) carried_.push_back(std::move(carried));
    for (Body& body : made.bodies) world_.bodies.push_back(std::move(body));
    world_.people.push_back(std::move(made.person));
  }

  // Calls a function that makes an item, and adds the place in the INI to its error.
  template <class Make>
  auto makeOrRefuse(const std::string& section, const std::string& key, const Make& make) const -> decltype(make()) {
    try {
      return make();
    } catch (const base::Error& error) {
      refuse(plan_, section, key, error.what());
    }
  }

  static constexpr double kFootDepth = 0.08;  // [m]

  const WorldPlan& plan_;
  Building building_;
  WallSpace walls_;
  StandingSpace floor_;
  std::vector<MadePerson::Carried> carried_;
  World world_;
};

}  // namespace

std::uint64_t seedOfObject(std::uint64_t world_seed, std::size_t number) {
  return Random(world_seed, {kObjectStream, number}).bits();
}

World makeWorld(const WorldPlan& plan) {
  refuseTwins(plan);
  refuseHugePlaces(plan);
  const WorldPlan moved = withMovesByHand(plan);
  return WorldMaker(moved).make();
}

}  // namespace omnimapper::sim
