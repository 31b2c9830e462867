#include "MapMessages.h"

#include <omnimapper/draw/LabelColours.h>

#include <Eigen/Core>
#include <algorithm>

#include "CdrWriter.h"

namespace omnimapper::ros_export {

namespace {

constexpr std::uint64_t kSecond = 1'000'000'000;  // [ns]
// Types of visualization_msgs/Marker.
enum class Shape : std::uint8_t { line_list = 5, sphere_list = 7, text = 9 };

void addHeader(CdrWriter& out, std::uint64_t time) {
  out.uint(time / kSecond, 4).uint(time % kSecond, 4).text(kMapFrame);
}

void addVector(CdrWriter& out, const Eigen::Vector3d& v) {
  out.real(v.x()).real(v.y()).real(v.z());
}

// Position and orientation, or translation and rotation.
void addPose(CdrWriter& out, const mrpt::poses::CPose3D& pose) {
  mrpt::math::CQuaternionDouble q;
  pose.getAsQuaternion(q);
  out.real(pose.x()).real(pose.y()).real(pose.z()).real(q.x()).real(q.y()).real(q.z()).real(q.r());
}

void addReals(CdrWriter& out, int count) {
  for (int i = 0; i < count; ++i) out.real(0);
}

/// What a marker shows: points, of which two make a line, or a text at a point.
struct Look {
  Shape shape = Shape::line_list;
  std::vector<Eigen::Vector3d> points;
  std::string text = {};
  double size = 0;  // [m] width of lines, diameter of points, height of letters
};

void addMarker(CdrWriter& out, std::uint64_t time, const map::Place& place, int id, const Look& look) {
  constexpr float kAlpha = 1, kAlphaOfMoved = 0.3F;
  addHeader(out, time);
  out.text(place.moved ? "moved" : place.label).integer(id).integer(static_cast<int>(look.shape)).integer(0);
  const bool is_text = look.shape == Shape::text;
  const Eigen::Vector3d at = is_text ? look.points.front() : Eigen::Vector3d::Zero();
  addPose(out, mrpt::poses::CPose3D(at.x(), at.y(), at.z(), 0, 0, 0));
  addVector(out, Eigen::Vector3d::Constant(look.size));
  const draw::Rgb colour = draw::colourOfLabel(place.label);
  for (const std::uint8_t part : {colour.r, colour.g, colour.b}) out.real32(static_cast<float>(part) / 255);
  out.real32(place.moved ? kAlphaOfMoved : kAlpha).integer(0).integer(0).byte(0);  // for ever, not locked to its frame
  out.integer(is_text ? 0 : static_cast<std::int64_t>(look.points.size()));
  if (!is_text)
    for (const auto& point : look.points) addVector(out, point);
  out.integer(0).text("");                      // colours of points, texture
  out.integer(0).integer(0).text("").text("");  // its image: header and format
  out.integer(0).integer(0).text(look.text);    // its data, its coordinates
  out.text("").text("").integer(0).byte(0);     // mesh
}

Eigen::Vector3d at(const Eigen::Vector2d& point, double z) {
  return {point.x(), point.y(), z};
}

void addEdge(std::vector<Eigen::Vector3d>& lines, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
             const map::Extent& extent) {
  lines.push_back(at(from, extent.bottom));
  lines.push_back(at(to, extent.bottom));
  if (!(extent.top > extent.bottom)) return;
  lines.push_back(at(from, extent.top));
  lines.push_back(at(to, extent.top));
  for (const auto& end : {from, to}) {
    lines.push_back(at(end, extent.bottom));
    lines.push_back(at(end, extent.top));
  }
}

std::vector<Eigen::Vector3d> edgesOf(const map::Extent& extent) {
  std::vector<Eigen::Vector3d> lines;
  for (const auto& [from, to] : extent.lines) addEdge(lines, from, to, extent);
  for (const auto* closed : {&extent.outlines, &extent.holes})
    for (const auto& walk : *closed)
      for (std::size_t i = 0; i < walk.size(); ++i) addEdge(lines, walk[i], walk[(i + 1) % walk.size()], extent);
  return lines;
}

std::vector<Look> looksOf(const map::Place& place) {
  constexpr double kLine = 0.03, kPoint = 0.12, kLetter = 0.2;  // [m]
  std::vector<Look> looks;
  if (auto edges = edgesOf(place.extent); !edges.empty())
    looks.push_back({Shape::line_list, std::move(edges), "", kLine});
  std::vector<Eigen::Vector3d> points;
  for (const auto& point : place.extent.points) points.push_back(at(point, place.position.z()));
  if (!points.empty()) looks.push_back({Shape::sphere_list, std::move(points), "", kPoint});
  const Eigen::Vector3d above = at(place.position.head<2>(), std::max(place.extent.top, place.position.z()) + kLetter);
  looks.push_back({Shape::text, {above}, place.caption.empty() ? place.label : place.caption, kLetter});
  return looks;
}

}  // namespace

std::string transformMessage(const TimedPose& pose) {
  CdrWriter out;
  out.integer(1);
  addHeader(out, pose.first);
  out.text(kBaseFrame);
  addPose(out, pose.second);
  return out.bytes();
}

std::string odometryMessage(const TimedPose& pose) {
  constexpr int kCovariance = 36, kTwist = 6;
  CdrWriter out;
  addHeader(out, pose.first);
  out.text(kBaseFrame);
  addPose(out, pose.second);
  addReals(out, kCovariance + kTwist + kCovariance);
  return out.bytes();
}

std::string pathMessage(const std::vector<TimedPose>& poses) {
  CdrWriter out;
  addHeader(out, poses.front().first);
  out.integer(static_cast<std::int64_t>(poses.size()));
  for (const auto& [time, pose] : poses) {
    addHeader(out, time);
    addPose(out, pose);
  }
  return out.bytes();
}

std::string gridMessage(std::uint64_t time, const grid::GridMap& grid) {
  CdrWriter out;
  addHeader(out, time);
  out.uint(time / kSecond, 4).uint(time % kSecond, 4).real32(static_cast<float>(grid.resolution));
  out.integer(grid.columns).integer(grid.rows);
  const auto& origin = grid.map_from_grid;
  addPose(out, mrpt::poses::CPose3D(origin.x, origin.y, 0, origin.yaw, 0, 0));
  out.integer(static_cast<std::int64_t>(grid.cells.size()));
  for (const auto cell : grid.cells)
    out.byte(cell == grid::GridCell::unknown ? 0xff : cell == grid::GridCell::free ? 0 : 100);
  return out.bytes();
}

std::string markersMessage(std::uint64_t time, const std::vector<map::Place>& places) {
  std::vector<std::pair<const map::Place*, Look>> markers;
  for (const auto& place : places)
    for (auto& look : looksOf(place)) markers.emplace_back(&place, std::move(look));
  CdrWriter out;
  out.integer(static_cast<std::int64_t>(markers.size()));
  int id = 0;
  for (const auto& [place, look] : markers) addMarker(out, time, *place, id++, look);
  return out.bytes();
}

}  // namespace omnimapper::ros_export
