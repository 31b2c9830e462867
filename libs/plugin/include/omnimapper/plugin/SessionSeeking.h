#pragma once

namespace omnimapper::mapper {

/// A second base class for measurement plugins that search the whole saved map for the newest session while nothing
/// ties it to the map.
class SeeksSession {
 public:
  virtual ~SeeksSession() = default;
  /// Whether the plugin is searching now: it needs data of both the map and the session to compare them.
  virtual bool isSeeking() const = 0;
};

/// A second base class for measurement plugins that compare what they see with the saved map, at the place where the
/// newest session lies by the estimate.
class ConfirmsSession {
 public:
  virtual ~ConfirmsSession() = default;
  /// What the newest key frames show. unable: the plugin has no data that could show anything. nothing: what is seen
  /// neither confirms nor contradicts the place, as where the map has nothing.
  enum class Says { unable, nothing, confirmed, contradicted };
  virtual Says aboutSession() const = 0;
};

/// A second base class for measurement plugins whose landmarks look alike in many places, such as walls. A single such
/// landmark does not determine where a session lies, and a wrong association with it would end the search of the
/// plugins that search the map.
class LeavesSeeking {
 public:
  virtual ~LeavesSeeking() = default;
  /// Called before each key frame is measured. `others_seek` is true while the newest session is not tied to the
  /// earlier ones and another plugin is searching for it.
  virtual void leaveSeeking(bool others_seek) = 0;
};

}  // namespace omnimapper::mapper
