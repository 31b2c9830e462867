#pragma once

#include <omnimapper/plugin/View.h>

#include <string>

namespace omnimapper::mapper {

/// Which images of a log the key frames keep: none, depth images, or all.
enum class RawImages { none, depth, all };

/// Shows or writes the map (thesis 5.3.5).
class OutputPlugin {
 public:
  virtual ~OutputPlugin() = default;
  /// Whether it writes the map itself. A run that localizes in a map skips such outputs, because such a run makes no
  /// new map.
  virtual bool isOfMap() const { return false; }
  /// Which images of a log it needs. Key frames keep the images that the most demanding output needs.
  virtual RawImages needsOfImages() const { return RawImages::none; }
  /// Called after each solve, for live display. Without loop closures that is after [mapper] solve_every key frames, so
  /// a display that follows the robot needs keyFrameAdded(), too.
  virtual void update(const View& /*view*/) {}
  /// Called after each key frame, for live display between solves. It must not take long.
  virtual void keyFrameAdded(const View& /*view*/) {}
  /// Called after each frame of the reference sensor that is not a key frame, for live display of the robot's pose. It
  /// must not take long. No call follows a watcher's answer: a display finds a new layer here, or at the next key
  /// frame.
  virtual void frameAdded(const View& /*view*/) {}
  /// Called once, at the end of the run. Throws base::Error if an output cannot be written.
  virtual void finish(const View& view) = 0;
  /// Called after finish(), when the files of the run are at their places in `folder`: that of the run, or one inside
  /// it if the run is incomplete.
  virtual void published(const std::string& /*folder*/) {}
  /// Whether a user may still be viewing the output: the run ends only once this is false for every output.
  virtual bool isLookedAt() const { return false; }
};

}  // namespace omnimapper::mapper
