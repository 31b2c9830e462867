#include "RgbdFolder.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/source/ImageFile.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>

#include "CameraFile.h"
#include "RgbdFolderForms.h"

namespace omnimapper::source {

namespace {

using mrpt::obs::CObservation3DRangeScan;

constexpr std::size_t kDepthValues = 65536;  // of a depth image of 16 bits

struct Intrinsics {
  double fx, fy, cx, cy;            // [pixel]
  std::array<double, 5> lens = {};  // k1, k2, p1, p2, k3 of OpenCV's and MRPT's model
};

// Freiburg: the TUM RGB-D benchmark's own calibration of its three cameras; images of the third are undistorted.
// ICL-NUIM states fy = -480 for images with y up, but in its files y is down as in all others. 7-Scenes: as stated by
// its authors. OpenNI: its default.
const std::map<std::string, Intrinsics>& knownIntrinsics() {
  static const std::map<std::string, Intrinsics> known{
      {"freiburg1", {517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}}},
      {"freiburg2", {520.9, 521.0, 325.1, 249.7, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}}},
      {"freiburg3", {535.4, 539.2, 320.1, 247.6}},
      {"icl_nuim", {481.2, 480.0, 319.5, 239.5}},
      {"7_scenes", {585.0, 585.0, 320.0, 240.0}},
      {"openni", {525.0, 525.0, 319.5, 239.5}}};
  return known;
}

mrpt::img::TCamera cameraOf(const Intrinsics& intrinsics) {
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy);
  if (intrinsics.lens != std::array<double, 5>{}) {
    camera.distortion = mrpt::img::DistortionModel::plumb_bob;
    std::copy(intrinsics.lens.begin(), intrinsics.lens.end(), camera.dist.begin());
  }
  return camera;
}

CameraFile namedCameraFile(const std::string& path) {
  if (!std::filesystem::exists(path)) {
    refuse(path,
           "is neither the name of a known camera (freiburg1, freiburg2, freiburg3, icl_nuim, 7_scenes, openni) nor a "
           "file");
  }
  auto file = readCameraFile(path);
  if (!file)
    refuse(path, "holds neither fx, fy, cx, cy by name nor four numbers, nor the matrix of a camera in a known form");
  return *file;
}

// Whether a folder is the part of a data set that has its camera's file one folder above.
bool isPartOfFolderAbove(const std::filesystem::path& folder) {
  const std::string name = folder.filename().string();
  return name == "depth" || name == "depths" || name.rfind("seq", 0) == 0;
}

std::optional<CameraFile> cameraFileBeside(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path + "/.").lexically_normal().parent_path();
  std::vector<std::string> folders{folder.string()};
  for (const char* depths : {"depth", "depths"}) folders.push_back((folder / depths).string());
  auto found = cameraFileIn(folders);
  if (!found && isPartOfFolderAbove(folder)) found = cameraFileIn({folder.parent_path().string()});
  return found;
}

// The camera as the option names it, as a file beside the images states it, or of the data set that the folder's path
// names.
CameraFile cameraFor(const std::string& folder, const std::string& option, const std::string& by_name) {
  const std::string& name = option.empty() ? by_name : option;
  const auto beside = option.empty() ? cameraFileBeside(folder) : std::nullopt;
  if (beside) return *beside;
  if (name.empty()) {
    refuse(folder,
           "does not show which camera took its images, and no file beside them states its intrinsics; put "
           "camera_info.yaml of ROS, Open3D's JSON, or intrinsics.K.txt with fx 0 cx, 0 fy cy, 0 0 1 there, or name "
           "the camera with --intrinsics of omnimapper-import, with --set source_rgbd_folder.intrinsics=..., or as "
           "[source_rgbd_folder] intrinsics in the INI (freiburg1, ..., or a file with fx, fy, cx, cy)");
  }
  const auto known = knownIntrinsics().find(name);
  return known != knownIntrinsics().end() ? CameraFile{name, cameraOf(known->second), 0} : namedCameraFile(name);
}

