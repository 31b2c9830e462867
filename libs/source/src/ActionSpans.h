#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/source/SourceOptions.h>

#include <cstdint>
#include <map>
#include <vector>

#include "ActionMotion.h"

namespace omnimapper::source {

/// Assigns spans of time to actions, which state none (see ActionSpan). The spans follow each other without a gap: a
/// motion whose end is not after its begin, or has no stamp, is joined to the next one.
class ActionSpans {
 public:
  using Motions = std::vector<obs::CObservationRelativeMotion::Ptr>;

  ActionSpans(ActionSpan mode, std::string label) : mode_(mode), label_(std::move(label)) {}

  /// The motions that are complete with this action.
  Motions addAction(const mrpt::obs::CActionCollection& actions);
  /// The motions that end with this frame. `stamp` may be "no stamp".
  Motions addFrame(base::Stamp stamp);
  /// The stamp of the last action since the last frame, if it has one.
  base::Stamp pendingStamp() const { return pending_stamp_; }
  /// Number of actions that got no span so far.
  std::uint64_t dropped() const { return dropped_; }
  /// To be called at the end of the log: actions that still wait for the end of their span get none.
  void finish() { dropPending(); }

 private:
  Motions spanUntil(base::Stamp end);
  Motions takePending(base::Stamp begin, base::Stamp end);
  void dropPending();

  ActionSpan mode_;
  std::string label_;
  std::map<std::string, ActionMotion> pending_;  // by origin
  base::Stamp pending_stamp_;
  bool has_begin_ = false;   // whether a span can begin: a frame or an action has been read
  bool has_motion_ = false;  // whether a motion was ever handed out
  base::Stamp begin_;        // of the next span; "no stamp" as long as nothing had one
  std::uint64_t dropped_ = 0;
};

}  // namespace omnimapper::source
