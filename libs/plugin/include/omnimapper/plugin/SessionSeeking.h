#pragma once

namespace omnimapper::mapper {

/// A second base class for measurement plugins that search the whole saved map for the newest session while nothing
/// ties it to the map.
class SeeksSession {
 public:
  virtual ~SeeksSession() = default;
  /// Whether it is searching now: it needs data of both the map and the session to compare.
  virtual bool isSeeking() const = 0;
};

/// A second base class for measurement plugins whose landmarks look alike in many places, such as walls. One of them
/// does not determine where a session lies, and a wrong tie to it ends the search of the plugins that seek.
class LeavesSeeking {
 public:
  virtual ~LeavesSeeking() = default;
  /// Called before each key frame is measured. `others_seek` is true while the newest session is not tied to the
  /// earlier ones and another plugin is searching for it.
  virtual void leaveSeeking(bool others_seek) = 0;
};

}  // namespace omnimapper::mapper
