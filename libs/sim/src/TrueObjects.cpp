#include "TrueObjects.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim_world/ObjectMaking.h>

#include <algorithm>
#include <set>

#include "MeshFile.h"

namespace omnimapper::sim {

namespace {

const Body& bodyOf(const World& world, const Object& object) {
  return *std::find_if(world.bodies.begin(), world.bodies.end(),
                       [&](const Body& body) { return body.name == object.name; });
}

// A file name for each object, in their order; objects whose names differ only in characters that do not fit into file
// names get numbers.
std::vector<std::string> meshNames(const World& world) {
  std::vector<std::string> names;
  std::set<std::string> used;
  for (const Object& object : world.objects) {
    const std::string stem = base::asFileName(object.name);
    std::string name = stem;
    for (int number = 2; !used.insert(name).second; ++number) name = stem + "_" + std::to_string(number);
    names.push_back("objects/" + name + ".ply");
  }
  return names;
}

bool areEqual(const Track::Place& a, const Track::Place& b) {
  return a.map_from_body->translation == b.map_from_body->translation &&
         a.map_from_body->rotation.coeffs() == b.map_from_body->rotation.coeffs();
}

/// A time from which an object is somewhere, or moves [s].
struct Change {
  double time = 0;
  bool in_motion = false;
};
std::vector<Change> changesOf(const Track& track) {
  std::vector<Change> changes;
  const auto& places = track.places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool in_motion =
        track.kind() == Track::Kind::motion && i + 1 < places.size() && !areEqual(places[i], places[i + 1]);
    if (i == 0 || track.kind() == Track::Kind::steps || in_motion != changes.back().in_motion)
      changes.push_back({i == 0 ? 0 : places[i].time, in_motion});
  }
  return changes;
}

std::string supportAt(const Object& object, double time) {
  std::string on;
  for (const Object::Stand& stand : object.stands) {
    if (stand.from <= time) on = stand.on;
  }
  return on;
}

std::string poseFields(const std::optional<geometry::Se3>& pose) {
  if (!pose) return ",,,,,,,";
  std::string text;
  for (int i = 0; i < 3; ++i) text += "," + base::fixed(pose->translation[i], 6);
  for (int i = 0; i < 4; ++i) text += "," + base::fixed(pose->rotation.coeffs()[i], 9);
  return text;
}

std::string rowsOf(const Object& object, const Body& body, const std::string& mesh) {
  std::string begin = base::csvField(object.name) + "," + object.shape + (object.moveable ? ",1," : ",0,") + mesh;
  const Eigen::Vector3d extents = extentsOf(body);
  for (int i = 0; i < 3; ++i) begin += "," + base::fixed(extents[i], 4);
  std::string rows;
  for (const Change& change : changesOf(body.track)) {
    const auto map_from_object = body.track.at(change.time);
    const std::string on = map_from_object ? supportAt(object, change.time) : "";
    rows += begin + "," + base::fixed(change.time, 3) + "," + base::csvField(on) + (change.in_motion ? ",1" : ",0") +
            poseFields(map_from_object) + "\n";
  }
  return rows;
}

}  // namespace

TrueObjects::TrueObjects(const Simulation& simulation)
    : world_(simulation.world()),
      has_camera_(std::any_of(simulation.sensors().begin(), simulation.sensors().end(),
                              [](const auto& sensor) { return sensor->isCamera(); })),
      seen_("stamp,sensor,measurement,object,pixels,depth_pixels,left_px,top_px,right_px,bottom_px,distance_m\n") {}

void TrueObjects::add(const Sensor& sensor, int k, const std::vector<ObjectView>& objects) {
  const std::string begin =
      base::formatUnix(sensor.stampOf(k)) + "," + base::csvField(sensor.label()) + "," + std::to_string(k) + ",";
  for (const ObjectView& view : objects) {
    seen_ += begin + base::csvField(world_.objects[static_cast<std::size_t>(view.object)].name);
    for (const int number : {view.pixels, view.with_depth, view.left, view.top, view.right, view.bottom})
      seen_ += "," + std::to_string(number);
    seen_ += "," + base::fixed(view.distance, 3) + "\n";
  }
}

std::vector<std::string> TrueObjects::write(const std::string& folder) const {
  if (world_.objects.empty()) return {};
  std::vector<std::string> files{"objects.csv"};
  std::string table =
      "object,shape,moveable,mesh,length_m,width_m,height_m,from_s,on,in_motion,x_m,y_m,z_m,qx,qy,qz,qw\n";
  const std::vector<std::string> meshes = meshNames(world_);
  base::makeWritableFolder(folder + "/objects");
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Body& body = bodyOf(world_, world_.objects[i]);
    table += rowsOf(world_.objects[i], body, meshes[i]);
    base::writeFile(folder + "/" + meshes[i], [&](std::ostream& out) { writeMesh(out, body); });
  }
  base::writeFile(folder + "/objects.csv", [&](std::ostream& out) { out << table; });
  if (has_camera_) {
    files.push_back("objects_seen.csv");
    base::writeFile(folder + "/objects_seen.csv", [&](std::ostream& out) { out << seen_; });
  }
  files.push_back("objects/");
  return files;
}

}  // namespace omnimapper::sim