// Intrinsics of images of another size make a map that is wrong and looks right.
void refuseOtherSize(const CameraFile& file, const std::vector<RgbdPair>& pairs) {
  if (pairs.empty() || knownIntrinsics().count(file.path) > 0) return;
  const auto size = imageSizeIn(pairs.front().depth);
  const auto& camera = file.camera;
  if (!size) return;
  const bool is_other =
      camera.ncols > 0 && camera.nrows > 0 && (camera.ncols != size->width || camera.nrows != size->height);
  const bool is_outside = !(camera.cx() > 0 && camera.cx() < static_cast<double>(size->width) && camera.cy() > 0 &&
                            camera.cy() < static_cast<double>(size->height));
  if (!is_other && !is_outside) return;
  refuse(file.path,
         (is_other
              ? "is of images of " + std::to_string(camera.ncols) + " x " + std::to_string(camera.nrows) + " pixels"
              : "states a centre of " + base::fixed(camera.cx(), 1) + ", " + base::fixed(camera.cy(), 1) + " pixels") +
             ", but " + pairs.front().depth + " has " + std::to_string(size->width) + " x " +
             std::to_string(size->height) +
             "; give the intrinsics of the depth images with --intrinsics of omnimapper-import, or as "
             "[source_rgbd_folder] intrinsics");
}

