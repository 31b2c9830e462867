// Planes of depth images: ours, its stages and its peers in one run, on recorded frames (time) and on simulated rooms
// with a Kinect's noise (time and agreement with the truth). Prints Markdown tables. PCL's and OpenCV's rows are there
// where bench-planes was built with them. Times are those of the processor, of one thread.
//
// Example: bench-planes --depth tum_fr1_rpy/depth --every 5 --rooms 20
#include <omnimapper/perception/Normals.h>
#include <omnimapper/perception/PlaneSegmenter.h>
#include <omnimapper/perception/SameLabel.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "../perception/DepthRooms.h"
#include "PlanePeers.h"
#include "planes/CellRegions.h"
#include "planes/Outlines.h"
#include "planes/PixelLabels.h"
#include "planes/RegionFit.h"
#include "planes/SmallRegions.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;
using perception::DepthImage;
using perception::PlaneOptions;

double now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

DepthImage imageOf(const DepthFrame& frame) {
  return {frame.units.data(), frame.metres_per_unit, frame.width, frame.height, frame.camera};
}

std::vector<PlanePeer> methods() {
  std::vector<PlanePeer> all{{"ours: planes, refined and traced",
                              [segmenter = perception::PlaneSegmenter(PlaneOptions())](const DepthFrame& frame) {
                                return segmenter.segment(imageOf(frame)).labels;
                              }},
                             {"ours: the same and normals of all pixels",
                              [segmenter = perception::PlaneSegmenter(PlaneOptions()),
                               estimator = perception::NormalEstimator({})](const DepthFrame& frame) {
                                const auto normals = estimator.estimate(imageOf(frame));
                                return segmenter.segment(imageOf(frame)).labels;
                              }}};
  for (const auto& peers : {pclPlanes(), openCvPlanes()}) all.insert(all.end(), peers.begin(), peers.end());
  return all;
}

