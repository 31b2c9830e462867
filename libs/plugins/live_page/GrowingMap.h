#pragma once

#include <omnimapper/derived/GridMapper.h>
#include <omnimapper/plugin/View.h>

#include <string>

namespace omnimapper::plugins {

/// The folder of a map that grows, as far as a page shows it: checkpoint.omnimap with the places and the rooms, but
/// without what a run needs to go on from it; the occupancy grid, and the positions of the key frames.
class GrowingMap {
 public:
  explicit GrowingMap(std::string folder);

  /// Writes the map as it is now, checkpoint.omnimap last, and what the run says about itself (aboutRun()). Throws
  /// base::Error as base::writeFile().
  void write(const mapper::State& state, const std::string& about);
  /// Removes the folder.
  void remove() const;

 private:
  void writeGrid(const map::Map& map);

  std::string folder_;
  derived::GridMapper grid_;
};

/// What is known of a run that goes on: a JSON document with those keys of summary.json that a page shows.
std::string aboutRun(const mapper::View& view, const std::string& title);

}  // namespace omnimapper::plugins
