#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/ObjectTruth.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace omnimapper::eval {

namespace {

using base::CsvTable;

int countIn(const CsvTable& table, std::size_t row, const std::string& column) {
  const double value = table.number(row, column);
  if (value < 0 || value > 1e9 || value != std::floor(value)) table.refuse(row, "column " + column + ": is no count");
  return static_cast<int>(value);
}

std::optional<geometry::Se3> poseIn(const CsvTable& table, std::size_t row) {
  if (table.text(row, "x_m").empty()) return {};
  const Eigen::Quaterniond rotation(table.number(row, "qw"), table.number(row, "qx"), table.number(row, "qy"),
                                    table.number(row, "qz"));
  if (std::abs(rotation.norm() - 1) > 0.01) table.refuse(row, "qx, qy, qz, qw: are no unit quaternion");
  return geometry::Se3{rotation.normalized(),
                       {table.number(row, "x_m"), table.number(row, "y_m"), table.number(row, "z_m")}};
}

TrueObject objectIn(const CsvTable& table, std::size_t row, const std::string& folder) {
  TrueObject object;
  object.name = table.text(row, "object");
  object.shape = table.text(row, "shape");
  object.moveable = countIn(table, row, "moveable") > 0;
  object.mesh = folder + "/" + table.text(row, "mesh");
  object.extents = {table.number(row, "length_m"), table.number(row, "width_m"), table.number(row, "height_m")};
  return object;
}

}  // namespace

const TrueObjectPlace& TrueObject::at(double time) const {
  const auto after = std::upper_bound(places.begin(), places.end(), time,
                                      [](double t, const TrueObjectPlace& place) { return t < place.from; });
  return after == places.begin() ? places.front() : *(after - 1);
}

std::vector<TrueObject> readTrueObjects(const std::string& folder) {
  const CsvTable table(folder + "/objects.csv", "table of the objects of a simulated log");
  std::vector<TrueObject> objects;
  std::map<std::string, std::size_t> numbers;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto [entry, is_new] = numbers.try_emplace(table.text(row, "object"), objects.size());
    if (is_new) objects.push_back(objectIn(table, row, folder));
    auto& places = objects[entry->second].places;
    const TrueObjectPlace place{table.number(row, "from_s"), table.text(row, "on"),
                                countIn(table, row, "in_motion") > 0, poseIn(table, row)};
    if (!places.empty() && place.from <= places.back().from)
      table.refuse(row, "column from_s: the places of an object must be in order of time");
    places.push_back(place);
  }
  return objects;
}

std::vector<ObjectSighting> readObjectSightings(const std::string& folder) {
  const CsvTable table(folder + "/objects_seen.csv", "table of the objects in the images of a simulated log");
  std::vector<ObjectSighting> sightings(table.size());
  for (std::size_t row = 0; row < table.size(); ++row) {
    ObjectSighting& sighting = sightings[row];
    sighting.stamp = base::parseUnix(table.text(row, "stamp"));
    sighting.sensor = table.text(row, "sensor");
    sighting.measurement = countIn(table, row, "measurement");
    sighting.object = table.text(row, "object");
    sighting.pixels = countIn(table, row, "pixels");
    sighting.depth_pixels = countIn(table, row, "depth_pixels");
    sighting.left = countIn(table, row, "left_px");
    sighting.top = countIn(table, row, "top_px");
    sighting.right = countIn(table, row, "right_px");
    sighting.bottom = countIn(table, row, "bottom_px");
    sighting.distance = table.number(row, "distance_m");
  }
  return sightings;
}

std::vector<SeenObject> countSightings(const std::vector<TrueObject>& objects,
                                       const std::vector<ObjectSighting>& sightings, const SeenLimits& limits) {
  std::vector<SeenObject> seen;
  std::map<std::string, std::size_t> numbers;
  for (const TrueObject& object : objects) {
    numbers[object.name] = seen.size();
    seen.emplace_back().object = object.name;
  }
  for (const ObjectSighting& sighting : sightings) {
    const auto number = numbers.find(sighting.object);
    if (number == numbers.end()) {
      throw base::Error(base::ExitCode::unreadable_input,
                        "objects_seen.csv: names '" + sighting.object +
                            "', which objects.csv does not; take both files from the same simulated log");
    }
    SeenObject& object = seen[number->second];
    object.most_pixels = std::max(object.most_pixels, sighting.pixels);
    object.nearest = std::min(object.nearest, sighting.distance);
    object.images += sighting.pixels >= limits.pixels && sighting.distance <= limits.distance ? 1 : 0;
  }
  for (SeenObject& object : seen) object.is_seen = object.images >= limits.images;
  return seen;
}

}  // namespace omnimapper::eval
