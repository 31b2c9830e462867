// Objects on tables by our finder, PCL's chain for organized clouds and PCL's supervoxels in one run, on labelled
// clouds of table-top scenes or on a log of omnimapper-simulate with `labels = true`. Prints Markdown tables. PCL's
// rows appear if bench-objects was built with PCL. Times are processor times of one thread.
//
// Example: bench-objects --clouds objects/mosd
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Memory.h>
#include <omnimapper/perception/ObjectFinder.h>
#include <omnimapper/source/RawlogSource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "ObjectPeers.h"
#include "Timing.h"
#include "pcd_folder/PcdFolder.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;

constexpr std::uint32_t kFirstObject = 20;  // labels from here on are those of objects
constexpr std::uint32_t kNeither = 10;  // label of furniture, which stands on the floor like objects but is not counted
constexpr double kFewest = 300;         // least number of points of an object that counts
constexpr double kRight = 0.5;          // least intersection over union of a right detection

ObjectPeer ours(double tilt, perception::ObjectOptions::Comparator comparator, const std::string& name) {
  perception::PlaneOptions sensor;
  perception::ObjectOptions options;
  options.comparator = comparator;
  options.min_points = 100;
  options.max_tilt = tilt;
  const perception::PlaneSegmenter segmenter(sensor);
  const perception::ObjectFinder finder(options, sensor);
  return {name, [=](const LabelledCloud& cloud) {
            const auto& points = cloud.points;
            const camera::DepthImage image(points.z.data(), points.width, points.height, cloud.camera);
            Objects objects;
            for (auto& found : finder.find(image, segmenter.segment(image), -Eigen::Vector3d::UnitY()))
              objects.push_back(std::move(found.pixels));
            return objects;
          }};
}

/// One detection, in any of the clouds.
struct Detection {
  std::size_t pixels;
  bool right;  // its intersection over union with an object is at least kRight
};

struct Result {
  std::vector<Detection> detections;
  int objects = 0, merged = 0;  // merged: objects that are mostly covered by one detection together with another object
  double overlap = 0;           // sum over objects of the best intersection over union
  std::vector<double> milliseconds;
};

void compare(const source::PcdCloud& cloud, const Objects& found, Result& result) {
  std::map<std::uint32_t, double> sizes;
  for (const auto label : cloud.labels) {
    if (label >= kFirstObject) ++sizes[label];
  }
  for (auto size = sizes.begin(); size != sizes.end();) size = size->second < kFewest ? sizes.erase(size) : ++size;
  std::map<std::uint32_t, double> best;
  std::map<std::uint32_t, std::size_t> covers;
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::map<std::uint32_t, double> shared;
    for (const int pixel : found[i]) ++shared[cloud.labels[static_cast<std::size_t>(pixel)]];
    if (shared[kNeither] > 0.5 * static_cast<double>(found[i].size())) continue;
    double most = 0;
    for (const auto& [label, count] : shared) {
      if (sizes.count(label) == 0) continue;
      const double overlap = count / (sizes[label] + static_cast<double>(found[i].size()) - count);
      most = std::max(most, overlap);
      best[label] = std::max(best[label], overlap);
      if (count > 0.5 * sizes[label]) covers[label] = i + 1;
    }
    result.detections.push_back({found[i].size(), most >= kRight});
  }
  std::map<std::size_t, int> objects_of;
  for (const auto& [label, i] : covers) ++objects_of[i];
  for (const auto& [label, i] : covers) result.merged += objects_of[i] > 1;
  for (const auto& [label, size] : sizes) {
    ++result.objects;
    result.overlap += best[label];
  }
}

/// Recall and precision if detections with fewer than `fewest` pixels are left out.
struct Point {
  std::size_t fewest = 0;
  double recall = 0, precision = 0;
};

std::vector<Point> curveOf(const Result& result) {
  auto detections = result.detections;
  std::sort(detections.begin(), detections.end(),
            [](const Detection& a, const Detection& b) { return a.pixels > b.pixels; });
  std::vector<Point> curve;
  double right = 0;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    right += detections[i].right;
    curve.push_back({detections[i].pixels, right / result.objects, right / static_cast<double>(i + 1)});
  }
  return curve;
}

// The point with the highest recall among those with at least this precision.
Point bestAt(const std::vector<Point>& curve, double precision) {
  Point best;
  for (const Point& point : curve) {
    if (point.precision >= precision && point.recall > best.recall) best = point;
  }
  return best;
}

// Recall and precision if clusters of fewer than `fewest` points do not count.
Point at(const std::vector<Point>& curve, std::size_t fewest) {
  Point last;
  for (const Point& point : curve) {
    if (point.fewest >= fewest) last = point;
  }
  return last;
}

// Reads clouds from PCD files. The calibration of the camera is estimated from the clouds, since the files do not have
// it.
std::vector<LabelledCloud> readClouds(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<LabelledCloud> clouds;
  for (const auto& file : files) {
    LabelledCloud cloud{source::readPcd(file), {}};
    const auto camera = source::depthImageOf(cloud.points, file)->cameraParams;
    cloud.camera = {camera.fx(), camera.fy(), camera.cx(), camera.cy()};
    clouds.push_back(std::move(cloud));
  }
  return clouds;
}

