// Edges in depth and colour images by our detector and its peers in one run: on recorded frames (time, and agreement
// with PCL's edges) and on simulated ones (agreement with the truth). Prints Markdown tables. PCL's rows appear if
// bench-edges was built with PCL. Times are processor times of one thread.
//
// Example: bench-edges --tum tum_fr1_rpy --every 10 --ini rawlogs/home.ini --sensor kinect --frames 20
#include <omnimapper/base/Memory.h>
#include <omnimapper/perception/EdgeDetector.h>
#include <omnimapper/perception/Normals.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "EdgePeers.h"
#include "EdgeTruth.h"
#include "Timing.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;
using perception::EdgeOptions;

constexpr unsigned kDepthEdges = perception::kBoundary | perception::kOccluding | perception::kOccluded;

using Labels = std::vector<std::uint8_t>;

EdgePeer ours(const std::string& name, const EdgeOptions& options, bool with_picture, unsigned points_of) {
  auto frame = std::make_shared<RgbdFrame>();
  return {name, [frame](const RgbdFrame& given) { *frame = given; },
          [frame, with_picture, points_of, detector = perception::EdgeDetector(options)] {
            const camera::DepthImage image(frame->units.data(), frame->metres_per_unit, frame->width, frame->height,
                                           frame->camera);
            const camera::ColourImage colour{frame->rgb.data(), frame->width, frame->height, 3 * frame->width,
                                             camera::ColourImage::Order::rgb};
            auto edges = with_picture ? detector.detect(image, colour) : detector.detect(image);
            if (points_of != 0) perception::edgePoints(edges, image, points_of);
            return std::move(edges.labels);
          }};
}

EdgePeer openCvCanny() {
  auto frame = std::make_shared<RgbdFrame>();
  return {"OpenCV cvtColor + Canny", [frame](const RgbdFrame& given) { *frame = given; },
          [frame] {
            const cv::Mat rgb(frame->height, frame->width, CV_8UC3, frame->rgb.data());
            cv::Mat grey, edges;
            cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
            cv::Canny(grey, edges, 40, 100);
            Labels labels(edges.begin<std::uint8_t>(), edges.end<std::uint8_t>());
            for (auto& label : labels) label = label != 0 ? perception::kRgb : 0;
            return labels;
          }};
}

std::vector<EdgePeer> methods() {
  EdgeOptions none;
  none.jumps = none.high_curvature = none.rgb = false;
  EdgeOptions depth_edges = none, curvature = none, rgb = none;
  depth_edges.jumps = curvature.high_curvature = rgb.rgb = true;
  std::vector<EdgePeer> all{ours("ours: occluding, occluded, boundary", depth_edges, false, 0),
                            ours("ours: the same, with points", depth_edges, false, kDepthEdges),
                            ours("ours: high curvature, with normals", curvature, false, 0),
                            ours("ours: RGB, with points", rgb, true, perception::kRgb),
                            ours("ours: all five, with normals", EdgeOptions(), true, 0),
                            openCvCanny()};
  for (const auto& peer : pclEdges()) all.push_back(peer);
  return all;
}

// Share of the pixels of one label image with a kind of edge that are near a pixel of the other image with that kind.
// Counts may be summed over images.
struct Share {
  double near = 0, all = 0;
  double value() const { return all > 0 ? near / all : 0; }
};

cv::Mat masked(const Labels& labels, unsigned kind, int width) {
  cv::Mat mask(static_cast<int>(labels.size()) / width, width, CV_8U);
  std::transform(labels.begin(), labels.end(), mask.begin<std::uint8_t>(),
                 [&](std::uint8_t label) { return (label & kind) != 0 ? 255 : 0; });
  return mask;
}

