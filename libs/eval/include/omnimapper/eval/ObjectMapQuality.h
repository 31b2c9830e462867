#pragma once

#include <omnimapper/eval/ObjectMap.h>
#include <omnimapper/eval/ObjectTruth.h>
#include <omnimapper/eval/TriangleMesh.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// Thresholds for the comparison of a map's objects with the true ones. They were chosen so that a person would call
/// the two the same thing, and were not tuned on a log.
struct ObjectMapOptions {
  SeenLimits seen;     ///< what an object must have shown to be sought in the map
  double near = 0.05;  ///< [m] a point of a model is on a true surface if it is at most this far from its mesh
  double share = 0.5;  ///< a mapped object is a true one, or furniture, if at least this share of its points is on it
};

/// What is known about the log: times are seconds since 1970.
struct ObjectTruth {
  std::vector<TrueObject> objects;
  std::vector<TriangleMesh> meshes;  ///< one for each object, in its own frame
  std::vector<ObjectSighting> sightings;
  TriangleMesh world;  ///< everything that does not move by itself, at the log's start
  double begin = 0, end = 0;
};

/// Reads objects.csv, the meshes, objects_seen.csv, world.ply and truth.tum in the folder of a simulated log. Throws
/// base::Error(unreadable_input) naming the file if one is missing or damaged.
ObjectTruth readObjectTruth(const std::string& folder);

/// Judgement of one object of the map.
struct JudgedObject {
  enum class Is { object, furniture, nothing };  ///< furniture: any surface of the place that is no object
  Is is = Is::nothing;
  std::size_t object = 0;  ///< index of the true object, if it is one
  bool is_there = false;   ///< whether it is at a place where that object is at the end
  /// Whether present or gone is right; none for candidates, for what is no object, and for an object that was taken
  /// away after the map's last look at its place.
  std::optional<bool> state_is_right;
  double position_error = 0;  ///< [m] from the middle of its box to the middle of the true one
  double extent = 0;          ///< share of the true extent that the model covers, mean of the three axes
  double distance_median = 0, distance_90 = 0;  ///< [m] of the model's points from the true mesh
};

/// A true object that must be in the map, because it was seen often enough at the place where it is at the end.
struct SoughtObject {
  std::size_t object = 0;       ///< index of the true object
  int images = 0;               ///< number of images that show it there
  std::vector<std::size_t> by;  ///< the present objects of the map that are it
};

/// Precision and recall if only objects that at least so many images show were in the map.
struct ObjectCurvePoint {
  int images = 0;
  std::size_t objects = 0;  ///< number of mapped objects that are left
  double precision = 1;     ///< share of these that are the first of a true object; 1 if none is left
  double recall = 0;        ///< share of the sought objects that are among these
};

struct ObjectMapQuality {
  std::vector<JudgedObject> judged;  ///< one for each object of the map
  std::vector<SoughtObject> sought;
  std::vector<ObjectCurvePoint> curve;  ///< for 1 image and each number of images at which it changes

  std::size_t found() const;    ///< number of sought objects that are in the map, once or more often
  std::size_t doubled() const;  ///< number of sought objects that are in it more than once
};

/// Compares the objects of a map, which must be in the frame of the truth, with the true objects.
ObjectMapQuality judgeObjects(const ObjectMap& map, const ObjectTruth& truth, const ObjectMapOptions& options = {});

/// A table of text for a terminal, the same numbers as a JSON object, and the curve as a CSV table.
std::string table(const ObjectMapQuality& quality, const ObjectMap& map, const ObjectTruth& truth);
std::string json(const ObjectMapQuality& quality, const ObjectMap& map, const ObjectTruth& truth);
std::string curveTable(const ObjectMapQuality& quality);

}  // namespace omnimapper::eval
