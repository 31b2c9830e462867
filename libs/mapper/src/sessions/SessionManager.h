#pragma once

#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/plugin/SessionStart.h>

#include <cstdint>
#include <string>

#include "RunState.h"
#include "back_end/BackEnd.h"

namespace omnimapper::mapper {

/// Begins the session of a run: the first one of a new map, another one of a saved map, or one that is only localized
/// in a saved map.
class SessionManager {
 public:
  /// Begins the first session of a new map, with that title. The caller owns `back_end` and `state`.
  SessionManager(const SessionOptions& options, const std::string& title, BackEnd& back_end, RunState& state);

  /// Must be called before the first observation: loads a saved map. The session becomes a new session of it, which
  /// begins at `start`. Throws Error(unreadable_input) if a plugin cannot use its section, and as
  /// SessionOptions::numberIn().
  void continueFrom(derived::SavedMap saved, const SessionStart& start);
  /// Like continueFrom(), but the map is held fixed: later key frames are only localized in it, and about `key_frames`
  /// of them are kept free.
  void localizeIn(derived::SavedMap saved, const SessionStart& start, int key_frames);

 private:
  void goOn(derived::SavedMap saved, const SessionStart& start, std::uint16_t number);

  SessionOptions options_;
  BackEnd& back_end_;
  RunState& state_;
};

}  // namespace omnimapper::mapper
