#pragma once

#include <omnimapper/map/Map.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace omnimapper::plugins {

template <class... Numbers>
std::string evidenceText(const char* pattern, Numbers... numbers) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, numbers...);
  return text;
}

// Such as "12 s after the start"; names the session if there are several.
inline std::string afterStart(const map::Map& map, const map::KeyFrame& frame) {
  const auto first = std::find_if(map.key_frames.begin(), map.key_frames.end(),
                                  [&](const map::KeyFrame& one) { return one.id.session == frame.id.session; });
  const std::string of_session = map.sessions.size() > 1 ? " of session " + std::to_string(frame.id.session) : "";
  return evidenceText("%.0f s after the start", base::secondsBetween(first->stamp, frame.stamp)) + of_session;
}

}  // namespace omnimapper::plugins
