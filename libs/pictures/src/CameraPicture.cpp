#include "CameraPicture.h"

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/camera/PictureView.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/draw/Legend.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/perception/EdgeExtractor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "IndexRgb.h"
#include "MarkerDrawing.h"
#include "SignDrawing.h"

namespace omnimapper::pictures {

namespace {

using mrpt::obs::CObservation3DRangeScan;
using Walk = std::vector<draw::PixelPoint>;

constexpr double kNearestDrawn = 0.01;  // [m] nearer points are not drawn
constexpr draw::Rgb kBlack{0, 0, 0};

/// Projects points in the sensor frame (x forward, y left, z up) [m] into the picture.
class Projection {
 public:
  explicit Projection(const mrpt::img::TCamera& camera)
      : fx_(camera.fx()), fy_(camera.fy()), cx_(camera.cx()), cy_(camera.cy()) {}

  std::optional<draw::PixelPoint> operator()(const Eigen::Vector3d& p) const {
    if (!(p.x() > kNearestDrawn)) return std::nullopt;
    return draw::PixelPoint{cx_ - fx_ * p.y() / p.x() + 0.5, cy_ - fy_ * p.z() / p.x() + 0.5};
  }
  Walk operator()(const geometry::Polygon3& polygon) const {
    Walk walk;
    for (const auto& vertex : polygon.vertices) {
      if (const auto pixel = (*this)(vertex)) walk.push_back(*pixel);
    }
    return walk;
  }

 private:
  double fx_, fy_, cx_, cy_;
};

draw::Rgb greyed(int red, int green, int blue) {
  const int grey = (red + green + blue) / 3;
  const auto mixed = [&](int channel) { return static_cast<std::uint8_t>((channel + grey) / 2); };
  return {mixed(red), mixed(green), mixed(blue)};
}

bool canBeDrawnOver(const mrpt::img::CImage& image) {
  return !image.isEmpty() && image.getPixelDepth() == mrpt::img::PixelDepth::D8U &&
         (image.channelCount() == 1 || image.channelCount() == 3);
}

bool showsTheDepth(const CObservation3DRangeScan& scan) {
  return camera::isPictureOfDepthView(scan) && canBeDrawnOver(scan.intensityImage);
}

draw::Image colourPicture(const mrpt::img::CImage& colours) {
  draw::Image picture(static_cast<int>(colours.getWidth()), static_cast<int>(colours.getHeight()), kBlack);
  const int channels = static_cast<int>(colours.channelCount());
  for (int y = 0; y < picture.height; ++y) {
    const auto* row = colours.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
    for (int x = 0; x < picture.width; ++x) {
      const auto* pixel = row + static_cast<std::ptrdiff_t>(channels) * x;
      picture.at(x, y) = channels < 3 ? greyed(pixel[0], pixel[0], pixel[0]) : greyed(pixel[2], pixel[1], pixel[0]);
    }
  }
  return picture;
}

// Grey values are proportional to inverse depth, so that near and far parts are equally visible.
draw::Image depthPicture(const CObservation3DRangeScan& scan) {
  draw::Image picture(static_cast<int>(scan.rangeImage.cols()), static_cast<int>(scan.rangeImage.rows()), kBlack);
  int nearest = 65535;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int range = scan.rangeImage(y, x);
      if (range > 0) nearest = std::min(nearest, range);
    }
  }
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int range = scan.rangeImage(y, x);
      if (range == 0 || range == 65535) continue;
      const auto grey = static_cast<std::uint8_t>(40 + 200 * nearest / range);
      picture.at(x, y) = {grey, grey, grey};
    }
  }
  return picture;
}

void drawClosed(draw::Image& picture, Walk walk, const draw::Pen& pen) {
  if (walk.empty()) return;
  walk.push_back(walk.front());
  drawPath(picture, walk, pen);
}

void drawArrow(draw::Image& picture, draw::PixelPoint from, draw::PixelPoint to, const draw::Pen& pen) {
  drawLine(picture, from, to, pen);
  const double x = to.x - from.x, y = to.y - from.y;
  for (const double side : {-0.15, 0.15}) {
    drawLine(picture, to, {to.x - 0.25 * x + side * y, to.y - 0.25 * y - side * x}, pen);
  }
}

void drawPlanes(draw::Image& picture, const Projection& project, const obs::CObservationPlanes& found) {
  for (std::size_t i = 0; i < found.planes.size(); ++i) {
    std::vector<Walk> walks{project(found.planes[i].outline)};
    for (const auto& hole : found.planes[i].holes) walks.push_back(project(hole));
    fillAreas(picture, walks, {indexRgb(i), 0, 0.4});
    for (const auto& walk : walks) drawClosed(picture, walk, {indexRgb(i), 2});
  }
  // Arrows are drawn after all areas, so that no area hides one.
  for (std::size_t i = 0; i < found.planes.size(); ++i) {
    const auto& plane = found.planes[i];
    const double length = std::clamp(0.3 * std::sqrt(geometry::area(plane.outline)), 0.05, 0.5);  // [m]
    const auto from = project(plane.centroid), to = project(plane.centroid + length * plane.plane_in_sensor.normal);
    if (!from || !to) continue;
    drawArrow(picture, *from, *to, {kBlack, 4});
    drawArrow(picture, *from, *to, {indexRgb(i), 2});
    drawDot(picture, *from, {kBlack, 7});
    drawDot(picture, *from, {indexRgb(i), 5});
  }
}