bool load(mrpt::img::CImage& image, const std::string& path, int how) {
  if (!std::filesystem::is_regular_file(path) || whyTooLarge(path)) return false;
  try {
    return image.loadFromFile(path, how) && !image.isEmpty();
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

const base::OptionTable<RgbdFolderOptions>& RgbdFolderOptions::table() {
  using Options = RgbdFolderOptions;
  static const auto table =
      base::OptionTable<Options>()
          .text("intrinsics", &Options::intrinsics,
                "The camera: freiburg1, freiburg2, freiburg3, icl_nuim, 7_scenes, openni, or a file with fx, fy, cx, "
                "cy and the lens (k1, k2, p1, p2, k3), or with camera_info of ROS or intrinsics of Open3D. Empty: as a "
                "file beside the images states, else chosen by the name of the folder.")
          .number("tolerance_s", &Options::largest_difference, base::Range::notNegative(),
                  "Largest difference between the stamps of depth and colour, and of an image and its true pose.")
          .number(
              "depth_units_per_m", &Options::depth_units, base::Range::notNegative(),
              "Units of a depth image per metre; 0: DepthMapFactor of the camera's file if it has one, 5000 for TUM "
              "and ICL-NUIM (with rgb/), else 1000.")
          .number("rate_hz", &Options::rate, base::Range::positive(), "Rate of images without stamps.")
          .text("label", &Options::label, "Sensor label.");
  return table;
}

RgbdFolder::RgbdFolder(const std::string& folder, const RgbdFolderOptions& options)
    : options_(options), depth_counts_(kDepthValues, 0) {
  auto content = readRgbdFolder(folder, options);
  const CameraFile file = cameraFor(folder, options.intrinsics, content.usual_intrinsics);
  refuseOtherSize(file, content.pairs);
  camera_name_ = file.path;
  camera_ = file.camera;
  if (options_.depth_units <= 0)
    options_.depth_units = file.depth_units_per_m > 0 ? file.depth_units_per_m : content.usual_depth_units;
  pairs_ = std::move(content.pairs);
  unpaired_ = static_cast<std::size_t>(
      std::count_if(pairs_.begin(), pairs_.end(), [](const RgbdPair& pair) { return pair.colour.empty(); }));
  for (const auto& [stamp, world_from_optical] : content.world_from_optical)
    ground_truth_.emplace_back(stamp, world_from_optical * geometry::inverse(geometry::sensorFromOptical()));
}

mrpt::obs::CObservation::Ptr RgbdFolder::next() {
  constexpr int kAsItIs = -1, kColour = 1;
  while (next_ < pairs_.size()) {
    const RgbdPair& pair = pairs_[next_++];
    mrpt::img::CImage depth;
    auto scan = CObservation3DRangeScan::Create();
    const bool has_depth =
        load(depth, pair.depth, kAsItIs) && depth.getPixelDepth() == mrpt::img::PixelDepth::D16U && !depth.isColor();
    const bool is_coloured = !pair.colour.empty();
    if (!has_depth || (is_coloured && !load(scan->intensityImage, pair.colour, kColour))) {
      const std::string& missing = has_depth ? pair.colour : pair.depth;
      if (report_.missing_images++ == 0) report_.first_missing_image = missing;
      continue;
    }
    const int width = static_cast<int>(depth.getWidth()), height = static_cast<int>(depth.getHeight());
    scan->timestamp = pair.stamp;
    scan->sensorLabel = options_.label;
    scan->hasIntensityImage = is_coloured;
    scan->hasRangeImage = true;
    scan->range_is_depth = true;
    scan->rangeUnits = static_cast<float>(1 / options_.depth_units);
    scan->maxRange = static_cast<float>(65535 / options_.depth_units);
    scan->rangeImage_setSize(height, width);
    scan->cameraParams = camera_;
    scan->cameraParams.ncols = width;
    scan->cameraParams.nrows = height;
    for (int row = 0; row < height; ++row) {
      const auto* values = depth.ptrLine<std::uint16_t>(static_cast<unsigned>(row));  // at() counts columns in bytes
      for (int column = 0; column < width; ++column) {
        scan->rangeImage(row, column) = values[column];
        ++depth_counts_[values[column]];
      }
    }
    scan->cameraParamsIntensity = scan->cameraParams;
    if (is_coloured) {
      scan->cameraParamsIntensity.ncols = scan->intensityImage.getWidth();
      scan->cameraParamsIntensity.nrows = scan->intensityImage.getHeight();
    }
    ++report_.objects;
    report_.count(scan->sensorLabel, scan->GetRuntimeClass()->className, scan->timestamp);
    return scan;
  }
  finish();
  return nullptr;
}

// With wrong depth units or a wrong camera the map is wrong although it looks right, so they are noted.
void RgbdFolder::finish() {
  if (report_.ending == SourceReport::Ending::complete) return;
  report_.ending = SourceReport::Ending::complete;
  auto& notes = report_.notes;
  notes.push_back("depth images without a colour image at their time, kept without colour: " +
                  std::to_string(unpaired_));
  notes.push_back("camera: " + camera_name_ + ", fx " + base::fixed(camera_.fx(), 1) + " fy " +
                  base::fixed(camera_.fy(), 1) + " cx " + base::fixed(camera_.cx(), 1) + " cy " +
                  base::fixed(camera_.cy(), 1) + " pixels");
  const std::string units = base::option_text::format(options_.depth_units);
  const auto depth = medianDepth();
  notes.push_back("depth: " + units + " units per metre" +
                  (depth ? ", median " + base::fixed(*depth, 2) + " m" : ", no pixel has a depth"));
  // A Kinect measures from 0.8 m to 4 m, or from 0.4 m to 3 m in its near mode, and the median depth of a room is
  // seldom outside. freiburg1_rpy and freiburg3_cabinet read with 1000 units per metre have medians of 5.4 m and 7.2 m,
  // ICL-NUIM's living room with 5000 one of 0.35 m.
  constexpr double kNearest = 0.4, kFarthest = 4;  // [m]
  if (!depth || (*depth >= kNearest && *depth <= kFarthest)) return;
  report_.doubts.push_back("half of the depths are " + std::string(*depth < kNearest ? "below " : "above ") +
                           base::fixed(*depth, 2) + " m: is depth_units_per_m = " + units +
                           " right? An RGB-D camera sees rooms at 0.4 m to 4 m; with wrong units the map has a wrong "
                           "scale");
}

std::optional<geometry::Se3> RgbdFolder::truthAt(base::Stamp stamp) const {
  const auto& truth = ground_truth_;
  auto nearest = std::lower_bound(truth.begin(), truth.end(), stamp,
                                  [](const auto& pose, base::Stamp wanted) { return pose.first < wanted; });
  const auto off = [&](const auto& pose) { return std::abs(base::secondsBetween(pose->first, stamp)); };
  if (nearest == truth.end() || (nearest != truth.begin() && off(std::prev(nearest)) < off(nearest))) {
    if (nearest == truth.begin()) return std::nullopt;
    --nearest;
  }
  if (off(nearest) > options_.largest_difference) return std::nullopt;
  return nearest->second;
}

std::optional<double> RgbdFolder::medianDepth() const {
  // 0 means no depth; so does the largest value in 7-Scenes.
  const auto first = depth_counts_.begin() + 1, last = depth_counts_.end() - 1;
  const std::uint64_t all = std::accumulate(first, last, std::uint64_t{0});
  if (all == 0) return std::nullopt;
  std::uint64_t below = 0;
  const auto middle = std::find_if(first, last, [&](std::uint64_t count) { return 2 * (below += count) >= all; });
  return static_cast<double>(middle - depth_counts_.begin()) / options_.depth_units;
}

double RgbdFolder::progress() const {
  return pairs_.empty() ? 1.0 : static_cast<double>(next_) / static_cast<double>(pairs_.size());
}

}  // namespace omnimapper::source
