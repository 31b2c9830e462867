#pragma once

namespace omnimapper::mapper {

/// What a measurement plugin also is that seeks the newest session, while nothing ties it to the saved map, in all of
/// that map.
class SeeksSession {
 public:
  virtual ~SeeksSession() = default;
  /// Whether it does so now: it has something of the map and of the session to compare.
  virtual bool isSeeking() const = 0;
};

/// What a measurement plugin also is whose landmarks many places have alike, such as walls: one of them is too little
/// to tell where a session lies, and what it ties wrongly hides the session from those who seek it.
class LeavesSeeking {
 public:
  virtual ~LeavesSeeking() = default;
  /// Told before each key frame is measured: while `others_seek`, nothing ties the newest session to those before.
  virtual void leaveSeeking(bool others_seek) = 0;
};

}  // namespace omnimapper::mapper
