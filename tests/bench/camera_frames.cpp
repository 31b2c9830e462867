// Measures the processor time of simulated camera frames, and writes pictures of them for inspection.
#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/sim/Sensor.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "DeskScene.h"

namespace {

using namespace omnimapper;

const char* kSensors = R"([kinect]
class = RgbdCamera
labels = true
[xtion]
class = RgbdCamera
model = xtion
[stereo]
class = RgbdCamera
model = stereo
[ideal]
class = RgbdCamera
model = ideal
[picture]
class = ColourCamera
pan_sweep_deg = 30
)";

// Colours by depth: blue is near, red is far, black has no depth.
mrpt::img::CImage coloured(const mrpt::obs::CObservation3DRangeScan& scan) {
  const int width = static_cast<int>(scan.rangeImage.cols()), height = static_cast<int>(scan.rangeImage.rows());
  mrpt::img::CImage image(width, height, mrpt::img::CH_RGB);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double depth = scan.rangeImage(row, column) * static_cast<double>(scan.rangeUnits);
      float r = 0, g = 0, b = 0;
      if (depth > 0) mrpt::img::hsv2rgb(static_cast<float>(0.66 - 0.66 * std::min(1.0, depth / 5)), 1, 1, r, g, b);
      image.setPixel(column, row, mrpt::img::TColor(255 * r, 255 * g, 255 * b));
    }
  }
  return image;
}

void save(const mrpt::obs::CObservation& observation, const std::string& stem) {
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation)) {
    (void)scan->intensityImage.saveToFile(stem + "_colour.png");
    (void)coloured(*scan).saveToFile(stem + "_depth.png");
  } else if (const auto* image = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
    (void)image->image.saveToFile(stem + ".png");
  }
}

sim::Track lookAround() {
  std::vector<sim::Track::Place> places;
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.1 * i;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5 * std::sin(0.5 * t), Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(0.35 + 0.25 * std::sin(0.7 * t), Eigen::Vector3d::UnitY()));
    places.push_back({t, geometry::Se3{turn, {-0.3 + 0.1 * std::sin(t), -0.1, 1.4}}});
  }
  return {sim::Track::Kind::motion, places};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times simulated camera frames of a desk scene and, with --save, writes them as PNG.");
  int frames = 10;
  std::string folder;
  app.add_option("--frames", frames, "Frames of each sensor");
  app.add_option("--save", folder, "Folder for pictures");
  CLI11_PARSE(app, argc, argv);
  if (!folder.empty()) std::filesystem::create_directories(folder);
  const sim::World world = bench::DeskScene::office();
  const sim::Scenes scenes(world);
  const sim::Track map_from_base = lookAround();
  const base::Config config = base::Config::fromText(kSensors, "sensors");
  for (const std::string name : {"kinect", "xtion", "stereo", "ideal", "picture"}) {
    sim::SensorContext context;
    context.duration = 30;
    context.world = &world;
    context.scenes = &scenes;
    context.map_from_base = &map_from_base;
    const auto sensor = sim::makeSensor(config, name, context);
    double total = 0;
    for (int i = 0; i < frames; ++i) {
      const int k = (37 * i) % sensor->count();
      const std::clock_t begin = std::clock();
      const sim::Measurement measurement = sensor->measure(k);
      total += 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      if (folder.empty()) continue;
      save(*measurement.observation, folder + "/" + name + "_" + std::to_string(k));
      for (const auto& file : measurement.truth_files) {
        std::ofstream(folder + "/" + std::filesystem::path(file.name).filename().string(), std::ios::binary)
            << file.bytes;
      }
    }
    std::cout << name << ": " << total / frames << " ms of one processor for a frame of 640 x 480\n";
  }
  return 0;
}