void add(const Labels& one, const Labels& other, unsigned kind, int width, int reach, Share& share) {
  const cv::Mat mask = masked(one, kind, width);
  cv::Mat wide;
  cv::dilate(masked(other, kind, width), wide,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  share.all += cv::countNonZero(mask);
  share.near += cv::countNonZero(mask & wide);
}

// Removes high-curvature labels near pixels for which the truth is undetermined, so that they are not counted.
Labels judged(Labels labels, const Labels& truth, int width, int reach) {
  cv::Mat undetermined;
  cv::dilate(masked(truth, kUndetermined, width), undetermined,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (undetermined.data[i] != 0) labels[i] &= static_cast<std::uint8_t>(~perception::kHighCurvature);
  }
  return labels;
}

void printTimes(const std::vector<RgbdFrame>& frames, int rounds) {
  const auto all = methods();
  std::vector<std::vector<double>> times(all.size());
  for (int round = 0; round < rounds; ++round) {
    for (const RgbdFrame& frame : frames) {
      for (std::size_t m = 0; m < all.size(); ++m) {
        all[m].take(frame);
        const double begin = processorTime();
        const auto labels = all[m].run();
        times[m].push_back(processorTime() - begin);
      }
    }
  }
  std::printf(
      "%zu frames, %d times each\n\n| method | median [ms] | mean ± s.d. | 95 %% | max |\n|---|---|---|---|---|\n",
      frames.size(), rounds);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const Spread spread = spreadOf(times[m]);
    std::printf("| %s | %.2f | %.2f ± %.2f | %.2f | %.2f |\n", all[m].name.c_str(), quantile(times[m], 0.5),
                spread.mean, spread.deviation, quantile(times[m], 0.95), quantile(times[m], 1));
  }
}

void printAgreement(const std::vector<RgbdFrame>& frames, int reach) {
  const auto ours_all = ours("", EdgeOptions(), true, 0), canny = openCvCanny();
  const auto pcl = pclEdgesOfAllKinds();
  std::printf(
      "\nShares within %d px of the other's edges of the same kind\n\n| kind | peer | share of ours near the peer's | "
      "share of the peer's near ours | pixels of ours | of the peer's |\n|---|---|---|---|---|---|\n",
      reach);
  const auto print = [&](perception::EdgeKind kind, const EdgePeer& peer) {
    Share of_ours, of_peer;
    for (const RgbdFrame& frame : frames) {
      ours_all.take(frame);
      peer.take(frame);
      const Labels a = ours_all.run();
      Labels b = peer.run();
      // Our detector reports no edges where there is no depth.
      for (std::size_t i = 0; i < b.size() && kind == perception::kRgb; ++i) b[i] = frame.units[i] == 0 ? 0 : b[i];
      add(a, b, kind, frame.width, reach, of_ours);
      add(b, a, kind, frame.width, reach, of_peer);
    }
    const auto n = static_cast<double>(frames.size());
    std::printf("| %s | %s | %.3f | %.3f | %.0f | %.0f |\n", nameOf(kind), peer.name.c_str(), of_ours.value(),
                of_peer.value(), of_ours.all / n, of_peer.all / n);
  };
  for (const auto kind : perception::kEdgeKinds) {
    if (kind == perception::kRgb) print(kind, canny);
    for (std::size_t i = 0; i < pcl.size() && kind != perception::kRgb; ++i) {
      const bool depends_on_threshold = kind != perception::kHighCurvature;
      if (i == 0 || depends_on_threshold) print(kind, pcl[i]);
    }
  }
}

struct TruthOptions {
  std::string ini, sensor = "kinect";
  std::vector<std::string> settings;
  int frames = 20, reach = 3;
  double least_discontinuity = 0.02, least_turn_deg = 45, nearest = 0.5;
};

std::vector<TrueEdges> simulate(const TruthOptions& options) {
  auto config = base::Config::fromFiles({options.ini});
  for (const auto& setting : options.settings) config.set(setting);
  for (const char* truth : {"labels", "true_depth"}) config.set(options.sensor + "." + truth + "=true");
  const sim::Simulation simulation(config);
  EdgeTruth truth(simulation, options.least_discontinuity,
                  options.least_turn_deg * base::option_text::kRadiansPerDegree, options.nearest);
  std::vector<TrueEdges> frames;
  for (const auto& sensor : simulation.sensors()) {
    if (sensor->label() != options.sensor) continue;
    for (int i = 0; i < options.frames; ++i) frames.push_back(truth.at(*sensor, i * sensor->count() / options.frames));
  }
  return frames;
}

