// Planes in unorganized clouds by our finder and PCL's chain in one run: on recorded depth images as clouds (time) and
// on simulated rooms with a Kinect's noise (time and agreement with the truth). Prints Markdown tables. PCL's rows
// appear if bench-cloud_planes was built with PCL. Times are processor times of one thread.
//
// Example: bench-cloud_planes --depth tum_fr1_rpy/depth --every 30 --rooms 20
#include <omnimapper/perception/CloudPlaneFinder.h>
#include <omnimapper/perception/OrganizedPoints.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "../perception/PlaneAgreement.h"
#include "CloudPeers.h"
#include "Timing.h"
#include "clouds/VoxelGrid.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;
using Cloud = std::vector<Eigen::Vector3f>;

constexpr int kMinPoints = 150;

struct Work {
  Cloud points;
  perception::clouds::Voxels voxels;
  perception::CloudPlanes found;
};

std::vector<CloudPeer> methods(double tolerance) {
  perception::CloudPlaneOptions options;
  options.noise_at_1m = 0.0023;
  options.min_points = kMinPoints;
  auto averaged = options;
  averaged.voxel = 0;
  auto work = std::make_shared<Work>();
  const auto take = [work, options](const Cloud& points) {
    work->points = points;
    work->voxels = perception::clouds::averaged(points, options.voxel, options.min_range, options.max_range);
  };
  const auto labels = [work] { return work->found.labels; };
  const auto labels_of_voxels = [work] {
    std::vector<std::uint16_t> of_point;
    for (const int voxel : work->voxels.of_point)
      of_point.push_back(voxel < 0 ? std::uint16_t{0} : work->found.labels[static_cast<std::size_t>(voxel)]);
    return of_point;
  };
  std::vector<CloudPeer> all{
      {"ours, averaged before", take,
       [work, finder = perception::CloudPlaneFinder(averaged)] { work->found = finder.find(work->voxels.means); },
       labels_of_voxels},
      {"ours, averaging counted", take,
       [work, finder = perception::CloudPlaneFinder(options)] { work->found = finder.find(work->points); }, labels}};
  for (auto& peer : pclCloudPlanes(tolerance, kMinPoints)) all.push_back(std::move(peer));
  return all;
}

Cloud cloudOf(const camera::DepthImage& image) {
  const auto points = perception::backProject(image, 0.3, 12);
  Cloud cloud;
  for (std::size_t i = 0; i < points.z.size(); ++i) cloud.emplace_back(points.x[i], points.y[i], points.z[i]);
  return cloud;
}

std::vector<Cloud> readClouds(const std::string& folder, int every, const camera::Pinhole& camera) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Cloud> clouds;
  for (std::size_t i = 0; i < files.size(); i += static_cast<std::size_t>(every)) {
    const cv::Mat png = cv::imread(files[i], cv::IMREAD_UNCHANGED);
    if (png.type() != CV_16U) throw std::runtime_error(files[i] + " is not a 16-bit depth image");
    clouds.push_back(cloudOf({png.ptr<std::uint16_t>(), 1.0 / 5000, png.cols, png.rows, camera}));
  }
  return clouds;
}

// The points that were measured: those that are not NaN.
Cloud measured(const Cloud& cloud) {
  Cloud kept;
  for (const auto& p : cloud) {
    if (p.allFinite()) kept.push_back(p);
  }
  return kept;
}

