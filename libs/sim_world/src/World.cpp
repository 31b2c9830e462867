#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/World.h>

#include <set>
#include <stdexcept>

namespace omnimapper::sim {

std::string toString(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::floor:
      return "floor";
    case SurfaceKind::ceiling:
      return "ceiling";
    case SurfaceKind::wall:
      return "wall";
    case SurfaceKind::door:
      return "door";
    case SurfaceKind::window:
      return "window";
    case SurfaceKind::table:
      return "table";
    case SurfaceKind::counter:
      return "counter";
    case SurfaceKind::shelf:
      return "shelf";
    case SurfaceKind::chair:
      return "chair";
    case SurfaceKind::object:
      return "object";
    case SurfaceKind::sign:
      return "sign";
    case SurfaceKind::poster:
      return "poster";
    case SurfaceKind::marker:
      return "marker";
    case SurfaceKind::person:
      return "person";
    case SurfaceKind::road:
      return "road";
    case SurfaceKind::kerb:
      return "kerb";
    case SurfaceKind::clutter:
      return "clutter";
  }
  return "";
}

surfaces::SurfaceClass usualClass(SurfaceKind kind) {
  using Class = surfaces::SurfaceClass;
  switch (kind) {
    case SurfaceKind::floor:
    case SurfaceKind::road:
    case SurfaceKind::kerb:
      return Class::floor;
    case SurfaceKind::ceiling:
      return Class::ceiling;
    case SurfaceKind::wall:
      return Class::wall;
    case SurfaceKind::door:
      return Class::door;
    case SurfaceKind::window:
      return Class::window;
    case SurfaceKind::table:
      return Class::table;
    case SurfaceKind::counter:
      return Class::counter;
    case SurfaceKind::shelf:
      return Class::shelf;
    case SurfaceKind::chair:
      return Class::seat;
    case SurfaceKind::sign:
    case SurfaceKind::poster:
    case SurfaceKind::marker:
      return Class::poster;
    case SurfaceKind::object:
    case SurfaceKind::person:
    case SurfaceKind::clutter:
      break;
  }
  return Class::object;
}

std::vector<SurfaceRef> numberSurfaces(const World& world) {
  std::vector<SurfaceRef> refs;
  for (std::size_t body = 0; body < world.bodies.size(); ++body) {
    for (std::size_t surface = 0; surface < world.bodies[body].surfaces.size(); ++surface)
      refs.push_back({static_cast<int>(body), static_cast<int>(surface)});
  }
  return refs;
}

const Person::Joint& jointOf(const Person& person, const std::string& name) {
  for (const Person::Joint& joint : person.joints) {
    if (joint.name == name) return joint;
  }
  throw std::invalid_argument("jointOf: " + person.name + " has no joint " + name);
}

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw base::Error(base::ExitCode::internal, "simulated world: " + what);
}

void validate(const Body& body) {
  const int vertices = static_cast<int>(body.vertices_in_body.size()),
            surfaces = static_cast<int>(body.surfaces.size());
  for (const Triangle& triangle : body.triangles) {
    if (triangle.surface < 0 || triangle.surface >= surfaces) fail(body.name + ": a triangle of no surface");
    for (const int corner : triangle.corners) {
      if (corner < 0 || corner >= vertices) fail(body.name + ": a triangle without its corner");
    }
  }
}

}  // namespace

void validate(const World& world) {
  std::set<std::string> bodies, surfaces;
  for (const Body& body : world.bodies) {
    if (!bodies.insert(body.name).second) fail("two bodies are called '" + body.name + "'");
    for (const Surface& surface : body.surfaces) {
      if (!surfaces.insert(surface.name).second) fail("two surfaces are called '" + surface.name + "'");
    }
    validate(body);
  }
  const auto needBody = [&](const std::string& name, const std::string& who) {
    if (bodies.count(name) == 0) fail(who + " names a body '" + name + "' that is not there");
  };
  for (const Sign& sign : world.signs) needBody(sign.name, "a sign");
  for (const Marker& marker : world.markers) needBody(marker.name, "a marker");
  for (const Object& object : world.objects) needBody(object.name, "an object");
  for (const PointLandmark& landmark : world.point_landmarks) {
    if (!landmark.body.empty()) needBody(landmark.body, "landmark " + landmark.name);
  }
  for (const Person& person : world.people) {
    for (const std::string& body : person.bodies) needBody(body, person.name);
  }
}

}  // namespace omnimapper::sim