std::vector<DepthFrame> readFrames(const std::string& folder, int every, double unit,
                                   const perception::Pinhole& camera) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<DepthFrame> frames;
  for (std::size_t i = 0; i < files.size(); i += static_cast<std::size_t>(every)) {
    const cv::Mat png = cv::imread(files[i], cv::IMREAD_UNCHANGED);
    if (png.type() != CV_16U) throw std::runtime_error(files[i] + " is no 16-bit depth image");
    DepthFrame frame{png.cols, png.rows, unit, camera, {}};
    for (int y = 0; y < png.rows; ++y) {
      const auto* row = png.ptr<std::uint16_t>(y);
      frame.units.insert(frame.units.end(), row, row + png.cols);
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

void printTimes(const std::vector<DepthFrame>& frames, int rounds) {
  const auto all = methods();
  std::vector<std::vector<double>> times(all.size());
  std::vector<double> planes(all.size(), 0);
  for (int round = 0; round < rounds; ++round) {
    for (const DepthFrame& frame : frames) {
      for (std::size_t m = 0; m < all.size(); ++m) {
        const double begin = now();
        const auto labels = all[m].run(frame);
        times[m].push_back(now() - begin);
        planes[m] += *std::max_element(labels.begin(), labels.end());
      }
    }
  }
  std::printf(
      "%zu frames, %d times each\n\n| method | median [ms] | 95 %% | max | 95 %% / median | planes |\n"
      "|---|---|---|---|---|---|\n",
      frames.size(), rounds);
  for (std::size_t m = 0; m < all.size(); ++m) {
    std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %.1f |\n", all[m].name.c_str(), quantile(times[m], 0.5),
                quantile(times[m], 0.95), quantile(times[m], 1), quantile(times[m], 0.95) / quantile(times[m], 0.5),
                planes[m] / static_cast<double>(times[m].size()));
  }
}

void printStages(const std::vector<DepthFrame>& frames, int rounds) {
  using namespace perception::planes;
  const PlaneOptions options;
  const auto noise = options.noise();
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  double begin = 0;
  std::size_t stage = 0;
  const auto lap = [&](const char* name) {
    const double end = now();
    if (stage == stages.size()) stages.push_back({name, {}});
    stages[stage++].second.push_back(end - begin);
    begin = now();
  };
  for (int i = 0; i < rounds * static_cast<int>(frames.size()); ++i) {
    const DepthFrame& frame = frames[static_cast<std::size_t>(i) % frames.size()];
    stage = 0;
    begin = now();
    const auto normals = perception::NormalEstimator({}).estimate(imageOf(frame));
    lap("normals of all pixels");
    const auto inverse = invert(imageOf(frame), options.min_depth, options.max_depth);
    lap("inverse depth");
    const auto grid = fitCells(inverse, frame.camera, noise);
    lap("planes of cells");
    auto grown = growRegions(grid, noise);
    lap("regions grown");
    auto merged = mergeRegions(grid, noise, std::move(grown));
    lap("regions merged");
    const auto regions = dropExplained(inverse, frame.camera, noise, grid, std::move(merged));
    lap("small regions dropped");
    const auto labels = labelPixels(inverse, frame.camera, noise, grid, regions);
    lap("pixels labelled");
    const auto components =
        perception::connectComponents(labels.stride, labels.rows, perception::SameLabel{labels.values.data()});
    lap("components");
    const auto fitted = fitRegions(inverse, frame.camera, noise, components, labels, regions, options.min_pixels);
    lap("planes of pixels");
    const auto lines = traceOutlines(labels.values, labels.stride, labels.rows, components.runs, 1);
    lap("outlines of all components");
  }
  std::printf("\n| stage of ours | median [ms] | 95 %% |\n|---|---|---|\n");
  for (const auto& [name, times] : stages) {
    std::printf("| %s | %.3f | %.3f |\n", name.c_str(), quantile(times, 0.5), quantile(times, 0.95));
  }
}

void printRooms(int rooms, double noise_factor) {
  auto all = methods();
  std::vector<perception::rooms::Agreement> sums(all.size());
  std::vector<std::vector<double>> times(all.size());
  perception::DepthNoise noise;
  noise.sigma *= noise_factor;
  for (int seed = 0; seed < rooms; ++seed) {
    testing::Dice dice(static_cast<std::uint64_t>(seed));
    const auto scene = perception::rooms::randomRoom(dice);
    const auto view = perception::rooms::render(scene);
    const auto depth = perception::rooms::withNoise(view, scene.width, scene.height, noise, dice);
    DepthFrame frame{scene.width, scene.height, 1e-4, scene.camera, {}};
    for (const float z : depth) frame.units.push_back(static_cast<std::uint16_t>(std::min(65534.0, 1e4 * z + 0.5)));
    for (std::size_t m = 0; m < all.size(); ++m) {
      const double begin = now();
      const auto labels = all[m].run(frame);
      times[m].push_back(now() - begin);
      const auto a = perception::rooms::compare(view, labels, scene.width, scene.height, 1500);
      sums[m].true_planes += a.true_planes;
      sums[m].found += a.found;
      sums[m].reported += a.reported;
      sums[m].reported_right += a.reported_right;
      sums[m].pixels_right += a.pixels_right / rooms;
    }
  }
  std::printf(
      "\n%d simulated rooms, noise of %.2g mm at 1 m, %.1f planes of at least 1500 pixels each\n\n"
      "| method | recall at IoU 0.8 | precision | pixels right | median [ms] |\n|---|---|---|---|---|\n",
      rooms, 1e3 * noise.sigma, sums[0].true_planes / static_cast<double>(rooms));
  for (std::size_t m = 0; m < all.size(); ++m) {
    const auto& s = sums[m];
    std::printf("| %s | %.3f | %.3f | %.3f | %.2f |\n", all[m].name.c_str(),
                s.found / static_cast<double>(s.true_planes), s.reported_right / std::max(1.0, s.reported * 1.0),
                s.pixels_right, quantile(times[m], 0.5));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  int every = 5, rounds = 3, rooms = 20;
  double unit = 1.0 / 5000, noise_factor = 1;
  std::vector<double> camera{517.3, 516.5, 318.6, 255.3};
  CLI::App app("Planes of depth images by ours and others.");
  app.add_option("--depth", folder, "folder of 16-bit depth images (PNG)");
  app.add_option("--every", every, "only every n-th of them")->check(CLI::PositiveNumber);
  app.add_option("--rounds", rounds, "how often each")->check(CLI::PositiveNumber);
  app.add_option("--unit", unit, "of their depths [m]");
  app.add_option("--camera", camera, "fx fy cx cy [px]; the default is freiburg1's")->expected(4);
  app.add_option("--rooms", rooms, "how many simulated rooms; 0 leaves them out");
  app.add_option("--noise", noise_factor, "of the rooms, in parts of the default");
  CLI11_PARSE(app, argc, argv);
  if (!folder.empty()) {
    const auto frames = readFrames(folder, every, unit, {camera[0], camera[1], camera[2], camera[3]});
    printTimes(frames, rounds);
    printStages(frames, rounds);
  }
  if (rooms > 0) printRooms(rooms, noise_factor);
}
