// Objects on tables by our finder, PCL's chain for organized clouds and PCL's supervoxels in one run, on labelled
// clouds of table-top scenes or on a log of omnimapper-simulate with `labels = true`. Prints Markdown tables. PCL's
// rows appear if bench-objects was built with PCL. Times are processor times of one thread.
//
// Example: bench-objects --clouds objects/mosd
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Error.h>
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
#include "ObjectScores.h"
#include "Timing.h"
#include "pcd_folder/PcdFolder.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;

// The options of [objects] with those of `settings`, each of the form key=value.
perception::ObjectOptions optionsWith(perception::ObjectOptions options, const std::vector<std::string>& settings) {
  const auto& table = perception::ObjectOptions::table();
  for (const std::string& setting : settings) {
    const std::string key = setting.substr(0, setting.find('='));
    std::size_t i = 0;
    while (i < table.specs().size() && table.specs()[i].key != key) ++i;
    if (i == table.specs().size() || table.set(options, i, setting.substr(std::min(key.size() + 1, setting.size()))))
      throw base::Error(base::ExitCode::command_line, "--set " + setting + ": is no option of ObjectExtractor");
  }
  return options;
}

ObjectPeer ours(const perception::ObjectOptions& options, const std::string& name) {
  perception::PlaneOptions sensor;
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

// Reads clouds from PCD files. The calibration of the camera is estimated from the clouds, since the files do not have
// it.
std::vector<LabelledCloud> readClouds(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<LabelledCloud> clouds;
  for (const auto& file : files) {
    LabelledCloud cloud{source::readPcd(file), {}, std::filesystem::path(file).stem()};
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

Result resultOf(const ObjectPeer& method, const std::vector<LabelledCloud>& clouds, std::size_t fold, std::size_t folds,
                bool is_in_fold) {
  Result result;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    if ((i % folds == fold) == is_in_fold) compare(clouds[i].points, method.run(clouds[i]), result);
  }
  return result;
}

// Chooses the concave angle by all folds but one, the one with the most objects found and among these the most precise,
// and prints what it gives on that one.
void printFolds(const perception::ObjectOptions& options, const std::vector<LabelledCloud>& clouds, std::size_t folds,
                std::size_t fewest) {
  std::printf(
      "\n| fold | concave_angle_deg, chosen on the others | objects | recall | precision |\n|---|---|---|---|---|\n");
  double objects = 0, found = 0, detected = 0;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    double chosen = 0;
    Point best;
    for (const double degrees : {10, 15, 20, 25, 30, 35, 40, 50, 60}) {
      const auto method = ours(optionsWith(options, {"concave_angle_deg=" + std::to_string(degrees)}), "");
      const Point point = at(curveOf(resultOf(method, clouds, fold, folds, false)), fewest);
      if (std::make_pair(point.recall, point.precision) <= std::make_pair(best.recall, best.precision)) continue;
      best = point;
      chosen = degrees;
    }
    const auto method = ours(optionsWith(options, {"concave_angle_deg=" + std::to_string(chosen)}), "");
    const Result result = resultOf(method, clouds, fold, folds, true);
    const Point point = at(curveOf(result), fewest);
    std::printf("| %zu | %.0f | %d | %.3f | %.3f |\n", fold + 1, chosen, result.objects, point.recall, point.precision);
    objects += result.objects;
    found += point.recall * result.objects;
    detected += point.recall * result.objects / point.precision;
  }
  std::printf("| all | | %.0f | %.3f | %.3f |\n", objects, found / objects, found / detected);
}

void printEach(const ObjectPeer& method, const std::vector<LabelledCloud>& clouds, std::size_t fewest) {
  std::printf("\n| cloud | objects | right | wrong |\n|---|---|---|---|\n");
  for (const auto& cloud : clouds) {
    Result result;
    compare(cloud.points, method.run(cloud), result);
    int right = 0, wrong = 0;
    for (const auto& [pixels, is_right] : result.detections) {
      if (pixels >= fewest) ++(is_right ? right : wrong);
    }
    std::printf("| %s | %d | %d | %d |\n", cloud.name.c_str(), result.objects, right, wrong);
  }
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
  std::vector<std::string> settings;
  std::size_t folds = 0;
  bool each = false;
  app.add_option("--set", settings, "KEY=VALUE of [objects]; each adds a row with this option");
  app.add_option("--folds", folds, "number of folds of a cross-validation of concave_angle_deg over the clouds");
  app.add_flag("--each", each, "prints what ours finds in each cloud");
  app.add_option("--rounds", rounds, "number of runs on each cloud");
  CLI11_PARSE(app, argc, argv);
  base::keepFreedMemory();  // as our programs do
  const auto clouds = folder.empty() ? readSimulated(simulated) : readClouds(folder);

  using Comparator = perception::ObjectOptions::Comparator;
  perception::ObjectOptions convex, euclidean;
  convex.min_points = static_cast<int>(std::min<std::size_t>(fewest, 300));
  convex.max_tilt = tilt_deg * M_PI / 180;
  euclidean = convex;
  euclidean.comparator = Comparator::euclidean;
  std::vector<ObjectPeer> methods{ours(euclidean, "ours, euclidean"), ours(convex, "ours, locally_convex")};
  for (const auto& setting : settings) methods.push_back(ours(optionsWith(convex, {setting}), "ours, " + setting));
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
  if (each) printEach(methods[1], clouds, fewest);
  if (folds > 0) printFolds(convex, clouds, folds, fewest);
}