void printTruth(const TruthOptions& options) {
  const auto frames = simulate(options);
  std::printf(
      "\n%zu frames of %s, %s: depth discontinuities of at least %g of the depth, surfaces that meet at %g degrees or "
      "more, within %d px\n\n"
      "| kind | method | precision | recall | F1 | pixels | true pixels |\n|---|---|---|---|---|---|---|\n",
      frames.size(), std::filesystem::path(options.ini).filename().c_str(), options.sensor.c_str(),
      options.least_discontinuity, options.least_turn_deg, options.reach);
  std::vector<EdgePeer> all{ours("ours", EdgeOptions(), true, 0)};
  for (const auto& peer : pclEdgesOfAllKinds()) all.push_back(peer);
  std::vector<std::vector<Labels>> results(all.size());
  for (std::size_t m = 0; m < all.size(); ++m) {
    for (const TrueEdges& frame : frames) {
      all[m].take(frame.frame);
      results[m].push_back(judged(all[m].run(), frame.labels, frame.frame.width, options.reach));
    }
  }
  for (const auto kind :
       {perception::kBoundary, perception::kOccluding, perception::kOccluded, perception::kHighCurvature}) {
    const bool is_there = std::any_of(frames.begin(), frames.end(), [kind](const TrueEdges& frame) {
      return std::any_of(frame.labels.begin(), frame.labels.end(), [kind](unsigned label) { return label & kind; });
    });
    if (!is_there) continue;  // for example boundaries in a closed room, where no surface ends
    for (std::size_t m = 0; m < all.size(); ++m) {
      Share precision, recall;
      for (std::size_t i = 0; i < frames.size(); ++i) {
        add(results[m][i], frames[i].labels, kind, frames[i].frame.width, options.reach, precision);
        add(frames[i].labels, results[m][i], kind, frames[i].frame.width, options.reach, recall);
      }
      const double p = precision.value(), r = recall.value();
      const auto n = static_cast<double>(frames.size());
      std::printf("| %s | %s | %.3f | %.3f | %.3f | %.0f | %.0f |\n", nameOf(kind), all[m].name.c_str(), p, r,
                  p + r > 0 ? 2 * p * r / (p + r) : 0, precision.all / n, recall.all / n);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string tum;
  int every = 10, rounds = 3, agreement = 2;
  std::vector<double> camera{517.3, 516.5, 318.6, 255.3};
  TruthOptions truth;
  CLI::App app("Compares edges in depth images by our detector and others.");
  app.add_option("--tum", tum, "folder of the TUM RGB-D benchmark, with depth and rgb");
  app.add_option("--every", every, "use only every n-th of its frames")->check(CLI::PositiveNumber);
  app.add_option("--rounds", rounds, "number of runs on each frame")->check(CLI::PositiveNumber);
  app.add_option("--camera", camera, "fx fy cx cy [px]; the default is freiburg1's")->expected(4);
  app.add_option("--ini", truth.ini, "INI of a simulated place");
  app.add_option("--set", truth.settings, "section.key=value, overrides that INI");
  app.add_option("--sensor", truth.sensor, "label of its RgbdCamera");
  app.add_option("--frames", truth.frames, "number of its frames")->check(CLI::PositiveNumber);
  app.add_option("--reach", truth.reach, "[px] largest distance between found and true edges")
      ->check(CLI::PositiveNumber);
  app.add_option("--jump", truth.least_discontinuity, "least true depth discontinuity, in parts of the depth");
  app.add_option("--nearest", truth.nearest, "[m] shortest range of that camera; the longest is in its observations");
  app.add_option("--turn", truth.least_turn_deg, "[deg] least true angle at which surfaces meet");
  CLI11_PARSE(app, argc, argv);
  base::keepFreedMemory();  // as our programs do
  if (!tum.empty()) {
    const auto frames = readRgbd(tum, every, {camera[0], camera[1], camera[2], camera[3]});
    printTimes(frames, rounds);
    printAgreement(frames, agreement);
  }
  if (!truth.ini.empty()) printTruth(truth);
}
