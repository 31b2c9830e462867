#include <omnimapper/perception/EdgeDetector.h>
#include <omnimapper/perception/ObjectFinder.h>
#include <omnimapper/perception/PlaneSegmenter.h>
#include <omnimapper/perception/RoadSegmenter.h>

#include <cmath>

#include "../Painting.h"
#include "../Targets.h"

namespace omnimapper::fuzz {

namespace {

using namespace camera;
using namespace perception;

/// An image and the pixels to which it refers.
struct Picture {
  std::vector<float> metres;
  std::vector<std::uint16_t> units;
};

Pinhole takeCamera(Input& input) {
  return {input.oddBetween(20, 600), input.oddBetween(20, 600), input.oddBetween(-50, 150), input.oddBetween(-50, 150)};
}

DepthImage takeImage(Input& input, Picture& pixels) {
  const Size size = takeSize(input);
  const Pinhole camera = takeCamera(input);
  const bool whole = input.flag(), wrapped = input.flag();
  const double unit = input.oddBetween(1e-4, 1e-2);
  // An image whose size must be refused has no pixels.
  const bool is_image = size.width >= 0 && size.height >= 0 && size.width <= 4096 && size.height <= 4096 &&
                        static_cast<long>(size.width) * size.height <= 20000;
  if (is_image) pixels.metres = paintDepths(input, size);
  if (!whole) return {is_image ? pixels.metres.data() : nullptr, size.width, size.height, camera};
  const double known = std::isfinite(unit) && unit > 1e-9 ? unit : 1e-3;
  if (is_image) pixels.units = inUnits(pixels.metres, known, wrapped);
  return {is_image ? pixels.units.data() : nullptr, unit, size.width, size.height, camera};
}

void requireSound(const PlaneSegmentation& found, const DepthImage& image, int min_pixels) {
  const auto pixels = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  require(found.width == image.width() && found.height == image.height(), "the segmentation has another size");
  require(found.labels.size() == pixels, "the labels have another size");
  std::vector<int> counts(found.planes.size() + 1, 0);
  for (const std::uint16_t label : found.labels) {
    require(label < counts.size(), "a label without a plane");
    ++counts[label];
  }
  for (std::size_t i = 0; i < found.planes.size(); ++i) {
    const PlaneRegion& plane = found.planes[i];
    require(plane.inliers == counts[i + 1] && plane.inliers >= min_pixels, "inliers are not those of the labels");
    require(std::abs(plane.plane_in_sensor.normal.norm() - 1) < 1e-6, "a normal that is not of length 1");
    require(std::isfinite(plane.plane_in_sensor.distance) && plane.centroid.allFinite(), "a plane that is not finite");
    require(plane.covariance.allFinite(), "a covariance that is not finite");
    require(plane.outline.corners.size() >= 4, "a plane without an outline");
    require(plane.outline.corners.size() == plane.outline.polygon_in_sensor.vertices.size(),
            "corners without vertices");
    for (const auto& vertex : plane.outline.polygon_in_sensor.vertices)
      require(vertex.allFinite(), "a vertex that is not finite");
  }
}

void requireSound(const std::vector<ObjectRegion>& objects, const PlaneSegmentation& planes) {
  std::vector<bool> taken(planes.labels.size(), false);
  for (const ObjectRegion& object : objects) {
    require(!object.surface || static_cast<std::size_t>(*object.surface) < planes.planes.size(), "no such surface");
    require(object.centroid.allFinite() && object.covariance.allFinite() && object.box_size.allFinite(),
            "an object that is not finite");
    for (const int pixel : object.pixels) {
      const auto i = static_cast<std::size_t>(pixel);
      require(i < taken.size() && !taken[i], "a pixel of no image or of two objects");
      taken[i] = true;
    }
  }
}

void findObjects(Input& input, const DepthImage& image, const PlaneOptions& sensor, const PlaneSegmentation& planes) {
  ObjectOptions options;
  options.comparator = input.flag() ? ObjectOptions::Comparator::locally_convex : ObjectOptions::Comparator::euclidean;
  options.on_surfaces_only = input.flag();
  options.min_points = 1 + input.below(40);
  options.min_size = 0;
  options.min_surface_area = input.between(1e-4, 0.2);
  options.max_tilt = input.between(0, 3.14159);
  const double up_x = input.oddBetween(-1, 1), up_y = input.oddBetween(-1, 1), up_z = input.oddBetween(-1, 1);
  const Eigen::Vector3d up(up_x, up_y, up_z);
  requireSound(ObjectFinder(options, sensor).find(image, planes, up.normalized()), planes);
}

void findRoad(Input& input, const DepthImage& image) {
  RoadOptions options;
  options.window_radius = 1 + input.below(7);
  options.min_pixels = 1 + input.below(300);
  options.min_hole_pixels = 1 + input.below(30);
  options.max_off = input.between(0, 3);
  const double x = input.between(-1, 1), y = input.oddBetween(-1.5, -0.5), z = input.between(-1, 1);
  const geometry::Plane3 expected{Eigen::Vector3d(x, y, z).normalized(), input.oddBetween(0.2, 3)};
  const auto found = RoadSegmenter(options).segment(image, expected);
  requireSound(found.ground, image, options.min_pixels);
  require(found.sure.size() == found.ground.labels.size(), "the sure pixels have another size");
}

void findEdges(Input& input, const DepthImage& image) {
  EdgeOptions options;
  options.window_radius = 1 + input.below(7);
  options.max_hole = input.below(100);
  options.jumps = !input.flag();
  options.high_curvature = !input.flag();
  const EdgeDetector detector(options);
  const auto edges = detector.detect(image);
  for (const EdgeKind kind : kEdgeKinds) {
    for (const auto& point : edgePoints(edges, image, kind)) require(point.allFinite(), "an edge that is not finite");
  }
  // A colour image whose rows have gaps, of the same size as the depth image or another one.
  ColourImage colour;
  colour.order = static_cast<ColourImage::Order>(input.below(3));
  colour.width = image.width() + (input.below(8) == 0 ? input.below(5) - 2 : 0);
  colour.height = image.height();
  const int channels = colour.order == ColourImage::Order::grey ? 1 : 3;
  colour.stride = std::max(0, colour.width) * channels + input.below(4);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(colour.stride) * static_cast<std::size_t>(colour.height));
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = input.left() > 0 ? input.rest()[i % input.left()] : static_cast<std::uint8_t>(i / 97 * 40);
  colour.pixels = bytes.data();
  mayRefuse([&] {
    const auto seen = detector.detect(image, colour);
    require(seen.labels.size() == edges.labels.size(), "the edges have another size");
  });
}

// Segments planes by the other comparators, with a colour image of the same size or another one.
void compareOtherwise(Input& input, const DepthImage& image, const PlaneOptions& sensor) {
  PlaneComparisonOptions comparison;
  comparison.comparison = input.flag() ? &kSimilarNormals : &kSamePlaneAndColour;
  comparison.max_colour_distance = input.between(0, 442);
  const auto pixels = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::vector<obs::Rgb> colours(pixels + (input.below(8) == 0 ? 1 : 0));
  const auto period = static_cast<std::size_t>(1 + input.below(300));
  for (std::size_t i = 0; i < colours.size(); ++i)
    colours[i] = i / period % 2 == 0 ? obs::Rgb{200, 10, 20} : obs::Rgb{10, 10, static_cast<std::uint8_t>(i)};
  requireSound(PlaneSegmenter(sensor, comparison).segment(image, colours), image, sensor.min_pixels);
}

}  // namespace

void depthImages(const std::uint8_t* data, std::size_t size) {
  const std::size_t begin = std::min<std::size_t>(size, 48);
  Input options(data, begin), input(data + begin, size - begin);
  mayRefuse([&] {
    Picture pixels;
    const DepthImage image = takeImage(input, pixels);
    PlaneOptions sensor;
    sensor.min_pixels = 1 + options.below(300);
    sensor.min_hole_pixels = 1 + options.below(30);
    sensor.distortion_at_1m = options.between(0, 0.01);
    sensor.step_at_1m = options.between(0, 0.01);
    const int work = options.take<std::uint8_t>() % 5;
    const auto planes = PlaneSegmenter(sensor).segment(image);
    requireSound(planes, image, sensor.min_pixels);
    if (work == 1) findObjects(options, image, sensor, planes);
    if (work == 2) findRoad(options, image);
    if (work == 3) findEdges(options, image);
    if (work == 4) compareOtherwise(options, image, sensor);
  });
}

}  // namespace omnimapper::fuzz