void drawBox(draw::Image& picture, const Projection& project, const obs::ObservedObject& object, const draw::Pen& pen) {
  const auto corner = [&](int i) {
    const Eigen::Vector3d sides(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    return project(object.sensor_from_box * Eigen::Vector3d(sides.cwiseProduct(object.box_size)));
  };
  for (int i = 0; i < 8; ++i) {
    for (const int side : {1, 2, 4}) {
      const auto from = corner(i), to = corner(i | side);
      if (!(i & side) && from && to) drawLine(picture, *from, *to, pen);
    }
  }
}

void drawPoints(draw::Image& picture, const Projection& project, const std::vector<Eigen::Vector3f>& points,
                const draw::Pen& pen) {
  for (const auto& point : points) {
    if (const auto pixel = project(point.cast<double>())) drawDot(picture, *pixel, pen);
  }
}

void drawObjects(draw::Image& picture, const Projection& project, const obs::CObservationObjects& found) {
  for (std::size_t i = 0; i < found.objects.size(); ++i) {
    drawPoints(picture, project, found.objects[i].points, {indexRgb(i), 1, 0.8});
    drawBox(picture, project, found.objects[i], {kBlack, 4});
    drawBox(picture, project, found.objects[i], {indexRgb(i), 2});
  }
}

void drawCloud(draw::Image& picture, const Projection& project, const mrpt::maps::CPointsMap& cloud, draw::Rgb colour) {
  std::vector<Eigen::Vector3f> points(cloud.size());
  for (std::size_t i = 0; i < points.size(); ++i) cloud.getPointFast(i, points[i].x(), points[i].y(), points[i].z());
  drawPoints(picture, project, points, {colour, 2});
}

/// Colour of a cloud and its name in the legend.
struct CloudStyle {
  draw::Rgb colour;
  std::string name;
};

// Edges are coloured by kind as in thesis figure 4, other clouds by their index.
CloudStyle styleOfCloud(const std::string& label, std::size_t index) {
  static const std::map<perception::EdgeKind, draw::Rgb> kinds{{perception::kBoundary, {40, 80, 255}},
                                                               {perception::kOccluding, {0, 220, 0}},
                                                               {perception::kOccluded, {230, 0, 0}},
                                                               {perception::kHighCurvature, {255, 230, 0}},
                                                               {perception::kRgb, {0, 230, 230}}};
  for (const auto& [kind, colour] : kinds) {
    const std::string end = std::string(perception::kEdgesSuffix) + perception::nameOf(kind);
    if (label.size() > end.size() && label.compare(label.size() - end.size(), end.size(), end) == 0)
      return {colour, std::string("edge: ") + perception::nameOf(kind)};
  }
  return {indexRgb(index), label};
}

}  // namespace

draw::Image drawCameraPicture(const CObservation3DRangeScan& scan,
                              const std::vector<mrpt::obs::CObservation::Ptr>& derived) {
  draw::Image picture = showsTheDepth(scan) ? colourPicture(scan.intensityImage) : depthPicture(scan);
  const Projection project(scan.cameraParams);
  std::size_t clouds = 0;
  std::vector<draw::LegendRow> legend;
  const auto addRow = [&](std::size_t count, draw::Rgb colour, const std::string& text) {
    if (count > 0) legend.push_back({colour, text});
  };
  for (const auto& observation : derived) {
    if (const auto* planes = dynamic_cast<const obs::CObservationPlanes*>(observation.get())) {
      drawPlanes(picture, project, *planes);
      const std::size_t n = planes->planes.size();
      addRow(n, indexRgb(0), std::to_string(n) + " planes, a colour each: outline, holes, normal");
    } else if (const auto* objects = dynamic_cast<const obs::CObservationObjects*>(observation.get())) {
      drawObjects(picture, project, *objects);
      const std::size_t n = objects->objects.size();
      addRow(n, indexRgb(0), std::to_string(n) + " objects, a colour each: points, box");
    } else if (const auto* markers = dynamic_cast<const mrpt::obs::CObservationBearingRange*>(observation.get())) {
      drawMarkers(picture, scan.cameraParams, geometry::fromMrpt(scan.sensorPose), *markers, legend);
    } else if (const auto* signs = dynamic_cast<const obs::CObservationDoorSigns*>(observation.get())) {
      if (camera::isPictureOfDepthView(scan)) drawSigns(picture, *signs, legend);
    } else if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(observation.get())) {
      if (!cloud->pointcloud) continue;
      const CloudStyle style = styleOfCloud(cloud->sensorLabel, clouds++);
      drawCloud(picture, project, *cloud->pointcloud, style.colour);
      addRow(cloud->pointcloud->size(), style.colour, style.name);
    }
  }
  draw::drawLegend(picture, legend);
  return picture;
}

std::optional<draw::Image> drawCameraPicture(const mrpt::obs::CObservationImage& observation,
                                             const std::vector<mrpt::obs::CObservation::Ptr>& derived) {
  if (!canBeDrawnOver(observation.image)) return std::nullopt;
  draw::Image picture = colourPicture(observation.image);
  const geometry::Se3 base_from_camera =
      geometry::fromMrpt(observation.cameraPose) * geometry::inverse(geometry::sensorFromOptical());
  std::vector<draw::LegendRow> legend;
  for (const auto& found : derived) {
    if (const auto* markers = dynamic_cast<const mrpt::obs::CObservationBearingRange*>(found.get()))
      drawMarkers(picture, observation.cameraParams, base_from_camera, *markers, legend);
    if (const auto* signs = dynamic_cast<const obs::CObservationDoorSigns*>(found.get()))
      drawSigns(picture, *signs, legend);
  }
  draw::drawLegend(picture, legend);
  return picture;
}

}  // namespace omnimapper::pictures