// For each number of a surface in a simulated world, the label of the object that it belongs to, kNeither for frames of
// furniture, and 1 for all other surfaces.
std::map<std::uint32_t, std::uint32_t> objectsOfSurfaces(const std::string& folder) {
  std::ifstream file(folder + "/landmarks.json");
  const auto world = nlohmann::json::parse(file);
  std::map<std::string, std::uint32_t> objects;
  for (const auto& object : world["objects"])
    objects.emplace(object["name"], kFirstObject + static_cast<std::uint32_t>(objects.size()));
  std::map<std::uint32_t, std::uint32_t> labels;
  for (const auto& surface : world["surfaces"]) {
    const auto object = objects.find(surface["body"]);
    const std::string name = surface["name"];
    const bool is_frame = name.size() > 6 && name.substr(name.size() - 6) == "/frame";
    labels[surface["label"]] = object != objects.end() ? object->second : is_frame ? kNeither : 1;
  }
  return labels;
}

LabelledCloud cloudOf(const mrpt::obs::CObservation3DRangeScan& scan, const cv::Mat& surfaces,
                      const std::map<std::uint32_t, std::uint32_t>& objects) {
  LabelledCloud cloud;
  const auto& camera = scan.cameraParams;
  cloud.camera = {camera.fx(), camera.fy(), camera.cx(), camera.cy()};
  source::PcdCloud& points = cloud.points;
  points.width = static_cast<int>(scan.rangeImage.cols());
  points.height = static_cast<int>(scan.rangeImage.rows());
  for (int y = 0; y < points.height; ++y) {
    for (int x = 0; x < points.width; ++x) {
      const auto range = static_cast<float>(scan.rangeImage(y, x)) * scan.rangeUnits;
      const float z = range > 0 ? range : std::nanf("");
      points.x.push_back(z * static_cast<float>((x - camera.cx()) / camera.fx()));
      points.y.push_back(z * static_cast<float>((y - camera.cy()) / camera.fy()));
      points.z.push_back(z);
      const auto object = objects.find(surfaces.at<std::uint16_t>(y, x));
      points.labels.push_back(range > 0 && object != objects.end() ? object->second : 0);
    }
  }
  return cloud;
}

// Reads the log of omnimapper-simulate: depth images, and the true surface of each pixel.
std::vector<LabelledCloud> readSimulated(const std::string& folder) {
  const auto objects = objectsOfSurfaces(folder);
  std::vector<std::string> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/truth/labels"))
    pictures.push_back(entry.path());
  std::sort(pictures.begin(), pictures.end());
  std::vector<LabelledCloud> clouds;
  const auto name = std::filesystem::path(folder).filename().string();
  source::RawlogSource log(folder + "/" + name + ".rawlog");
  while (const auto observation = log.next()) {
    const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
    if (!scan) continue;
    clouds.push_back(cloudOf(*scan, cv::imread(pictures.at(clouds.size()), cv::IMREAD_UNCHANGED), objects));
  }
  return clouds;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares objects on tables by our finder and two methods of PCL.");
  std::string folder, simulated;
  double tilt_deg = 75;
  int rounds = 3;
  std::size_t fewest = 1000;
  auto* input = app.add_option_group("input")->require_option(1);
  input->add_option("--clouds", folder, "folder of organized PCD files with labels, 20 and above for objects");
  input->add_option("--simulated", simulated,
                    "folder that omnimapper-simulate wrote, with one camera that has labels = true");
  app.add_option("--tilt", tilt_deg,
                 "largest tilt of tables from the level of the camera [deg], whose pose is not used");
  app.add_option("--fewest", fewest,
                 "least number of points of a cluster that counts in the columns recall and precision");
  app.add_option("--rounds", rounds, "number of runs on each cloud");
  CLI11_PARSE(app, argc, argv);
  base::keepFreedMemory();  // as our programs do
  const auto clouds = folder.empty() ? readSimulated(simulated) : readClouds(folder);

  using Comparator = perception::ObjectOptions::Comparator;
  std::vector<ObjectPeer> methods{ours(tilt_deg * M_PI / 180, Comparator::euclidean, "ours, euclidean"),
                                  ours(tilt_deg * M_PI / 180, Comparator::locally_convex, "ours, locally_convex")};
  for (const auto& peers : {pclObjects(), lccpObjects()}) methods.insert(methods.end(), peers.begin(), peers.end());
  std::vector<Result> results(methods.size());
  for (int round = 0; round < rounds; ++round) {
    for (const auto& cloud : clouds) {
      for (std::size_t m = 0; m < methods.size(); ++m) {
        const double start = processorTime();
        const Objects found = methods[m].run(cloud);
        results[m].milliseconds.push_back(processorTime() - start);
        if (round == 0) compare(cloud.points, found, results[m]);
      }
    }
  }
  std::printf("%zu clouds, %d objects, %d times each\n\n", clouds.size(), results[0].objects, rounds);
  std::printf(
      "| method | recall | precision | recall at precision 0.7 | 0.9 | 1 | objects merged | mean overlap | median "
      "[ms] "
      "| 95 %% |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto curve = curveOf(results[m]);
    const Point usual = at(curve, fewest);
    std::printf("| %s | %.3f | %.3f | %.3f | %.3f | %.3f | %d | %.3f | %.2f | %.2f |\n", methods[m].name.c_str(),
                usual.recall, usual.precision, bestAt(curve, 0.7).recall, bestAt(curve, 0.9).recall,
                bestAt(curve, 1).recall, results[m].merged, results[m].overlap / results[m].objects,
                quantile(results[m].milliseconds, 0.5), quantile(results[m].milliseconds, 0.95));
  }
}
