// Our plane segmentation as a whole, and up to some of its stages.
#include <omnimapper/perception/Normals.h>
#include <omnimapper/perception/ObjectFinder.h>
#include <omnimapper/perception/PlaneSegmenter.h>
#include <omnimapper/perception/SameLabel.h>

#include <cstdio>

#include "PlanePeers.h"
#include "Timing.h"
#include "planes/CellRegions.h"
#include "planes/Outlines.h"
#include "planes/PixelLabels.h"
#include "planes/RegionFit.h"
#include "planes/SmallRegions.h"

namespace omnimapper::bench {

using namespace perception::planes;
using camera::DepthImage;
using perception::PlaneOptions;

DepthImage imageOf(const DepthFrame& frame) {
  return {frame.units.data(), frame.metres_per_unit, frame.width, frame.height, frame.camera};
}

namespace {

using Labels = std::vector<std::uint16_t>;

// Stops as soon as each cell of 16 x 16 pixels is assigned to a plane.
Labels coarse(const DepthFrame& frame) {
  const PlaneOptions options;
  const auto noise = options.noise();
  const auto inverse = invert(imageOf(frame), options.min_depth, options.max_depth);
  const auto grid = fitCells(inverse, frame.camera, noise);
  const auto regions = mergeRegions(grid, noise, growRegions(grid, noise));
  Labels labels(frame.units.size(), 0);
  for (int y = 0; y < frame.height; ++y) {
    std::uint16_t* const row = labels.data() + static_cast<std::ptrdiff_t>(y) * frame.width;
    for (int x = 0; x < frame.width; ++x) {
      const int region = regions.of_cell[static_cast<std::size_t>(grid.index(x / kCell, y / kCell))];
      row[x] = static_cast<std::uint16_t>(region + 1);
    }
  }
  return labels;
}

// Stops as soon as each pixel is assigned to a plane: no plane is fitted again and no outline is traced.
Labels unrefined(const DepthFrame& frame) {
  const PlaneOptions options;
  const auto noise = options.noise();
  const auto inverse = invert(imageOf(frame), options.min_depth, options.max_depth);
  const auto grid = fitCells(inverse, frame.camera, noise);
  const auto regions =
      dropExplained(inverse, frame.camera, noise, grid, mergeRegions(grid, noise, growRegions(grid, noise)));
  const auto padded = labelPixels(inverse, frame.camera, noise, grid, regions);
  Labels labels;
  labels.reserve(frame.units.size());
  for (int y = 0; y < frame.height; ++y) {
    const auto row = padded.values.begin() + static_cast<std::ptrdiff_t>(y) * padded.stride;
    labels.insert(labels.end(), row, row + frame.width);
  }
  return labels;
}

}  // namespace

std::vector<PlanePeer> ourPlanes() {
  const perception::PlaneSegmenter segmenter((PlaneOptions()));
  return {
      {"ours: cells only", coarse},
      {"ours: planes of pixels, neither refined nor traced", unrefined},
      {"ours: planes, refined and traced",
       [segmenter](const DepthFrame& frame) { return segmenter.segment(imageOf(frame)).labels; }},
      {"ours: planes, refined and traced, and normals of all pixels",
       [segmenter, estimator = perception::NormalEstimator({})](const DepthFrame& frame) {
         const auto normals = estimator.estimate(imageOf(frame));
         return segmenter.segment(imageOf(frame)).labels;
       }},
      {"ours: planes, refined and traced, normals, and Euclidean clusters off the planes",
       [segmenter, estimator = perception::NormalEstimator({})](const DepthFrame& frame) {
         const auto normals = estimator.estimate(imageOf(frame));
         auto found = segmenter.segment(imageOf(frame));
         perception::ObjectOptions options;
         options.comparator = perception::ObjectOptions::Comparator::euclidean;
         options.on_surfaces_only = false;
         const auto clusters =
             perception::ObjectFinder(options, PlaneOptions()).find(imageOf(frame), found, -Eigen::Vector3d::UnitY());
         return std::move(found.labels);
       }}};
}

void printOurStages(const std::vector<DepthFrame>& frames, int rounds) {
  const PlaneOptions options;
  const auto noise = options.noise();
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  double begin = 0;
  std::size_t stage = 0;
  const auto lap = [&](const char* name) {
    const double end = processorTime();
    if (stage == stages.size()) stages.push_back({name, {}});
    stages[stage++].second.push_back(end - begin);
    begin = processorTime();
  };
  for (int i = 0; i < rounds * static_cast<int>(frames.size()); ++i) {
    const DepthFrame& frame = frames[static_cast<std::size_t>(i) % frames.size()];
    stage = 0;
    begin = processorTime();
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

}  // namespace omnimapper::bench
