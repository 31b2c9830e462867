// Planes in depth images by our segmentation, its stages and its peers in one run: on recorded frames (time) and on
// simulated rooms with a Kinect's noise (time and agreement with the truth). Prints Markdown tables. PCL's rows appear
// if bench-planes was built with PCL. Times are processor times of one thread.
//
// Example: bench-planes --depth tum_fr1_rpy/depth --every 5 --rooms 20
#include <omnimapper/base/Memory.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "../perception/PlaneAgreement.h"
#include "PlanePeers.h"
#include "Timing.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;

// All methods. `libraries`: paths of shared libraries with further ones.
std::vector<PlanePeer> methods(const std::vector<std::string>& libraries) {
  std::vector<PlanePeer> all = ourPlanes();
  for (const auto& peers : {pclPlanes(), openCvPlanes()}) all.insert(all.end(), peers.begin(), peers.end());
  for (const auto& library : libraries) {
    const auto peers = loadedPlanes(library);
    all.insert(all.end(), peers.begin(), peers.end());
  }
  return all;
}

std::vector<DepthFrame> readFrames(const std::string& folder, int every, double unit, const camera::Pinhole& camera) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<DepthFrame> frames;
  for (std::size_t i = 0; i < files.size(); i += static_cast<std::size_t>(every)) {
    const cv::Mat png = cv::imread(files[i], cv::IMREAD_UNCHANGED);
    if (png.type() != CV_16U) throw std::runtime_error(files[i] + " is not a 16-bit depth image");
    DepthFrame frame{png.cols, png.rows, unit, camera, {}};
    for (int y = 0; y < png.rows; ++y) {
      const auto* row = png.ptr<std::uint16_t>(y);
      frame.units.insert(frame.units.end(), row, row + png.cols);
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

void printTimes(const std::vector<PlanePeer>& all, const std::vector<DepthFrame>& frames, int rounds) {
  std::vector<std::vector<double>> times(all.size());
  std::vector<double> planes(all.size(), 0);
  for (int round = 0; round < rounds; ++round) {
    for (const DepthFrame& frame : frames) {
      for (std::size_t m = 0; m < all.size(); ++m) {
        const double begin = processorTime();
        const auto labels = all[m].run(frame);
        times[m].push_back(processorTime() - begin);
        planes[m] += *std::max_element(labels.begin(), labels.end());
      }
    }
  }
  std::printf(
      "%zu frames, %d times each\n\n| method | median [ms] | mean ± s.d. | 95 %% | max | 95 %% / median | planes |\n"
      "|---|---|---|---|---|---|---|\n",
      frames.size(), rounds);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const Spread spread = spreadOf(times[m]);
    const double median = quantile(times[m], 0.5), high = quantile(times[m], 0.95);
    std::printf("| %s | %.2f | %.2f ± %.2f | %.2f | %.2f | %.2f | %.1f |\n", all[m].name.c_str(), median, spread.mean,
                spread.deviation, high, quantile(times[m], 1), high / median,
                planes[m] / static_cast<double>(times[m].size()));
  }
}

// Errors of our planes against the truth: angles of normals [deg] and distances [mm].
struct Errors {
  std::vector<double> angles, distances;

  void add(const perception::rooms::Scene& scene, const perception::rooms::View& truth,
           const perception::PlaneSegmentation& found) {
    std::vector<std::vector<int>> votes(found.planes.size(), std::vector<int>(scene.faces.size() + 1, 0));
    for (std::size_t i = 0; i < found.labels.size(); ++i) {
      if (found.labels[i] > 0) ++votes[found.labels[i] - 1U][truth.face[i]];
    }
    for (std::size_t p = 0; p < votes.size(); ++p) {
      const auto face = std::max_element(votes[p].begin() + 1, votes[p].end()) - votes[p].begin() - 1;
      const auto expected = perception::rooms::planeOf(scene.faces[static_cast<std::size_t>(face)]);
      const auto& plane = found.planes[p].plane_in_sensor;
      angles.push_back(std::acos(std::min(1.0, plane.normal.dot(expected.normal))) * 180 / M_PI);
      distances.push_back(1e3 * std::abs(plane.distance - expected.distance));
    }
  }
};

void printRooms(std::vector<PlanePeer> all, int rooms, double noise_factor) {
  std::vector<perception::rooms::Agreement> sums(all.size());
  std::vector<std::vector<double>> times(all.size());
  Errors errors;
  camera::DepthNoise noise;
  noise.sigma *= noise_factor;
  for (int seed = 0; seed < rooms; ++seed) {
    testing::Dice dice(static_cast<std::uint64_t>(seed));
    const auto scene = perception::rooms::randomRoom(dice);
    const auto view = perception::rooms::render(scene);
    const auto depth = perception::rooms::withNoise(view, scene.width, scene.height, noise, dice);
    DepthFrame frame{scene.width, scene.height, 1e-4, scene.camera, {}};
    for (const float z : depth) frame.units.push_back(static_cast<std::uint16_t>(std::min(65534.0, 1e4 * z + 0.5)));
    for (std::size_t m = 0; m < all.size(); ++m) {
      const double begin = processorTime();
      const auto labels = all[m].run(frame);
      times[m].push_back(processorTime() - begin);
      sums[m] += perception::rooms::compare(view, labels, scene.width, scene.height, 1500);
    }
    errors.add(scene, view, perception::PlaneSegmenter({}).segment(imageOf(frame)));
  }
  std::printf(
      "\n%d simulated rooms, noise of %.2g mm at 1 m, %d planes of at least 1500 pixels\n\n"
      "| method | recall at IoU 0.8 | precision | pixels right | correct | over | under | missed | noise | median [ms] "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      rooms, 1e3 * noise.sigma, sums[0].true_planes);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const auto& s = sums[m];
    if (s.reported == 0) continue;  // a method that only computes normals
    std::printf("| %s | %.3f | %.3f | %.3f | %d | %d | %d | %d | %d | %.2f |\n", all[m].name.c_str(),
                s.found / static_cast<double>(s.true_planes), s.reported_right / std::max(1.0, s.reported * 1.0),
                s.pixelsRight(), s.correct, s.over, s.under, s.missed, s.noise, quantile(times[m], 0.5));
  }
  std::printf("\nOur normals are off by %.3f deg in the median and %.3f deg at 95 %%, distances by %.2f and %.2f mm.\n",
              quantile(errors.angles, 0.5), quantile(errors.angles, 0.95), quantile(errors.distances, 0.5),
              quantile(errors.distances, 0.95));
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  int every = 5, rounds = 3, rooms = 20;
  double unit = 1.0 / 5000, noise_factor = 1;
  std::vector<double> camera{517.3, 516.5, 318.6, 255.3};
  std::vector<std::string> libraries;
  CLI::App app("Compares planes in depth images by our segmentation and others.");
  app.add_option("--depth", folder, "folder of 16-bit depth images (PNG)");
  app.add_option("--every", every, "use only every n-th image")->check(CLI::PositiveNumber);
  app.add_option("--rounds", rounds, "number of runs on each image")->check(CLI::PositiveNumber);
  app.add_option("--unit", unit, "unit of the depths [m]");
  app.add_option("--camera", camera, "fx fy cx cy [px]; the default is freiburg1's")->expected(4);
  app.add_option("--rooms", rooms, "number of simulated rooms; 0: none");
  app.add_option("--noise", noise_factor, "noise in the rooms, as a factor of the default");
  app.add_option("--peer", libraries,
                 "shared library with other methods; PlanePeerLibrary.h lists the functions that it must have");
  CLI11_PARSE(app, argc, argv);
  base::keepFreedMemory();  // as our programs do
  const auto all = methods(libraries);
  if (!folder.empty()) {
    const auto frames = readFrames(folder, every, unit, {camera[0], camera[1], camera[2], camera[3]});
    printTimes(all, frames, rounds);
    printOurStages(frames, rounds);
  }
  if (rooms > 0) printRooms(all, rooms, noise_factor);
}
