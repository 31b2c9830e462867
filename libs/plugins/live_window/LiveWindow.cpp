#include "LiveWindow.h"

#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <algorithm>
#include <chrono>

#include "LiveScene.h"

namespace omnimapper::plugins {

const base::OptionTable<LiveWindowOptions>& LiveWindowOptions::table() {
  using Options = LiveWindowOptions;
  static const auto table =
      base::OptionTable<Options>()
          .integer("width_pixels", &Options::width, {200, 8000}, "Width of the window.")
          .integer("height_pixels", &Options::height, {200, 8000}, "Height of the window.")
          .integer("points_per_key_frame", &Options::points_per_key_frame, {1, 1000000},
                   "Largest number of points drawn for each key frame.")
          .number("max_range_m", &Options::max_range, {0.1, 1000},
                  "Distance from the sensor beyond which points are not drawn.")
          .flag("grid", &Options::grid, "Draws the occupancy grid of the 2D scans on the floor.")
          .number("grid_resolution_m", &Options::grid_resolution, {0.005, 10},
                  "Side of the cells of the drawn occupancy grid.")
          .flag("follow", &Options::follow, "Keeps the whole map in view; false leaves the camera to the mouse.")
          .flag("keep_open", &Options::keep_open,
                "Waits at the end, when all output is written, until the window is closed.");
  return table;
}

namespace {

// The library is never unloaded, because MRPT's thread may paint until the program ends.
std::unique_ptr<LiveScene> openScene(const LiveWindowOptions& options, const std::string& title) {
  void* open =
      base::functionOfFeature("omnimapperOpenLiveScene", "the live window cannot be opened", "leave out --gui");
  return std::unique_ptr<LiveScene>(reinterpret_cast<decltype(&omnimapperOpenLiveScene)>(open)(options, title));
}

}  // namespace

LiveWindow::LiveWindow(const LiveWindowOptions& options, const mapper::PluginContext& context)
    : options_(options), scene_(openScene(options, context.title)) {}

LiveWindow::~LiveWindow() = default;

bool LiveWindow::isOpen() const {
  return scene_->isOpen();
}

// A large map takes long to draw and is therefore drawn less often.
void LiveWindow::update(const mapper::View& view) {
  constexpr auto kShortest = std::chrono::milliseconds(200);
  constexpr int kShare = 10;  // at most 1/kShare of the time is spent on drawing
  if (!isOpen()) return;
  const auto begin = Clock::now();
  scene_->show(view);
  next_ = Clock::now() + std::max<Clock::duration>(kShortest, kShare * (Clock::now() - begin));
}

void LiveWindow::keyFrameAdded(const mapper::View& view) {
  if (Clock::now() >= next_) update(view);
}

void LiveWindow::frameAdded(const mapper::View& view) {
  constexpr auto kShortest = std::chrono::milliseconds(33);
  if (Clock::now() < next_move_ || !isOpen()) return;
  scene_->move(map::newestPose(view.map));
  next_move_ = Clock::now() + kShortest;
}

void LiveWindow::finish(const mapper::View& view) {
  update(view);
}

}  // namespace omnimapper::plugins
