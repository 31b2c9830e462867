#pragma once

#include <omnimapper/query/MapToAsk.h>

#include <memory>
#include <optional>
#include <string>

namespace omnimapper::server {

/// Whether a run that makes the map has not ended, so that the map cannot be changed.
bool isGrowing(const query::MapToAsk& map);

/// A map as pages see it. It is read again when its file was replaced: by an edit, or while a live run goes on.
class ServedMap {
 public:
  /// `path` is the folder of a map, or a map file. Throws as query::openMap() does. While the folder `growing` exists,
  /// the map in it, which a run writes, is served instead, and until there is one, an empty map that grows. If neither
  /// `growing` nor `path` has a map, an empty one is served.
  explicit ServedMap(std::string path, std::string growing = "");

  /// Reads the map again if its files are others than before; whether they are. If it cannot be read, the one of before
  /// stays, and `warning` says why.
  bool update(std::string& warning);

  const query::MapToAsk& map() const { return *map_; }
  /// The map as it is now; it does not change, so that another thread may read it.
  std::shared_ptr<const query::MapToAsk> sharedMap() const { return map_; }
  /// Changes with each map that is read.
  int revision() const { return revision_; }
  /// query::mapDocument() with the revision, the place of the grid, "is_growing", and "solid": a text that changes with
  /// the files of the view in 3D (points.ply and landmarks.ply), null if there is none.
  const std::string& document() const { return document_; }
  /// The occupancy grid as a PNG file with three colours: black is occupied, white free, grey unknown. Empty if the map
  /// has none yet.
  const std::string& gridPng() const { return grid_png_; }
  /// Where the base was: a JSON document with a list of x, y [m] of at most `kMostPoses` poses.
  const std::string& trajectory() const { return trajectory_; }
  static constexpr std::size_t kMostPoses = 20000;

  /// What the run says about itself, from its summary.json: a JSON document with "title", "sessions", "verdict",
  /// "travel_m", "closures" and the "sensors" of a live run, as far as they are there.
  const std::string& about() const { return about_; }

  /// The picture of an object, by the id of its landmark, "0:12"; none if it has none.
  std::optional<std::string> pictureOf(const std::string& id) const;
  /// The path of a file in the folder of the map, of at most 64 MiB; none if there is none. `name` must not come from
  /// outside.
  std::optional<std::string> fileOfRun(const std::string& name) const;

 private:
  void load();
  query::MapToAsk open() const;
  bool isRunGoingOn() const;
  std::string stampOfRun() const;
  std::string stampOfFiles(const query::MapToAsk& map) const;

  std::string path_, growing_;
  std::shared_ptr<const query::MapToAsk> map_ = std::make_shared<const query::MapToAsk>();
  std::string document_, grid_png_, trajectory_, about_;
  std::string stamp_;  // of the files that were read
  int revision_ = 0;
};

}  // namespace omnimapper::server
