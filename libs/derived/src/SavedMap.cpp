#include <omnimapper/base/ChildProcess.h>
#include <omnimapper/derived/Closures.h>
#include <omnimapper/derived/PlacesOfMap.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/graph/Linearized.h>
#include <omnimapper/graph/Marginals.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/map/Places.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/PlaceOnEarth.h>
#include <omnimapper/source/ObservationGate.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <sstream>
#include <unordered_map>

namespace omnimapper::derived {

namespace {

constexpr std::uint32_t kGraphVersion = 1;

/// Whether the program that writes a map computes that layer from the other data.
bool isComputedAgain(const std::string& layer) {
  return layer == map::Places::kLayer || layer == map::ClosedLoops::kLayer;
}

[[noreturn]] void refuse(const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, reason);
}

const map::MapSection& needed(const map::MapFile& file, const std::string& name) {
  const auto* section = file.find(name);
  if (!section) refuse("has no section \"" + name + "\": it is no map of OmniMapper, or damaged");
  return *section;
}

graph::Graph graphOf(const map::MapSection& section, const mapper::Kinds& kinds) {
  if (section.version > kGraphVersion) {
    refuse("section \"graph\" has version " + std::to_string(section.version) + ", and this program reads version " +
           std::to_string(kGraphVersion) + ". Use the OmniMapper that wrote it, or a later one.");
  }
  std::istringstream in(section.bytes);
  try {
    return graph::readGraph(in, kinds.factors);
  } catch (const base::Error& error) {
    if (error.code() != base::ExitCode::unregistered_class) throw;
    refuse(std::string(error.what()) +
           ". It belongs to a plugin that is not loaded: name its library in [mapper] plugin_libraries.");
  }
}

// MRPT's readers do not check counts, so a child process reads the section first. Its memory is limited, because
// observations should not take many times the uncompressed size of the section.
map::Map framesOf(const map::MapSection& section) {
  const std::uint64_t memory = (std::uint64_t{256} << 20) + 4 * map::uncompressedSize(section);
  const auto end = base::tryInChild([&] { map::framesFromSection(section); }, memory);
  switch (end.how) {
    case base::ChildOutcome::How::finished:
      break;
    case base::ChildOutcome::How::threw:
      refuse(end.message);
    case base::ChildOutcome::How::out_of_memory:
      refuse("section \"frames\" needs far more memory than its size allows: damaged");
    case base::ChildOutcome::How::crashed:
      refuse("section \"frames\" has an observation that MRPT cannot read: damaged");
  }
  return map::framesFromSection(section);
}

// Ratio of the largest to the smallest element on the diagonal of the information matrix, over all free variables.
double spreadOfInformation(const graph::Graph& graph) {
  std::unordered_map<base::VariableId, Eigen::VectorXd> information;
  for (const auto& [id, record] : graph.factors()) {
    if (record.weight == 0) continue;
    const graph::Linearized factor(graph, id);
    for (std::size_t i = 0; i < record.variables.size(); ++i) {
      if (graph.variable(record.variables[i]).fixed) continue;
      const Eigen::VectorXd more = record.weight * factor.jacobians[i].colwise().squaredNorm().transpose();
      auto& known = information.try_emplace(record.variables[i], Eigen::VectorXd::Zero(more.size())).first->second;
      known += more;
    }
  }
  double least = std::numeric_limits<double>::max(), most = 0;
  for (const auto& [id, known] : information) {
    least = std::min(least, known.minCoeff());
    most = std::max(most, known.maxCoeff());
  }
  return information.empty() ? 1 : most / least;
}

// Later computations need the covariance of every variable of the map, now and after more is added. If the information
// of two directions differs by more than the precision of a double, the smaller one is lost.
void expectDetermined(const graph::Graph& graph) {
  const std::string what = "section \"graph\" does not determine the map: damaged";
  if (!(spreadOfInformation(graph) < 1 / std::numeric_limits<double>::epsilon()))
    refuse(what + " (the information of two of its directions differs by more than the precision of a double)");
  try {
    const graph::Marginals marginals(graph);
  } catch (const base::Error& error) {
    refuse(what + " (" + error.what() + ")");
  }
}

void expectWhole(const map::Landmark& landmark, const SavedMap& saved) {
  const std::string what = "landmark " + toString(landmark.id);
  if (landmark.state == map::Landmark::State::merged) {
    const map::Landmark* into = &landmark;
    for (std::size_t steps = 0; into->state == map::Landmark::State::merged; ++steps) {
      into = saved.map.landmarks.find(into->merged_into);
      if (into == nullptr) refuse(what + " is merged into one that does not exist: damaged");
      if (steps > saved.map.landmarks.size()) refuse(what + " is merged into itself by way of others: damaged");
    }
    return;
  }
  std::vector<std::string_view> kinds;
  for (const auto variable : landmark.variables) {
    if (!saved.graph.contains(variable))
      refuse(what + " refers to variable " + toString(variable) + ", which is not in the graph: damaged");
    kinds.push_back(saved.graph.variable(variable).kind->kind());
  }
  if (!landmark.payload) return;
  if (!landmark.payload->fits(kinds)) refuse(what + " has variables that are not of its kind: damaged");
  for (const auto frame : landmark.payload->keyFrames()) {
    if (!saved.map.key_frames.find(frame))
      refuse(what + " was seen from key frame " + toString(frame) + ", which is not in the map: damaged");
  }
}

// Checks that what a layer refers to is there.
void expectWhole(const std::string& name, const map::LayerReferences& references, const SavedMap& saved) {
  const auto missing = [&](const std::string& what) {
    refuse("section \"" + name + "\" refers to " + what + ", which is not in the map: damaged");
  };
  for (const auto id : references.key_frames)
    if (!saved.map.key_frames.find(id)) missing("key frame " + toString(id));
  for (const auto id : references.landmarks)
    if (!saved.map.landmarks.find(id)) missing("landmark " + toString(id));
  for (const auto id : references.variables)
    if (!saved.graph.contains(id)) missing("variable " + toString(id));
}

// Checks that the sections agree with each other.
void expectWhole(const SavedMap& saved) {
  const auto& [map, graph] = saved;
  const auto known = [&graph = graph](base::VariableId id, const std::string& what) {
    if (!graph.contains(id))
      refuse(what + " refers to variable " + toString(id) + ", which is not in the graph: damaged");
  };
  if (map.key_frames.empty()) refuse("holds no key frame: there is nothing to continue");
  if (map.sessions.empty() || map.sessions.back().number + 1 >= mapper::Batch::kProvisionalSession) {
    refuse("has no session, or one whose number is out of range: damaged");
  }
  const auto pose_kind = graph.contains(map.key_frames.front().pose)
                             ? graph.variable(map.key_frames.front().pose).kind->kind()
                             : std::string_view();
  for (const auto& frame : map.key_frames) {
    known(frame.pose, "key frame " + toString(frame.id));
    for (const auto& observation : frame.observations) {
      if (const auto reason = source::whyUnusable(*observation))
        refuse("key frame " + toString(frame.id) + " has observations that cannot be used: " + *reason + ": damaged");
    }
    const bool has_session = std::any_of(map.sessions.begin(), map.sessions.end(),
                                         [&](const auto& session) { return session.number == frame.id.session; });
    if (!has_session || graph.variable(frame.pose).kind->kind() != pose_kind) {
      refuse("key frame " + toString(frame.id) +
             " belongs to no known session, or its pose is of another kind: damaged");
    }
  }
  for (const auto& session : map.sessions) known(session.anchor, "session " + std::to_string(session.number));
  for (const auto& [id, landmark] : map.landmarks) expectWhole(landmark, saved);
  for (const auto& [name, layer] : map.layers) expectWhole(name, layer->references(), saved);
  expectDetermined(graph);
}

SavedMap parse(const map::MapFile& file, const mapper::Kinds& kinds) {
  SavedMap saved;
  saved.map = framesOf(needed(file, "frames"));
  saved.graph = graphOf(needed(file, "graph"), kinds);
  if (const auto* landmarks = file.find("landmarks")) {
    saved.map.landmarks = map::landmarksFromSection(*landmarks, kinds.payloads);
  }
  const auto* sessions = file.find("sessions");
  saved.map.sessions = sessions ? map::sessionsFromSection(*sessions) : map::sessionsOfFrames(saved.map.key_frames);
  for (const auto& section : file.sections()) {
    if (!map::isLayerName(section.name) || isComputedAgain(section.name)) continue;
    saved.map.layers.set(section.name, kinds.layers.read(section));
  }
  mapper::adoptPlaceOnEarth(saved.map.layers, saved.graph);
  expectWhole(saved);
  return saved;
}

}  // namespace

