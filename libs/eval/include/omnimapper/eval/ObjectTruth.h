#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// The objects of a simulated log, as the simulator writes them: objects.csv, objects_seen.csv and meshes.

/// Where an object is from a time on.
struct TrueObjectPlace {
  double from = 0;         ///< seconds since the start of the log
  std::string on;          ///< surface that it stands on or person who carries it; empty: it is away
  bool in_motion = false;  ///< it is carried visibly until the next place, and the pose is that at `from`
  std::optional<geometry::Se3> map_from_object;  ///< none: it is away
};

/// Frame of an object: origin in the middle of its lowest face, z up.
struct TrueObject {
  std::string name, shape;
  bool moveable = false;
  std::string mesh;                              ///< path of its mesh, a PLY in its own frame
  Eigen::Vector3d extents;                       ///< along its own axes [m]
  std::vector<TrueObjectPlace> places;           ///< in order of time, at least one
  const TrueObjectPlace& at(double time) const;  ///< the place at a time [s]
};

/// The objects in the order of objects.csv in the folder of a simulated log. Throws base::Error(unreadable_input)
/// naming file and line if the table is missing or damaged.
std::vector<TrueObject> readTrueObjects(const std::string& folder);

/// An object in one image of a camera. Columns and rows count from 0.
struct ObjectSighting {
  base::Stamp stamp;  ///< of the image
  std::string sensor;
  int measurement = 0;
  std::string object;
  int pixels = 0;                                ///< number of pixels that show the object
  int depth_pixels = 0;                          ///< number of these pixels that have a depth
  int left = 0, top = 0, right = 0, bottom = 0;  ///< first and last column and row of these pixels
  double distance = 0;                           ///< mean distance from the camera to their points [m]
};

/// The lines of objects_seen.csv in the folder of a simulated log, in the log's order. Throws as readTrueObjects()
/// does.
std::vector<ObjectSighting> readObjectSightings(const std::string& folder);

/// What an object must show to count as seen.
struct SeenLimits {
  int pixels = 300;                                           ///< smallest number of pixels that show it in an image
  int images = 20;                                            ///< smallest number of such images
  double distance = std::numeric_limits<double>::infinity();  ///< farthest mean distance in such an image [m]
};

/// How often an object was seen.
struct SeenObject {
  std::string object;
  int images = 0;       ///< number of images that meet the limits of pixels and distance
  int most_pixels = 0;  ///< in any image
  double nearest = std::numeric_limits<double>::infinity();  ///< smallest mean distance in any image [m]
  bool is_seen = false;                                      ///< whether there are enough such images
};

/// One for each object, in the order of `objects`. Throws base::Error(unreadable_input) if a sighting is of an object
/// that is not among them.
std::vector<SeenObject> countSightings(const std::vector<TrueObject>& objects,
                                       const std::vector<ObjectSighting>& sightings, const SeenLimits& limits = {});

/// A table of text for a terminal, and the same numbers as a JSON object.
std::string table(const std::vector<SeenObject>& seen, const std::vector<TrueObject>& objects);
std::string json(const std::vector<SeenObject>& seen, const std::vector<TrueObject>& objects);

}  // namespace omnimapper::eval
