#include "sessions/SessionManager.h"

#include <cstdint>
#include <utility>

namespace omnimapper::mapper {

void SessionManager::continueFrom(derived::SavedMap saved, const SessionStart& start) {
  map::Session session = state_.map.sessions.back();
  state_.map = std::move(saved.map);
  state_.graph = std::move(saved.graph);
  session.number = static_cast<std::uint16_t>(state_.map.sessions.empty() ? 0 : state_.map.sessions.back().number + 1);
  session.aligned = false;
  state_.graph.setSession(session.number);
  back_end_.beginSession(session, start);
  back_end_.resume();
}

void SessionManager::localizeIn(derived::SavedMap saved, const SessionStart& start, int key_frames) {
  continueFrom(std::move(saved), start);
  back_end_.holdMap(key_frames);
}

}  // namespace omnimapper::mapper
