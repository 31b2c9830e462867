#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// An object of a map, as ObjectsOutput writes it.
struct MappedObject {
  enum class State { present, gone, candidate };

  std::string id;
  State state = State::present;
  geometry::Se3 map_from_box;                          ///< middle and axes of its box
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();  ///< [m] whole length along each axis
  int seen_in = 0;                                     ///< number of images that show it
  std::optional<double> last_looked;    ///< seconds since 1970 of the last image that had its place in view
  std::vector<Eigen::Vector3d> points;  ///< of its model, in the map [m]
};

struct ObjectMap {
  std::vector<MappedObject> objects;
  std::optional<int> merged;  ///< how many objects turned out to be one with another
};

/// Reads objects.json in the folder of a map, and the model of each object. Throws base::Error(unreadable_input) naming
/// the file and the object if a file is missing or damaged.
ObjectMap readObjectMap(const std::string& folder);

/// The map in another frame.
ObjectMap moved(ObjectMap map, const geometry::Se3& other_from_map);

}  // namespace omnimapper::eval
