#include "PcdFolder.h"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace omnimapper::source {

namespace {

constexpr double kUnit = 1e-4;              // [m]
constexpr double kPixelsFromTheRay = 0.25;  // [px] largest root mean square of points from the rays of their pixels

bool isPcd(const std::string& file) {
  return std::filesystem::path(file).extension() == ".pcd";
}

/// Least-squares fit of pixel = focal * slope + middle over points.
struct Axis {
  double n = 0, s = 0, p = 0, ss = 0, sp = 0, pp = 0;
  void add(double slope, double pixel) {
    n += 1;
    s += slope;
    p += pixel;
    ss += slope * slope;
    sp += slope * pixel;
    pp += pixel * pixel;
  }
  double focal() const { return (n * sp - s * p) / (n * ss - s * s); }
  double middle() const { return (p - focal() * s) / n; }
  double rms() const {
    const double f = focal(), c = middle();
    return std::sqrt(std::max(0., (pp - 2 * f * sp - 2 * c * p + f * f * ss + 2 * f * c * s + n * c * c) / n));
  }
};

mrpt::img::TCamera cameraOf(const PcdCloud& cloud, const std::string& name) {
  Axis across, down;
  std::size_t i = 0;
  for (int row = 0; row < cloud.height; ++row) {
    for (int column = 0; column < cloud.width; ++column, ++i) {
      const auto z = static_cast<double>(cloud.z[i]);
      if (!(z > 0) || !std::isfinite(z)) continue;
      across.add(static_cast<double>(cloud.x[i]) / z, column);
      down.add(static_cast<double>(cloud.y[i]) / z, row);
    }
  }
  const bool fits = across.n > 2 && across.focal() > 0 && down.focal() > 0 && across.rms() < kPixelsFromTheRay &&
                    down.rms() < kPixelsFromTheRay;
  if (!fits)
    refuse(name,
           "its points do not lie on the rays of a pinhole camera with z forward and y down; with HEIGHT 1 it would be "
           "imported as a cloud");
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(across.focal(), down.focal(), across.middle(), down.middle());
  camera.ncols = static_cast<std::uint32_t>(cloud.width);
  camera.nrows = static_cast<std::uint32_t>(cloud.height);
  return camera;
}

void addColours(const PcdCloud& cloud, mrpt::obs::CObservation3DRangeScan& scan) {
  scan.hasIntensityImage = true;
  scan.intensityImage.resize(cloud.width, cloud.height, mrpt::img::CH_RGB);
  std::size_t i = 0;
  for (int row = 0; row < cloud.height; ++row) {
    auto* pixel = scan.intensityImage.ptrLine<std::uint8_t>(static_cast<unsigned>(row));
    for (int column = 0; column < cloud.width; ++column, ++i) {
      for (int shift = 0; shift < 24; shift += 8) *pixel++ = static_cast<std::uint8_t>(cloud.rgb[i] >> shift);
    }
  }
}

}  // namespace

mrpt::obs::CObservation3DRangeScan::Ptr depthImageOf(const PcdCloud& cloud, const std::string& name) {
  if (cloud.height < 2 || cloud.width < 2) refuse(name, "is no organized cloud: it has no rows and columns");
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->cameraParams = scan->cameraParamsIntensity = cameraOf(cloud, name);
  scan->hasRangeImage = true;
  scan->range_is_depth = true;
  scan->rangeUnits = static_cast<float>(kUnit);
  scan->maxRange = static_cast<float>(65535 * kUnit);
  scan->rangeImage_setSize(cloud.height, cloud.width);
  std::size_t i = 0;
  for (int row = 0; row < cloud.height; ++row) {
    for (int column = 0; column < cloud.width; ++column, ++i) {
      const double units = static_cast<double>(cloud.z[i]) / kUnit + 0.5;
      scan->rangeImage(row, column) = units >= 1 && units < 65535 ? static_cast<std::uint16_t>(units) : 0;
    }
  }
  if (!cloud.rgb.empty()) addColours(cloud, *scan);
  return scan;
}

mrpt::obs::CObservation::Ptr cloudOf(const PcdCloud& cloud) {
  auto made = mrpt::obs::CObservationPointCloud::Create();
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->reserve(cloud.x.size());
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    if (std::isfinite(cloud.x[i]) && std::isfinite(cloud.y[i]) && std::isfinite(cloud.z[i]))
      points->insertPointFast(cloud.x[i], cloud.y[i], cloud.z[i]);
  }
  made->pointcloud = points;
  return made;
}

const base::OptionTable<PcdFolderOptions>& PcdFolderOptions::table() {
  static const auto table = base::OptionTable<PcdFolderOptions>()
                                .text("label", &PcdFolderOptions::label, "Sensor label.")
                                .number("rate_hz", &PcdFolderOptions::rate, base::Range::positive(),
                                        "Rate of clouds whose files' names are no Unix times.");
  return table;
}

bool PcdFolder::recognizes(const LogLook& look) {
  return look.is_folder && !look.firstEnding(".pcd").empty();
}

void PcdFolder::noteAtEnd(SourceReport& report) const {
  if (unorganized_ > 0)
    report.notes.push_back(base::counted(unorganized_, "cloud") +
                           " without rows and columns (HEIGHT 1): they remain clouds, which can only be mapped "
                           "together with odometry or poses");
}

PcdFolder::PcdFolder(const std::string& folder, const PcdFolderOptions& options)
    : FolderSource(folder, isPcd, ".pcd files", options.label, options.rate) {}

mrpt::obs::CObservation::Ptr PcdFolder::read(const std::string& file) {
  const auto cloud = readPcd(file);
  if (cloud.height > 1 && cloud.width > 1) return depthImageOf(cloud, file);
  ++unorganized_;
  return cloudOf(cloud);
}

}  // namespace omnimapper::source
