#include <mrpt/maps/CPointsMap.h>
#include <omnimapper/perception/EdgeExtractor.h>
#include <omnimapper/perception/ObjectExtractor.h>
#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/perception/RoadExtractor.h>

#include <cmath>

#include "../Painting.h"
#include "../Targets.h"

namespace omnimapper::fuzz {

namespace {

using namespace camera;
using namespace perception;
using mrpt::obs::CObservation3DRangeScan;

mrpt::img::TCamera takeCamera(Input& input, const Size& size) {
  mrpt::img::TCamera camera;
  const double fx = input.oddBetween(20, 600), fy = input.oddBetween(20, 600);
  const double cx = input.oddBetween(-50, 150), cy = input.oddBetween(-50, 150);
  camera.setIntrinsicParamsFromValues(fx, fy, cx, cy);
  const bool right = !input.flag();
  camera.ncols = static_cast<std::uint32_t>(right ? size.width : input.below(3000));
  camera.nrows = static_cast<std::uint32_t>(right ? size.height : input.below(3000));
  return camera;
}

mrpt::poses::CPose3D takePose(Input& input) {
  const double x = input.oddBetween(-1, 1), y = input.oddBetween(-1, 1), z = input.oddBetween(-1, 2);
  const double yaw = input.between(-3.2, 3.2), pitch = input.between(-1.6, 1.6), roll = input.between(-3.2, 3.2);
  return {x, y, z, yaw, pitch, roll};
}

Size takeSmallSize(Input& input) {
  Size size = takeSize(input);
  size.width = std::clamp(size.width, 0, 5000);
  size.height = std::clamp(size.height, 0, size.width > 96 ? 3 : size.width > 2 ? 100 : 5000);
  return size;
}

// Adds a picture: of 8 bits or another depth, grey or in colour, of the same size or another one, or in a missing file.
void addPicture(Input& input, const Size& depth, CObservation3DRangeScan& scan) {
  scan.hasIntensityImage = true;
  const Size size = input.flag() ? depth : takeSmallSize(input);
  const int kind = input.below(16);
  if (kind == 0) return;
  if (kind == 1) {
    scan.intensityImage.setExternalStorage("no such picture.png");
    return;
  }
  scan.cameraParamsIntensity = input.flag() ? scan.cameraParams : takeCamera(input, size);
  if (input.flag()) scan.relativePoseIntensityWRTDepth = takePose(input);
  if (size.width == 0 || size.height == 0) return;
  const auto channels = input.flag() ? mrpt::img::CH_RGB : mrpt::img::CH_GRAY;
  const auto type = kind == 2 ? mrpt::img::PixelDepth::D16U : mrpt::img::PixelDepth::D8U;
  scan.intensityImage.resize(static_cast<std::size_t>(size.width), static_cast<std::size_t>(size.height), channels,
                             type);
  const std::size_t row_bytes = static_cast<std::size_t>(size.width) * (channels == mrpt::img::CH_RGB ? 3 : 1);
  for (int y = 0; y < size.height; ++y) {
    auto* row = scan.intensityImage.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
    for (std::size_t i = 0; i < row_bytes; ++i)
      row[i] = static_cast<std::uint8_t>((i / 31 + static_cast<std::size_t>(y) / 17) * 90);
  }
}

CObservation3DRangeScan takeScan(Input& options, Input& input) {
  CObservation3DRangeScan scan;
  scan.sensorLabel = "camera";
  const Size size = takeSmallSize(options);
  scan.cameraParams = scan.cameraParamsIntensity = takeCamera(options, size);
  scan.sensorPose = takePose(options);
  scan.rangeUnits = static_cast<float>(options.oddBetween(1e-4, 1e-2));
  scan.range_is_depth = options.flag();
  scan.hasRangeImage = options.below(8) != 0;
  if (options.flag()) addPicture(options, size, scan);
  if (options.below(16) == 0) {  // unorganized points, which must not be taken for an image
    scan.hasPoints3D = true;
    scan.resizePoints3DVectors(static_cast<std::size_t>(options.below(100)));
    return scan;
  }
  const bool wrapped = options.flag();
  const auto units = inUnits(paintDepths(input, size), 1e-3, wrapped);
  scan.rangeImage_setSize(size.height, size.width);
  if (!units.empty()) std::copy(units.begin(), units.end(), scan.rangeImage.data());
  return scan;
}

void requireSound(const obs::CObservationPlanes& found, const CObservation3DRangeScan& scan) {
  require(found.source_label == scan.sensorLabel, "the planes are of another sensor");
  for (const auto& plane : found.planes) {
    require(plane.centroid.allFinite() && plane.covariance.allFinite(), "a plane that is not finite");
    require(plane.inliers <= static_cast<std::size_t>(scan.rangeImage.size()), "more inliers than pixels");
    require(plane.outline.vertices.size() >= 3, "a plane without an outline");
  }
}

void requireSound(const obs::CObservationObjects& found, const obs::CObservationPlanes& planes, int max_points) {
  for (const auto& object : found.objects) {
    require(object.centroid.allFinite() && object.covariance.allFinite(), "an object that is not finite");
    require(object.points.size() <= static_cast<std::size_t>(max_points), "more points than were asked for");
    require(object.colours.empty() || object.colours.size() == object.points.size(), "points without colours");
    require(!object.supporting_plane || *object.supporting_plane < planes.planes.size(), "no such plane");
  }
}

void extract(Input& options, int work, const CObservation3DRangeScan& scan) {
  PlaneOptions planes;
  planes.min_pixels = 1 + options.below(300);
  OutlineOptions outlines;
  outlines.tolerance = options.between(0, 5);
  if (work == 0) {
    PlaneComparisonOptions comparison;
    if (options.flag()) comparison.comparison = &kSamePlaneAndColour;
    requireSound(*PlaneExtractor(planes, outlines, comparison).extract(scan), scan);
  } else if (work == 1) {
    ObjectExtractor::Options of_objects;
    of_objects.planes = planes;
    of_objects.outlines = outlines;
    of_objects.objects.on_surfaces_only = options.flag();
    of_objects.objects.min_points = 1 + options.below(100);
    of_objects.points.max_points = 1 + options.below(200);
    const auto found = ObjectExtractor(of_objects).extract(scan);
    requireSound(*found.planes, scan);
    requireSound(*found.objects, *found.planes, of_objects.points.max_points);
  } else if (work == 2) {
    RoadOptions road;
    road.min_pixels = planes.min_pixels;
    RoadPoseOptions pose;
    pose.ground_height = options.between(-2, 2);
    requireSound(*RoadExtractor(road, outlines, pose).extract(scan), scan);
  } else {
    for (const auto& cloud : EdgeExtractor({}).extract(scan)) {
      require(cloud->pointcloud != nullptr, "an observation without a cloud");
      for (const float x : cloud->pointcloud->getPointsBufferRef_x())
        require(std::isfinite(x), "an edge that is not finite");
    }
  }
}

}  // namespace

void rangeScans(const std::uint8_t* data, std::size_t size) {
  const std::size_t begin = std::min<std::size_t>(size, 96);
  Input options(data, begin), input(data + begin, size - begin);
  const int work = options.take<std::uint8_t>() % 4;
  const auto scan = takeScan(options, input);
  mayRefuse([&] { extract(options, work, scan); });
}

}  // namespace omnimapper::fuzz
