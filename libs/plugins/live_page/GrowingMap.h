#pragma once

#include <omnimapper/derived/GridMapper.h>
#include <omnimapper/plugin/View.h>

#include <string>

namespace omnimapper::plugins {

/// The folder of a map that grows, as far as a page shows it: checkpoint.omnimap with the places and the rooms, but
/// without what a run needs to go on from it; the occupancy grid, and the positions of the key frames.
class GrowingMap {
 public:
  /// Creates the folder, so that the server of the page knows from the start that a run goes on, but only in the hidden
  /// folder of an output folder that exists: in another one there is no map of before.
  explicit GrowingMap(std::string folder);
  /// Removes the folder if this object created it and remove() did not.
  ~GrowingMap();
  GrowingMap(const GrowingMap&) = delete;
  GrowingMap& operator=(const GrowingMap&) = delete;

  /// Writes the map as it is now, checkpoint.omnimap last, and what the run says about itself (aboutRun()). Throws
  /// base::Error as base::writeFile(), and std::filesystem::filesystem_error.
  void write(const mapper::State& state, const std::string& about);
  /// Removes the folder.
  void remove();

 private:
  void writeGrid(const map::Map& map);

  std::string folder_;
  bool is_mine_ = false;
  derived::GridMapper grid_;
};

/// What is known of a run that goes on: a JSON document with those keys of summary.json that a page shows.
std::string aboutRun(const mapper::View& view, const std::string& title);

}  // namespace omnimapper::plugins
