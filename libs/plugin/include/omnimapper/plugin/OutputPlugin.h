#pragma once

#include <omnimapper/plugin/View.h>

namespace omnimapper::mapper {

/// How much of the images in a log key frames keep: nothing, depth images, or all.
enum class RawImages { none, depth, all };

/// Shows or writes the map (thesis 5.3.5).
class OutputPlugin {
 public:
  virtual ~OutputPlugin() = default;
  /// Whether what it writes is the map itself, which a run that localizes in one does not make anew.
  virtual bool isOfMap() const { return false; }
  /// What it needs of the images in a log. Key frames keep what the output that needs most asks for.
  virtual RawImages needsOfImages() const { return RawImages::none; }
  /// After each solve, for what is shown live.
  virtual void update(const View& /*view*/) {}
  /// After each key frame, for what is shown live between solves, too. It must not take long.
  virtual void keyFrameAdded(const View& /*view*/) {}
  /// After each frame of the reference sensor that is no key frame, for where the robot is shown live. It must not take
  /// long.
  virtual void frameAdded(const View& /*view*/) {}
  /// Once, at the end of the run. Throws base::Error if an output cannot be written.
  virtual void finish(const View& view) = 0;
  /// Whether somebody may still look at it: the run ends when this says no, and all is written by then.
  virtual bool isLookedAt() const { return false; }
};

}  // namespace omnimapper::mapper