mapper::Motion SavedMap::motion() const {
  const auto kind = graph.variable(map.key_frames.front().pose).kind->kind();
  return kind == graph::se2()->kind() ? mapper::Motion::planar : mapper::Motion::spatial;
}

SavedMap readMap(const std::string& path, const mapper::Kinds& kinds) {
  // After a crash of a live run there is only its checkpoint.
  const bool is_folder = std::filesystem::is_directory(path);
  const bool has_map = std::filesystem::exists(path + "/map.omnimap");
  const bool is_of_crash = is_folder && !has_map && std::filesystem::exists(path + "/checkpoint.omnimap");
  const std::string name = is_folder ? path + (is_of_crash ? "/checkpoint.omnimap" : "/map.omnimap") : path;
  const auto file = map::MapFile::read(name);
  try {
    return parse(file, kinds);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    refuse(name + ": " + error.what());
  }
}

map::MapFile mapFileOf(const map::Map& map, const graph::Graph& graph) {
  std::ostringstream graph_bytes;
  graph::writeGraph(graph, graph_bytes);
  map::MapFile file;
  file.set({"graph", kGraphVersion, std::move(graph_bytes).str()});
  file.set(map::framesToSection(map));
  file.set(map::landmarksToSection(map));
  file.set(map::sessionsToSection(map));
  for (const auto& [name, layer] : map.layers) {
    if (!isComputedAgain(name)) file.set(map::layerToSection(name, *layer));
  }
  return file;
}

map::MapFile mapFileToAsk(const mapper::State& state) {
  map::MapFile file = mapFileOf(state.map, state.graph);
  file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(placesOf(state))));
  if (auto closed = closedLoopsOf(state); !closed.loops.empty())
    file.set(map::layerToSection(map::ClosedLoops::kLayer, map::LayerOf<map::ClosedLoops>(std::move(closed))));
  return file;
}

}  // namespace omnimapper::derived
