#include <mrpt/gui/CDisplayWindow3D.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/stock_objects.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/derived/GridMapper.h>
#include <omnimapper/derived/SceneLandmarks.h>
#include <omnimapper/derived/SceneParts.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <unordered_map>
#include <vector>

#include "GridFloor.h"
#include "LiveScene.h"

namespace omnimapper::plugins {

namespace {

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

/// Clipping distances, and the height step between objects drawn over one another (closures over the trajectory over
/// landmarks over the grid), all as shares of the camera's distance. Depths have 16 bits, distributed from the nearest
/// distance on; Mesa's software renderer still hid lines behind the grid with a nearest distance of 1/30, but not with
/// 1/20.
constexpr double kNearest = 1.0 / 16, kFarthest = 10, kDepthStep = 12 / kNearest / (1 << 16);

constexpr double kAxesInView = 30;  ///< smallest distance of the camera in lengths of the newest pose's axes

derived::ScanGridOptions gridOptions(const LiveWindowOptions& options) {
  constexpr double kMostCells = 4e6;  // enough for a window; a larger map gets coarser cells
  return {options.grid_resolution, options.max_range, 0, kMostCells};
}

[[noreturn]] void failWithoutDisplay() {
  const char* display = std::getenv("DISPLAY");
  throw base::Error(
      base::ExitCode::command_line,
      "the live window cannot be opened: there is no display (DISPLAY is " +
          (display && *display ? "\"" + std::string(display) + "\", which does not answer" : std::string("not set")) +
          "). Leave out --gui, or run the program under xvfb-run.");
}

std::unique_ptr<mrpt::gui::CDisplayWindow3D> openWindow(const std::string& title, const LiveWindowOptions& options) {
  if (!isSet("DISPLAY") && !isSet("WAYLAND_DISPLAY")) failWithoutDisplay();
  auto window = std::make_unique<mrpt::gui::CDisplayWindow3D>(title, static_cast<unsigned>(options.width),
                                                              static_cast<unsigned>(options.height));
  if (!window->isOpen()) failWithoutDisplay();
  return window;
}

/// The window and its content. Points are attached to their key frames, so that a solve moves frames, not points.
class MrptScene : public LiveScene {
 public:
  MrptScene(const LiveWindowOptions& options, const std::string& title)
      : options_(options), grid_mapper_(gridOptions(options)), window_(openWindow("OmniMapper: " + title, options)) {
    mrpt::opengl::COpenGLScene::Ptr scene;
    mrpt::gui::CDisplayWindow3DLocker lock(*window_, scene);
    scene->getViewport()->setCustomBackgroundColor({0.96f, 0.97f, 0.98f});
    for (const auto& object : {grid_, ground_, points_, trajectory_, refused_, accepted_, pose_, landmarks_})
      scene->insert(object);
    pose_->insert(mrpt::opengl::stock_objects::CornerXYZSimple(1.0f, 4.0f));
    window_->setCameraElevationDeg(70);
    window_->setCameraAzimuthDeg(-90);
  }

  bool isOpen() const override { return window_->isOpen(); }

  void show(const mapper::View& view) override {
    if (view.map.key_frames.empty()) return;
    const CameraPlacement placement = placementOf(view.map);
    {
      mrpt::opengl::COpenGLScene::Ptr scene;
      mrpt::gui::CDisplayWindow3DLocker lock(*window_, scene);
      placePoints(view.map);
      const auto ground = derived::groundOf(view.map);
      if (options_.grid) placeGrid(view.map, ground->getPlaneZcoord() - kDepthStep * placement.distance);
      scene->getViewport()->setViewportClipDistances(static_cast<float>(kNearest * placement.distance),
                                                     static_cast<float>(kFarthest * placement.distance));
      const auto lifted = [&](int steps) {
        return mrpt::poses::CPose3D(0, 0, steps * kDepthStep * placement.distance, 0, 0, 0);
      };
      trajectory_->setPose(lifted(1));
      refused_->setPose(lifted(2));
      accepted_->setPose(lifted(3));
      replace(*ground_, ground);
      replace(*trajectory_, derived::trajectoryLines(keyFramePoses(view.map)));
      const auto closures = derived::closuresOf(view.map, view.decisions);
      replace(*accepted_, derived::closureLines(closures, true));
      replace(*refused_, derived::closureLines(closures, false));
      replace(*landmarks_, derived::landmarkObjects(derived::shapesOf(view), false));
      pose_->setPose(map::newestPose(view.map));
      pose_->setScale(static_cast<float>(std::min(1.0, placement.distance / kAxesInView)));
      const auto count = std::count_if(closures.begin(), closures.end(),
                                       [](const derived::Closure& c) { return c.decision->accepted; });
      mrpt::opengl::TFontParams font;
      font.color = mrpt::img::TColorf(0.1f, 0.13f, 0.18f);
      window_->addTextMessage(10, -25,
                              std::to_string(view.map.key_frames.size()) + " key frames, " + std::to_string(count) +
                                  " closures accepted, " + std::to_string(closures.size() - count) + " refused",
                              0, font);
    }
    if (options_.follow) lookFrom(placement);
    window_->forceRepaint();
  }

  void move(const mrpt::poses::CPose3D& map_from_base) override {
    {
      mrpt::opengl::COpenGLScene::Ptr scene;
      mrpt::gui::CDisplayWindow3DLocker lock(*window_, scene);
      pose_->setPose(map_from_base);
    }
    window_->forceRepaint();
  }

