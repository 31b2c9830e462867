#include "run/Checkpoints.h"

#include <omnimapper/derived/SavedMap.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace omnimapper::mapper {

Checkpoints::Checkpoints(std::string path, double period)
    : path_(std::move(path)),
      writer_([this](const State& state) { derived::mapFileToAsk(state).write(path_); }, period) {}

std::string Checkpoints::offer(const View& view) {
  if (view.map_is_held) return "";
  const std::string problem = writer_.offer(view);
  return problem.empty() ? "" : "the checkpoint of the map cannot be written: " + problem;
}

void Checkpoints::removeFor(const std::string& map) {
  namespace fs = std::filesystem;
  writer_.wait();
  std::error_code missing, none;
  const auto written = fs::last_write_time(map, missing);
  if (writer_.count() > 0 && !missing && written >= fs::last_write_time(path_, none)) fs::remove(path_, none);
}

}  // namespace omnimapper::mapper
