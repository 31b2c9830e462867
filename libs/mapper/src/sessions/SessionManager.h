#pragma once

#include <omnimapper/mapper/SavedMap.h>
#include <omnimapper/plugin/SessionStart.h>

#include <optional>
#include <string>

#include "RunState.h"
#include "back_end/BackEnd.h"

namespace omnimapper::mapper {

/// Begins the session that a run is: the first of a map, one more of a map that was saved, or one that is only
/// localized in it.
class SessionManager {
 public:
  /// Begins the first session of a new map, with that title. Back end and state stay the caller's.
  SessionManager(const std::string& title, BackEnd& back_end, RunState& state) : back_end_(back_end), state_(state) {
    back_end_.beginSession({0, title, {}, true}, std::nullopt);
  }

  /// Before the first observation: loads a map as it was saved. The session that was begun becomes a new one of it,
  /// which begins at `start`. Throws Error(unreadable_input) if a plugin cannot make use of its section.
  void continueFrom(SavedMap saved, const SessionStart& start);
  /// As continueFrom(), but the map is held as it is: what follows is only localized in it, and no more than about
  /// `key_frames` of it are kept free.
  void localizeIn(SavedMap saved, const SessionStart& start, int key_frames);

 private:
  BackEnd& back_end_;
  RunState& state_;
};

}  // namespace omnimapper::mapper
