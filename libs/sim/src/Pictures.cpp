#include "Pictures.h"

#include <mrpt/img/CImage.h>
#include <mrpt/img/color_maps.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/PlanDrawing.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace omnimapper::sim {

namespace {

using mrpt::img::CImage;
using mrpt::img::TColor;
using Pictures = std::vector<std::pair<std::string, CImage>>;  // each with the suffix after the label in its name

constexpr int kSide = 600;  // side of a view from above [pixel]

TColor colourOf(double share) {
  float r, g, b;
  mrpt::img::colormap(mrpt::img::cmJET, static_cast<float>(std::clamp(share, 0.0, 1.0)), r, g, b);
  return TColor(static_cast<std::uint8_t>(255 * r), static_cast<std::uint8_t>(255 * g),
                static_cast<std::uint8_t>(255 * b));
}

// Near depths are blue, the farthest is red, and pixels without a depth are black.
CImage depthPicture(const mrpt::obs::CObservation3DRangeScan& scan) {
  const int width = static_cast<int>(scan.rangeImage.cols()), height = static_cast<int>(scan.rangeImage.rows());
  CImage picture(width, height, mrpt::img::CH_RGB);
  const double farthest = std::max<int>(1, scan.rangeImage.maxCoeff());
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const int depth = scan.rangeImage(row, column);
      picture.setPixel(column, row, depth == 0 ? TColor(0, 0, 0) : colourOf(depth / farthest));
    }
  }
  return picture;
}

struct Point {
  double x, y, z;  // in the sensor's frame [m]
};

CImage viewFromAbove(const std::vector<Point>& points) {
  double reach = 1, low = 1e9, high = -1e9;
  for (const Point& p : points) {
    reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
    low = std::min(low, p.z), high = std::max(high, p.z);
  }
  const double scale = 0.48 * kSide / reach;
  CImage picture(kSide, kSide, mrpt::img::CH_RGB);
  picture.filledRectangle(0, 0, kSide - 1, kSide - 1, TColor(255, 255, 255));
  const auto pixel = [&](double metres) { return static_cast<int>(std::lround(kSide / 2 + scale * metres)); };
  for (int line = -static_cast<int>(reach); line <= reach; ++line) {
    picture.line(pixel(line), 0, pixel(line), kSide - 1, TColor(225, 225, 225));
    picture.line(0, pixel(line), kSide - 1, pixel(line), TColor(225, 225, 225));
  }
  for (const Point& p : points) {
    const TColor colour = high > low ? colourOf((p.z - low) / (high - low)) : TColor(200, 0, 0);
    const int x = pixel(p.x), y = kSide - pixel(p.y);
    picture.filledRectangle(x - 1, y - 1, x + 1, y + 1, colour);
  }
  picture.drawCircle(kSide / 2, kSide / 2, 5, TColor(0, 0, 255), 2);
  return picture;
}

Pictures picturesOf(const mrpt::obs::CObservation& observation) {
  Pictures pictures;
  std::vector<Point> points;
  if (const auto* image = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
    pictures.emplace_back("", image->image);
  } else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation)) {
    if (scan->hasIntensityImage) pictures.emplace_back("_colour", scan->intensityImage);
    if (scan->hasRangeImage) pictures.emplace_back("_depth", depthPicture(*scan));
  } else if (const auto* beams = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation)) {
    const std::size_t count = beams->getScanSize();
    for (std::size_t i = 0; i < count; ++i) {
      if (!beams->getScanRangeValidity(i)) continue;
      const double angle = beams->getScanAngle(i), range = beams->getScanRange(i);
      points.push_back({range * std::cos(angle), range * std::sin(angle), 0});
    }
  } else if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation)) {
    for (std::size_t i = 0; cloud->pointcloud && i < cloud->pointcloud->size(); ++i) {
      float x, y, z;
      cloud->pointcloud->getPointFast(i, x, y, z);
      points.push_back({x, y, z});
    }
  }
  if (!points.empty()) pictures.emplace_back("", viewFromAbove(points));
  return pictures;
}

}  // namespace

std::vector<std::string> drawPictures(const Simulation& simulation, const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& sensor : simulation.sensors()) {
    if (sensor->count() == 0) continue;
    const auto observation = sensor->measure(sensor->count() / 2).observation;
    if (!observation) continue;
    for (const auto& [ending, picture] : picturesOf(*observation)) {
      if (files.empty()) base::makeWritableFolder(folder + "/pictures");
      files.push_back("pictures/" + sensor->label() + ending + ".png");
      base::replaceFile(folder + "/" + files.back(), [&picture = picture](const std::string& temporary) {
        if (!picture.saveToFile(temporary)) throw std::runtime_error("the picture cannot be written");
      });
    }
  }
  return files;
}

std::string drawnPlan(const Simulation& simulation, double duration) {
  constexpr double kPlanStep = 0.25;  // [s] between points of a path
  PlanDrawingOptions plan;
  const auto pathOf = [&](const Track& track) {
    std::vector<Eigen::Vector2d> path;
    for (double time = 0; time < duration; time += kPlanStep) path.push_back(track.at(time)->translation.head<2>());
    return path;
  };
  plan.path = pathOf(simulation.mapFromBase());
  for (const Person& person : simulation.world().people) {
    if (person.accompanies) plan.paths_of_people.push_back(pathOf(jointOf(person, "torso").in_map));
  }
  return drawPlan(simulation.world(), plan);
}

}  // namespace omnimapper::sim
