// Planes by each comparator of PlaneExtractor and by those of PCL in one run: on recorded frames (time) and on
// simulated rooms with coloured sheets on their walls (agreement with the truth). Prints Markdown tables. PCL's rows
// appear if bench-plane_comparators was built with PCL; its back-projection is not timed. Times are processor times of
// one thread.
//
// Example: bench-plane_comparators --tum tum_fr1_rpy --every 10 --rooms 20
#include <omnimapper/perception/PlaneSegmenter.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "../perception/ColouredRooms.h"
#include "../perception/PlaneAgreement.h"
#include "ComparatorPeers.h"
#include "Timing.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;
namespace rooms = perception::rooms;

ComparatorPeer ours(const std::string& name, const perception::PlaneComparison& comparison) {
  struct Given {
    RgbdFrame frame;
    std::vector<obs::Rgb> colours;
  };
  perception::PlaneComparisonOptions options;
  options.comparison = &comparison;
  auto given = std::make_shared<Given>();
  return {"ours: " + name,
          [given](const RgbdFrame& frame) {
            given->frame = frame;
            given->colours.clear();
            for (std::size_t i = 0; i < frame.rgb.size(); i += 3)
              given->colours.push_back({frame.rgb[i], frame.rgb[i + 1], frame.rgb[i + 2]});
          },
          [given, segmenter = perception::PlaneSegmenter({}, options)] {
            const RgbdFrame& f = given->frame;
            const camera::DepthImage image(f.units.data(), f.metres_per_unit, f.width, f.height, f.camera);
            return segmenter.segment(image, given->colours).labels;
          }};
}

std::vector<ComparatorPeer> methods() {
  std::vector<ComparatorPeer> all{ours("plane", perception::kSamePlane),
                                  ours("plane_colour", perception::kSamePlaneAndColour),
                                  ours("normals", perception::kSimilarNormals)};
  for (const auto& peer : pclComparators()) all.push_back(peer);
  return all;
}

double covered(const std::vector<std::uint16_t>& labels) {
  const auto none = std::count(labels.begin(), labels.end(), 0);
  return 1 - static_cast<double>(none) / static_cast<double>(labels.size());
}

void printTimes(const std::vector<RgbdFrame>& frames, int rounds) {
  const auto all = methods();
  std::vector<std::vector<double>> times(all.size());
  std::vector<double> planes(all.size(), 0), pixels(all.size(), 0);
  for (int round = 0; round < rounds; ++round) {
    for (const RgbdFrame& frame : frames) {
      for (std::size_t m = 0; m < all.size(); ++m) {
        all[m].take(frame);
        const double begin = processorTime();
        const auto labels = all[m].run();
        times[m].push_back(processorTime() - begin);
        planes[m] += *std::max_element(labels.begin(), labels.end());
        pixels[m] += covered(labels);
      }
    }
  }
  std::printf(
      "%zu frames, %d times each\n\n| method | median [ms] | 95 %% | max | planes | pixels on planes |\n"
      "|---|---|---|---|---|---|\n",
      frames.size(), rounds);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const auto runs = static_cast<double>(times[m].size());
    std::printf("| %s | %.2f | %.2f | %.2f | %.1f | %.3f |\n", all[m].name.c_str(), quantile(times[m], 0.5),
                quantile(times[m], 0.95), quantile(times[m], 1), planes[m] / runs, pixels[m] / runs);
  }
}

void printRooms(int count) {
  const auto all = methods();
  std::vector<rooms::Agreement> sums(all.size());
  for (int seed = 0; seed < count; ++seed) {
    testing::Dice dice(static_cast<std::uint64_t>(seed));
    const auto room = rooms::colouredRoom(dice);
    const auto view = rooms::render(room.scene);
    const int width = room.scene.width, height = room.scene.height;
    RgbdFrame frame;
    frame.width = width;
    frame.height = height;
    frame.metres_per_unit = 1e-4;
    frame.camera = room.scene.camera;
    for (const float z : rooms::withNoise(view, width, height, {}, dice))
      frame.units.push_back(static_cast<std::uint16_t>(std::min(65534.0, 1e4 * static_cast<double>(z) + 0.5)));
    for (const obs::Rgb& c : rooms::picture(room, view, dice))
      frame.rgb.insert(frame.rgb.end(), {c.red, c.green, c.blue});
    for (std::size_t m = 0; m < all.size(); ++m) {
      all[m].take(frame);
      sums[m] += rooms::compare(view, all[m].run(), width, height, 1500);
    }
  }
  std::printf(
      "\n%d simulated rooms, %.1f planes of one colour of at least 1500 pixels each\n\n"
      "| method | recall at IoU 0.8 | precision | pixels right |\n|---|---|---|---|\n",
      count, sums[0].true_planes / static_cast<double>(count));
  for (std::size_t m = 0; m < all.size(); ++m) {
    const auto& s = sums[m];
    std::printf("| %s | %.3f | %.3f | %.3f |\n", all[m].name.c_str(), s.found / static_cast<double>(s.true_planes),
                s.reported_right / std::max(1.0, s.reported * 1.0), s.pixelsRight());
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string tum;
  int every = 10, rounds = 2, count = 20;
  std::vector<double> camera{517.3, 516.5, 318.6, 255.3};
  CLI::App app("Compares planes in depth and colour images by each comparator of ours and PCL's.");
  app.add_option("--tum", tum, "folder of the TUM RGB-D benchmark, with depth and rgb");
  app.add_option("--every", every, "use only every n-th of its frames")->check(CLI::PositiveNumber);
  app.add_option("--rounds", rounds, "number of runs on each frame")->check(CLI::PositiveNumber);
  app.add_option("--camera", camera, "fx fy cx cy [px]; the default is freiburg1's")->expected(4);
  app.add_option("--rooms", count, "number of simulated rooms; 0: none");
  CLI11_PARSE(app, argc, argv);
  if (!tum.empty()) printTimes(readRgbd(tum, every, {camera[0], camera[1], camera[2], camera[3]}), rounds);
  if (count > 0) printRooms(count);
}
