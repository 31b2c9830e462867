// Frames of a range camera per second when everything is extracted from them: planes, objects and five kinds of edges.
// Several threads are used in two ways: a task is a frame, as in omnimapper-perceive and the mapper, or a kind of
// feature of a frame. Frames are in memory. Times are wall times, so no other program should run. Prints a Markdown
// table.
//
// Example: bench-perception_rate --tum tum_fr1_rpy --threads 2
#include <omnimapper/base/Memory.h>
#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/perception/EdgeExtractor.h>
#include <omnimapper/perception/ObjectExtractor.h>
#include <omnimapper/source/openLogs.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "Timing.h"

namespace {

using namespace omnimapper;
using Scan = mrpt::obs::CObservation3DRangeScan;
using Scans = std::vector<Scan::ConstPtr>;
using Work = std::function<bool(const Scan&)>;

Scans readScans(const std::string& folder, int every) {
  const auto images = source::openLogs({folder}, {});
  Scans scans;
  for (int i = 0; const auto observation = images->next(); ++i) {
    auto scan = std::dynamic_pointer_cast<const Scan>(observation);
    if (scan && i % every == 0) scans.push_back(std::move(scan));
  }
  return scans;
}

// Frames per second, where a task is either all work on a frame or one piece of that work.
double rateOf(const Scans& scans, const std::vector<Work>& work, int threads, bool frame_is_a_task) {
  using Clock = std::chrono::steady_clock;
  base::WorkerPool pool(threads);
  std::vector<std::future<bool>> done;
  const auto begin = Clock::now();
  for (const auto& scan : scans) {
    if (frame_is_a_task) {
      done.push_back(pool.submit<bool>([&work, scan] {
        for (const auto& piece : work) piece(*scan);
        return true;
      }));
    } else {
      for (const auto& piece : work) done.push_back(pool.submit<bool>([&piece, scan] { return piece(*scan); }));
    }
  }
  for (auto& each : done) each.get();
  return static_cast<double>(scans.size()) / std::chrono::duration<double>(Clock::now() - begin).count();
}

void printRow(const std::string& name, const Scans& scans, const std::vector<Work>& work, int threads,
              bool frame_is_a_task, int rounds) {
  std::vector<double> rates;
  for (int i = 0; i < rounds; ++i) rates.push_back(rateOf(scans, work, threads, frame_is_a_task));
  std::printf("| %s | %d | %s | %.0f | %.0f | %.0f |\n", name.c_str(), threads, frame_is_a_task ? "frame" : "kind",
              bench::quantile(rates, 0.5), bench::quantile(rates, 0), bench::quantile(rates, 1));
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  int every = 3, threads = 2, rounds = 5;
  CLI::App app("Measures how many frames of a range camera per second all extractors process.");
  app.add_option("--tum", folder, "folder of depth and colour images in the TUM layout")->required();
  app.add_option("--every", every, "use only every n-th pair of images")->check(CLI::PositiveNumber);
  app.add_option("--threads", threads, "largest number of threads")->check(CLI::PositiveNumber);
  app.add_option("--rounds", rounds, "number of rounds")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  base::keepFreedMemory();  // as our programs do

  const auto scans = readScans(folder, every);
  perception::ObjectExtractor::Options options;
  options.objects.max_tilt = M_PI / 2;  // the images have no information on which way is up
  const perception::PlaneExtractor planes(options.planes, options.outlines);
  const perception::ObjectExtractor objects(options);
  const perception::EdgeExtractor edges({});
  const Work find_planes = [&](const Scan& scan) { return planes.extract(scan) != nullptr; };
  const Work find_objects = [&](const Scan& scan) { return objects.extract(scan).planes != nullptr; };
  const Work find_edges = [&](const Scan& scan) { return !edges.extract(scan).empty(); };

  std::printf(
      "%zu frames, %d times\n\n| what | threads | a task is a | frames/s, median | least | most "
      "|\n|---|---|---|---|---|---|\n",
      scans.size(), rounds);
  for (int n = 1; n <= threads; ++n) {
    printRow("planes", scans, {find_planes}, n, true, rounds);
    printRow("planes and objects", scans, {find_objects}, n, true, rounds);
    printRow("five kinds of edges", scans, {find_edges}, n, true, rounds);
    printRow("everything", scans, {find_objects, find_edges}, n, true, rounds);
    if (n > 1) printRow("everything", scans, {find_objects, find_edges}, n, false, rounds);
  }
}
