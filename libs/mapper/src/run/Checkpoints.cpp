#include "run/Checkpoints.h"

#include <omnimapper/derived/SavedMap.h>

#include <exception>
#include <filesystem>
#include <system_error>

namespace omnimapper::mapper {

Checkpoints::~Checkpoints() {
  if (written_.valid()) written_.wait();
}

std::string Checkpoints::offer(const View& view) {
  const auto now = std::chrono::steady_clock::now();
  if (written_.valid()) {
    if (written_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return "";
    return finished();
  }
  if (period_.count() <= 0 || now - last_ < period_ || view.map.key_frames.empty() || view.map_is_held) return "";
  last_ = now;
  copy_ = std::make_unique<const Snapshot>(Snapshot{view.map, view.graph, view.uncertainty});
  written_ = std::async(std::launch::async,
                        [copy = copy_.get(), path = path_] { derived::mapFileToAsk(copy->state()).write(path); });
  return "";
}

std::string Checkpoints::finished() {
  std::string problem;
  try {
    written_.get();
    ++count_;
  } catch (const std::exception& error) {
    problem = "the checkpoint of the map cannot be written: " + std::string(error.what());
  }
  copy_.reset();
  return problem;
}

void Checkpoints::removeFor(const std::string& map) {
  namespace fs = std::filesystem;
  if (written_.valid()) finished();
  std::error_code missing, none;
  const auto written = fs::last_write_time(map, missing);
  if (count_ > 0 && !missing && written >= fs::last_write_time(path_, none)) fs::remove(path_, none);
}

}  // namespace omnimapper::mapper