 private:
  using Group = mrpt::opengl::CSetOfObjects;

  static void replace(Group& group, const mrpt::opengl::CRenderizable::Ptr& content) {
    group.clear();
    group.insert(content);
  }

  static std::vector<map::StampedPose> keyFramePoses(const map::Map& map) {
    std::vector<map::StampedPose> poses;
    for (const map::KeyFrame& frame : map.key_frames)
      poses.push_back({frame.stamp, frame.map_from_base, frame.id.session});
    return poses;
  }

  void placePoints(const map::Map& map) {
    for (const map::KeyFrame& frame : map.key_frames) {
      auto& cloud = clouds_[frame.id];
      if (!cloud) {
        cloud = cloudInBase(frame);
        points_->insert(cloud);
      }
      cloud->setPose(frame.map_from_base);
    }
  }

  void placeGrid(const map::Map& map, double z) {
    grid_->setPose(mrpt::poses::CPose3D(0, 0, z, 0, 0, 0));
    if (!grid_mapper_.update(map)) return;
    grid_->clear();
    if (const auto grid = grid_mapper_.scanGrid()) grid_->insert(gridFloor(*grid, 0));
  }

  mrpt::opengl::CRenderizable::Ptr cloudInBase(const map::KeyFrame& frame) const {
    if (!frame.cloud.empty()) return colouredCloud(frame);
    const auto points = derived::pointsInBase(frame, derived::hasClouds(frame), options_.max_range);
    const std::size_t stride = 1 + points.size() / static_cast<std::size_t>(options_.points_per_key_frame);
    auto cloud = mrpt::opengl::CPointCloud::Create();
    cloud->setColor_u8(mrpt::img::TColor(24, 33, 47));
    cloud->setPointSize(2);
    for (std::size_t i = 0; i < points.size(); i += stride) cloud->insertPoint(points[i].x, points[i].y, points[i].z);
    return cloud;
  }

  mrpt::opengl::CRenderizable::Ptr colouredCloud(const map::KeyFrame& frame) const {
    const std::size_t stride = 1 + frame.cloud.size() / static_cast<std::size_t>(options_.points_per_key_frame);
    auto cloud = mrpt::opengl::CPointCloudColoured::Create();
    cloud->setPointSize(3);
    for (std::size_t i = 0; i < frame.cloud.size(); i += stride) {
      const auto& point = frame.cloud[i];
      const auto at = point.inBase();
      cloud->insertPoint({mrpt::math::TPointXYZfRGBAu8(static_cast<float>(at.x), static_cast<float>(at.y),
                                                       static_cast<float>(at.z), point.red, point.green, point.blue)});
    }
    return cloud;
  }

  /// A camera placement that shows all key frames, and the points that cameras measured there.
  struct CameraPlacement {
    mrpt::math::TPoint3D target;
    double distance;  // [m] of the camera from the target
  };
  static CameraPlacement placementOf(const map::Map& map) {
    mrpt::math::TPoint3D low = map.key_frames.front().map_from_base.translation(), high = low;
    for (const map::KeyFrame& frame : map.key_frames) {
      const auto p = frame.map_from_base.translation();
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (!derived::hasDepthClouds(map)) return {0.5 * (low + high), 12 + 1.6 * (high - low).norm()};
    constexpr std::size_t kEvery = 50;  // of the points of a key frame
    std::vector<double> xs, ys, zs;
    for (const map::KeyFrame& frame : map.key_frames) {
      for (std::size_t i = 0; i < frame.cloud.size(); i += kEvery) {
        const auto p = frame.map_from_base.composePoint(frame.cloud[i].inBase());
        xs.push_back(p.x);
        ys.push_back(p.y);
        zs.push_back(p.z);
      }
    }
    widen(xs, low.x, high.x);
    widen(ys, low.y, high.y);
    widen(zs, low.z, high.z);
    return {0.5 * (low + high), 1 + 1.6 * (high - low).norm()};
  }
  /// Widens [low, high] to contain all values but the outermost.
  static void widen(std::vector<double>& values, double& low, double& high) {
    if (values.empty()) return;
    std::sort(values.begin(), values.end());
    const std::size_t cut = values.size() / 50;
    low = std::min(low, values[cut]);
    high = std::max(high, values[values.size() - 1 - cut]);
  }

  void lookFrom(const CameraPlacement& placement) {
    window_->setCameraPointingToPoint(static_cast<float>(placement.target.x), static_cast<float>(placement.target.y),
                                      static_cast<float>(placement.target.z));
    window_->setCameraZoom(static_cast<float>(placement.distance));
  }

  LiveWindowOptions options_;
  derived::GridMapper grid_mapper_;
  Group::Ptr grid_ = Group::Create(), ground_ = Group::Create(), points_ = Group::Create(),
             trajectory_ = Group::Create(), refused_ = Group::Create(), accepted_ = Group::Create(),
             pose_ = Group::Create(), landmarks_ = Group::Create();
  std::unordered_map<base::KeyFrameId, mrpt::opengl::CRenderizable::Ptr> clouds_;
  std::unique_ptr<mrpt::gui::CDisplayWindow3D> window_;
};

}  // namespace
}  // namespace omnimapper::plugins

omnimapper::plugins::LiveScene* omnimapperOpenLiveScene(const omnimapper::plugins::LiveWindowOptions& options,
                                                        const std::string& title) {
  return new omnimapper::plugins::MrptScene(options, title);
}
