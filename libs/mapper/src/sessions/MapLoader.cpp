#include "sessions/MapLoader.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <exception>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "sessions/removeForbidden.h"

namespace omnimapper::mapper {

namespace {

// A start pose that is not given must not silently be zero.
void refuseStartWithoutPose(const SessionOptions& session, const base::Config& config) {
  if (session.start != SessionOptions::Start::pose) return;
  for (const char* key : {"start_x_m", "start_y_m", "start_yaw_deg"}) {
    std::string there;
    if (config.section("session").find(key, there)) return;
  }
  throw base::Error(base::ExitCode::out_of_range, config.placeOf("session", "start") +
                                                      ": [session] start = pose needs start_x_m, start_y_m and "
                                                      "start_yaw_deg; for the map's own origin use start = origin");
}

}  // namespace

void loadMapInto(const RunRequest& request, const EngineSettings& settings, const base::Config& config,
                 Engine& engine) {
  const SessionOptions& session = settings.session;
  const std::string& path = request.localize_map.empty() ? request.continue_map : request.localize_map;
  if (path.empty()) return;
  auto saved = derived::readMap(path, registeredKinds());
  if (saved.motion() != settings.engine.motion) {
    const std::string of_map = saved.motion() == Motion::planar ? "planar" : "spatial";
    throw base::Error(base::ExitCode::unreadable_input,
                      path + ": the map is " + of_map + ", which [mapper] motion of " + config.file() +
                          " is not: continue it with motion = " + of_map + ", or map its log again");
  }
  refuseStartWithoutPose(session, config);
  const auto start = session.startOn(saved.map);
  try {
    if (request.localize_map.empty()) {
      const auto forbidden = removeForbidden(saved, settings.solver.final());
      engine.sessions().continueFrom(std::move(saved), start);
      for (const auto& sentence : forbidden.removed) engine.note(sentence);
      for (const auto& sentence : forbidden.kept) engine.warn(sentence);
      return;
    }
    engine.sessions().localizeIn(std::move(saved), start, session.window_key_frames);
  } catch (const base::Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (
      const std::exception& error) {  // the parts of the map do not fit together, such as a landmark of another kind
    throw base::Error(base::ExitCode::unreadable_input,
                      path + ": the map cannot be continued (" + error.what() + "): damaged. Use another copy of it.");
  }
}

void checkRequest(const RunRequest& request) {
  namespace fs = std::filesystem;
  if (request.localize_map.empty()) return;
  if (!request.continue_map.empty()) {
    throw base::Error(base::ExitCode::command_line,
                      "--continue adds to a map, --localize leaves it as it is: give one of them");
  }
  std::error_code error;
  if (fs::exists(fs::path(request.output_folder) / "map.omnimap", error)) {
    throw base::Error(
        base::ExitCode::command_line,
        "-o " + request.output_folder +
            " is the folder of a map, whose trajectory and report would be replaced: give another folder");
  }
}

}  // namespace omnimapper::mapper
