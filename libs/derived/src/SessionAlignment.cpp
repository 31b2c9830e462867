#include <omnimapper/derived/SessionAlignment.h>
#include <omnimapper/graph/VariableKinds.h>

#include <algorithm>
#include <map>

namespace omnimapper::derived {

namespace {

std::optional<base::KeyFrameId> frameOf(const graph::FactorRecord& record, std::uint16_t session, const map::Map& map) {
  for (const auto& frame : map.key_frames) {
    const bool bound =
        std::find(record.variables.begin(), record.variables.end(), frame.pose) != record.variables.end();
    if (bound && frame.id.session == session) return frame.id;
  }
  return std::nullopt;
}

// A factor between landmarks alone does not determine where a session lies.
bool bindsPose(const graph::FactorRecord& record, const graph::Graph& graph, std::optional<std::uint16_t> session) {
  return std::any_of(record.variables.begin(), record.variables.end(), [&](base::VariableId id) {
    const auto kind = graph.variable(id).kind->kind();
    return (!session || id.session == *session) && (kind == graph::se2()->kind() || kind == graph::se3()->kind());
  });
}

}  // namespace

void markAligned(map::Map& map, const graph::Graph& graph, const std::set<std::string>& absolute) {
  if (map.sessions.size() < 2) return;
  const std::uint16_t first = map.sessions.front().number;
  std::map<std::uint16_t, std::uint16_t> group;  // sessions that are tied to each other have the same number
  for (auto& session : map.sessions) {
    group[session.number] = session.number;
    session.aligned = session.number == first;
    session.aligned_at.reset();
  }
  for (const auto& [id, record] : graph.factors()) {
    if (record.weight <= 0) continue;
    const auto [low, high] =
        std::minmax_element(record.variables.begin(), record.variables.end(),
                            [](base::VariableId a, base::VariableId b) { return a.session < b.session; });
    const std::uint16_t from = absolute.count(record.tags.owner) > 0 ? first : low->session, to = high->session;
    if (from == to || group[from] == group[to] || !bindsPose(record, graph, std::nullopt)) continue;
    const std::uint16_t kept = std::min(group[from], group[to]), gone = std::max(group[from], group[to]);
    for (auto& session : map.sessions) {
      if (group[session.number] != gone) continue;
      group[session.number] = kept;
      if (kept != first) continue;
      session.aligned = true;
      session.aligned_at = frameOf(record, to, map);
    }
  }
}

void markLocated(map::Map& map, const graph::Graph& graph, const std::set<std::string>& absolute) {
  auto& session = map.sessions.back();
  session.aligned = false;
  session.aligned_at.reset();
  const auto is_aligned = [&](base::VariableId id) {
    return id.session != session.number &&
           std::any_of(map.sessions.begin(), map.sessions.end(),
                       [&](const auto& other) { return other.number == id.session && other.aligned; });
  };
  for (const auto& [id, record] : graph.factors()) {
    const bool ties = std::any_of(record.variables.begin(), record.variables.end(), is_aligned);
    if (record.weight <= 0 || (!ties && absolute.count(record.tags.owner) == 0)) continue;
    if (!bindsPose(record, graph, session.number)) continue;
    session.aligned = true;
    session.aligned_at = frameOf(record, session.number, map);
    return;
  }
}

TestedTies testedTies(const graph::Graph& graph, std::uint16_t session) {
  TestedTies ties;
  for (const auto& [id, record] : graph.factors()) {
    if (!record.tags.hypothesis || id.session != session) continue;
    const auto& variables = record.variables;
    if (std::all_of(variables.begin(), variables.end(), [&](auto v) { return v.session == session; })) continue;
    ++(record.weight > 0 ? ties.accepted : ties.refused);
  }
  return ties;
}

std::string alignedText(const map::Session& session) {
  const std::string name = "session " + std::to_string(session.number);
  if (!session.aligned) return name + " was never aligned";
  return name + " was aligned" + (session.aligned_at ? " at key frame " + toString(*session.aligned_at) : "");
}

}  // namespace omnimapper::derived
