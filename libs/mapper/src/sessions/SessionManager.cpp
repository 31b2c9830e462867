#include "sessions/SessionManager.h"

#include <optional>
#include <utility>

namespace omnimapper::mapper {

SessionManager::SessionManager(const SessionOptions& options, const std::string& title, BackEnd& back_end,
                               RunState& state)
    : options_(options), back_end_(back_end), state_(state) {
  const std::uint16_t number = options_.numberIn(state_.map);
  state_.graph.setSession(number);
  back_end_.beginSession({number, title, {}, true}, std::nullopt);
}

void SessionManager::continueFrom(derived::SavedMap saved, const SessionStart& start) {
  const std::uint16_t number = options_.numberIn(saved.map);
  goOn(std::move(saved), start, number);
}

void SessionManager::localizeIn(derived::SavedMap saved, const SessionStart& start, int key_frames) {
  const auto number = static_cast<std::uint16_t>(saved.map.sessions.back().number + 1);
  goOn(std::move(saved), start, number);
  back_end_.holdMap(key_frames);
}

void SessionManager::goOn(derived::SavedMap saved, const SessionStart& start, std::uint16_t number) {
  map::Session session = state_.map.sessions.back();
  state_.map = std::move(saved.map);
  state_.graph = std::move(saved.graph);
  session.number = number;
  session.aligned = false;
  state_.graph.setSession(number);
  back_end_.beginSession(session, start);
  back_end_.resume();
}

}  // namespace omnimapper::mapper
