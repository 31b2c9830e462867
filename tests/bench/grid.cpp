// Times the occupancy grid of a map: built from scratch, and updated after a closure that moves a fifth of the key
// frames, beside MRPT's grid, which has to be built anew. The map is used with once, twice and four times its key
// frames; each copy is shifted by a few centimetres, like another pass through the building. Prints a Markdown table.
//
// Example: bench-grid -m out/aces/map.omnimap -m out/intel/map.omnimap
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/derived/GridMapper.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/derived/forEachScan.h>
#include <omnimapper/grid/ScanBeams.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace omnimapper;
using mrpt::poses::CPose3D;

constexpr int kRepeats = 5;

map::Map repeated(const map::Map& once, int times) {
  map::Map all;
  for (int copy = 0; copy < times; ++copy) {
    for (map::KeyFrame frame : once.key_frames) {
      frame.id.session = static_cast<std::uint16_t>(frame.id.session + 100 * copy);
      frame.map_from_base = CPose3D(0.013 * copy, -0.017 * copy, 0, 0.001 * copy, 0, 0) + frame.map_from_base;
      all.key_frames.insert(frame);
    }
  }
  return all;
}

/// The map with the last fifth of each session turned and shifted as by a closure, increasingly towards the end.
map::Map closed(const map::Map& before) {
  map::Map after = before;
  const auto& frames = before.key_frames;
  for (std::size_t begin = 0, end; begin < frames.size(); begin = end) {
    for (end = begin; end < frames.size() && frames[end].id.session == frames[begin].id.session;) ++end;
    const std::size_t first = end - (end - begin) / 5;
    for (std::size_t i = first; i < end; ++i) {
      const double part = static_cast<double>(i - first + 1) / static_cast<double>(end - first);
      auto& frame = after.key_frames.edit(frames[i].id);
      frame.map_from_base =
          CPose3D(0.3 * part, 0.2 * part, 0, 0, 0, 0) + frame.map_from_base + CPose3D(0, 0, 0, 0.03 * part, 0, 0);
    }
  }
  return after;
}

/// Builds MRPT's grid over the area of the scans and inserts every scan.
std::size_t buildWithMrpt(const map::Map& map, const derived::ScanGrid& area, double max_range) {
  mrpt::maps::COccupancyGridMap2D grid(static_cast<float>(area.min_x), static_cast<float>(area.maxX()),
                                       static_cast<float>(area.min_y), static_cast<float>(area.maxY()),
                                       static_cast<float>(area.resolution));
  grid.insertionOptions.maxOccupancyUpdateCertainty = 0.75f;
  grid.insertionOptions.maxFreenessUpdateCertainty = 0.62f;
  grid.insertionOptions.considerInvalidRangesAsFreeSpace = false;
  for (const map::KeyFrame& frame : map.key_frames) {
    derived::forEachScan(frame, [&](const auto& scan) {
      grid.insertionOptions.maxDistanceInsertion = std::min(static_cast<float>(max_range), 0.9999f * scan->maxRange);
      grid.insertObservation(*scan, frame.map_from_base);
    });
  }
  return grid.getSizeX();
}

/// Stopwatch for the processor time of this thread, which other programs on the machine do not affect.
class ThreadWatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double start_ = now();
};

double fastest(const std::function<double()>& run) {
  double best = run();
  for (int i = 1; i < kRepeats; ++i) best = std::min(best, run());
  return best;
}

struct Row {
  double mrpt = 0, scratch = 0, update = 0, picture = 0;  // [s]
  std::size_t key_frames = 0;
};

Row measure(const map::Map& map, const derived::ScanGridOptions& options) {
  const map::Map after = closed(map);
  Row row;
  row.key_frames = map.key_frames.size();
  const auto area = derived::buildScanGrid(map, options);
  row.mrpt = fastest([&] {
    const ThreadWatch watch;
    buildWithMrpt(map, *area, options.max_range);
    return watch.seconds();
  });
  row.scratch = fastest([&] {
    const ThreadWatch watch;
    derived::GridMapper grid(options);
    grid.update(map);
    return watch.seconds();
  });
  derived::GridMapper grid(options);
  grid.update(map);
  row.picture = fastest([&] {
    const ThreadWatch watch;
    grid.scanGrid();
    return watch.seconds();
  });
  row.update = fastest([&] {
    const ThreadWatch watch;
    grid.update(after);
    const double seconds = watch.seconds();
    grid.update(map);
    return seconds;
  });
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the occupancy grid of saved maps against MRPT's.");
  std::vector<std::string> maps;
  derived::ScanGridOptions options;
  app.add_option("-m,--map", maps, "map.omnimap of a run")->required()->check(CLI::ExistingFile);
  app.add_option("--resolution_m", options.resolution, "Side of a cell");
  app.add_option("--max_range_m", options.max_range, "Beams are inserted up to this length");
  CLI11_PARSE(app, argc, argv);
  options.max_cells = 1e9;
  try {
    omnimapper::mapper::loadFeatures();
    std::printf(
        "| map | times | key frames | MRPT rebuild [ms] | ours, from scratch [ms] | ratio | ours, a fifth moved "
        "[ms] | ratio | cells out [ms] |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const auto& path : maps) {
      const auto once = derived::readMap(path, mapper::registeredKinds()).map;
      for (const int times : {1, 2, 4}) {
        const Row row = measure(repeated(once, times), options);
        std::printf("| %s | %d | %zu | %.1f | %.1f | %.3f | %.1f | %.3f | %.1f |\n",
                    std::filesystem::path(path).parent_path().filename().c_str(), times, row.key_frames, 1e3 * row.mrpt,
                    1e3 * row.scratch, row.scratch / row.mrpt, 1e3 * row.update, row.update / row.mrpt,
                    1e3 * row.picture);
      }
    }
  } catch (const std::exception& error) {
    std::cerr << "bench-grid: " << error.what() << "\n";
    return 1;
  }
}