void printTimes(const std::vector<Cloud>& clouds, double tolerance) {
  const auto all = methods(tolerance);
  std::vector<std::vector<double>> times(all.size());
  std::vector<double> planes(all.size(), 0);
  double points = 0, voxels = 0;
  for (const Cloud& with_gaps : clouds) {
    const Cloud cloud = measured(with_gaps);
    points += static_cast<double>(cloud.size());
    voxels += static_cast<double>(perception::clouds::averaged(cloud, 0.025, 0.3, 100).means.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
      all[m].take(cloud);
      const double begin = processorTime();
      all[m].run();
      times[m].push_back(processorTime() - begin);
      if (!all[m].labels) continue;
      const auto labels = all[m].labels();
      planes[m] += *std::max_element(labels.begin(), labels.end());
    }
  }
  const auto n = static_cast<double>(clouds.size());
  std::printf(
      "%zu clouds of %.0f points, %.0f after averaging\n\n| method | median [ms] | mean ± s.d. | 95 %% | max | planes "
      "|\n"
      "|---|---|---|---|---|---|\n",
      clouds.size(), points / n, voxels / n);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const Spread spread = spreadOf(times[m]);
    std::printf("| %s | %.2f | %.2f ± %.2f | %.2f | %.2f | %.1f |\n", all[m].name.c_str(), quantile(times[m], 0.5),
                spread.mean, spread.deviation, quantile(times[m], 0.95), quantile(times[m], 1), planes[m] / n);
  }
}

void printRooms(int rooms, double tolerance) {
  const auto all = methods(tolerance);
  std::vector<perception::rooms::Agreement> sums(all.size());
  std::vector<std::vector<double>> times(all.size());
  const camera::DepthNoise noise;
  for (int seed = 0; seed < rooms; ++seed) {
    testing::Dice dice(static_cast<std::uint64_t>(seed));
    const auto scene = perception::rooms::randomRoom(dice);
    const auto view = perception::rooms::render(scene);
    const auto depth = perception::rooms::withNoise(view, scene.width, scene.height, noise, dice);
    const Cloud cloud = cloudOf({depth.data(), scene.width, scene.height, scene.camera});
    for (std::size_t m = 0; m < all.size(); ++m) {
      all[m].take(measured(cloud));
      const double begin = processorTime();
      all[m].run();
      times[m].push_back(processorTime() - begin);
      if (!all[m].labels) continue;
      const auto of_measured = all[m].labels();
      std::vector<std::uint16_t> labels(cloud.size(), 0);
      for (std::size_t i = 0, k = 0; i < cloud.size(); ++i) labels[i] = cloud[i].allFinite() ? of_measured[k++] : 0;
      sums[m] += perception::rooms::compare(view, labels, scene.width, scene.height, 1500);
    }
  }
  std::printf(
      "\n%d simulated rooms\n\n| method | recall at IoU 0.8 | precision | points right | median [ms] |\n"
      "|---|---|---|---|---|\n",
      rooms);
  for (std::size_t m = 0; m < all.size(); ++m) {
    if (!all[m].labels) continue;
    const auto& s = sums[m];
    std::printf("| %s | %.3f | %.3f | %.3f | %.2f |\n", all[m].name.c_str(),
                s.found / static_cast<double>(s.true_planes), s.reported_right / std::max(1.0, s.reported * 1.0),
                s.pixelsRight(), quantile(times[m], 0.5));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  int every = 30, rooms = 20;
  double tolerance = 0.03;
  std::vector<double> camera{517.3, 516.5, 318.6, 255.3};
  CLI::App app("Compares planes in unorganized clouds by our finder and PCL's chain.");
  app.add_option("--depth", folder, "folder of 16-bit depth images (PNG), 5000 a metre");
  app.add_option("--every", every, "use only every n-th image")->check(CLI::PositiveNumber);
  app.add_option("--camera", camera, "fx fy cx cy [px]; the default is freiburg1's")->expected(4);
  app.add_option("--rooms", rooms, "number of simulated rooms; 0: none");
  app.add_option("--tolerance", tolerance, "[m] distance tolerance of PCL's planes");
  CLI11_PARSE(app, argc, argv);
  if (!folder.empty()) printTimes(readClouds(folder, every, {camera[0], camera[1], camera[2], camera[3]}), tolerance);
  if (rooms > 0) printRooms(rooms, tolerance);
}
