#include <omnimapper/map/MapFile.h>

#include "SectionBytes.h"

namespace omnimapper::map {

namespace {
const std::string kSessionsName = "sessions";
constexpr std::uint32_t kSessionsVersion = 1;
}  // namespace

MapSection sessionsToSection(const Map& map) {
  ByteWriter out;
  out.uint(map.sessions.size(), 4);
  for (const Session& session : map.sessions) {
    out.uint(session.number, 2);
    out.block(session.title);
    writeId(out, session.anchor);
    out.uint(session.aligned, 1);
    out.uint(session.aligned_at.has_value(), 1);
    if (session.aligned_at) writeId(out, *session.aligned_at);
  }
  return {kSessionsName, kSessionsVersion, out.take()};
}

std::vector<Session> sessionsFromSection(const MapSection& section) {
  expectSection(section, kSessionsName, kSessionsVersion);
  ByteReader in(section.bytes, placeOf(kSessionsName));
  std::vector<Session> sessions;
  for (std::uint64_t left = in.uint(4); left > 0; --left) {
    Session session;
    session.number = static_cast<std::uint16_t>(in.uint(2));
    session.title = in.block();
    session.anchor = readId<base::VariableTag>(in);
    session.aligned = in.uint(1) != 0;
    if (in.uint(1) != 0) session.aligned_at = readId<base::KeyFrameTag>(in);
    if (!sessions.empty() && session.number <= sessions.back().number) {
      refuse(kSessionsName, "session " + std::to_string(session.number) + " is out of order: the file is damaged");
    }
    sessions.push_back(std::move(session));
  }
  expectEnd(in, kSessionsName);
  return sessions;
}

std::vector<Session> sessionsOfFrames(const KeyFrames& key_frames) {
  std::vector<Session> sessions;
  for (const KeyFrame& frame : key_frames) {
    if (!sessions.empty() && sessions.back().number == frame.id.session) continue;
    Session session;
    session.number = frame.id.session;
    session.anchor = frame.pose;
    sessions.push_back(std::move(session));
  }
  return sessions;
}

}  // namespace omnimapper::map
