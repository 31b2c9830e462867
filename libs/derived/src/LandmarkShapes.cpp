#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/plugin/LandmarkShape.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace omnimapper::derived {

namespace {

bool isSurface(const geometry::Polygon3& polygon) {
  const auto& vertices = polygon.vertices;
  return std::all_of(vertices.begin(), vertices.end(), [](const auto& v) { return v.allFinite(); }) &&
         geometry::area(polygon) > 0;
}

template <class List, class Keeps>
void keep(List& list, Keeps keeps) {
  list.erase(std::remove_if(list.begin(), list.end(), [&](const auto& item) { return !keeps(item); }), list.end());
}

void keepFinitePoints(map::LandmarkShape& shape) {
  const bool stamped = shape.point_stamps.size() == shape.points.size();
  std::vector<Eigen::Vector3d> points;
  std::vector<base::Stamp> stamps;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    if (!shape.points[i].allFinite()) continue;
    points.push_back(shape.points[i]);
    if (stamped) stamps.push_back(shape.point_stamps[i]);
  }
  shape.points = std::move(points);
  shape.point_stamps = std::move(stamps);
}

void keepFinite(map::LandmarkShape& shape) {
  keep(shape.surfaces, isSurface);
  keep(shape.holes, isSurface);
  keep(shape.lines, [](const auto& line) { return line.first.allFinite() && line.second.allFinite(); });
  keepFinitePoints(shape);
  if (shape.photograph) {
    const auto& [width, height, rgb] = *shape.photograph;
    if (width <= 0 || height <= 0 || rgb.size() != std::size_t{3} * width * height) shape.photograph = nullptr;
  }
  if (shape.normal && !(shape.normal->norm() > 0.5 && shape.normal->allFinite())) shape.normal.reset();
}

}  // namespace

std::vector<ShapedLandmark> shapesOf(const mapper::State& state, Candidates candidates) {
  std::vector<ShapedLandmark> shapes;
  for (const auto& [id, landmark] : state.map.landmarks) {
    if (landmark.state == map::Landmark::State::merged) continue;
    ShapedLandmark shaped{&landmark, mapper::shapeOf(landmark, state), landmark.state == map::Landmark::State::retired};
    if (shaped.shape.is_candidate && candidates == Candidates::left_out) continue;
    keepFinite(shaped.shape);
    shapes.push_back(std::move(shaped));
  }
  return shapes;
}

std::map<std::string, std::size_t> seenBy(const map::LandmarkShape& shape) {
  constexpr std::string_view kPrefix = "seen_by_";
  std::map<std::string, std::size_t> seen_by;
  for (const auto& [name, value] : shape.properties) {
    if (name.compare(0, kPrefix.size(), kPrefix) != 0) continue;
    std::size_t count = 0;
    std::from_chars(value.data(), value.data() + value.size(), count);
    if (count > 0) seen_by[name.substr(kPrefix.size())] += count;
  }
  return seen_by;
}

std::string sensorsText(const std::map<std::string, std::size_t>& seen_by) {
  if (seen_by.size() == 1) return seen_by.begin()->first + " only";
  std::string text;
  for (const auto& [label, count] : seen_by) text += (text.empty() ? "" : " and ") + label;
  return text;
}

std::vector<geometry::Polygon3> withHoles(std::size_t surface, const map::LandmarkShape& shape) {
  std::vector<geometry::Polygon3> walks = map::holesIn(shape, surface);
  walks.insert(walks.begin(), shape.surfaces[surface]);
  return walks;
}

double areaOf(const map::LandmarkShape& shape) {
  double sum = 0;
  for (const auto& surface : shape.surfaces) sum += geometry::area(surface);
  for (const auto& hole : shape.holes) sum -= geometry::area(hole);
  return sum;
}

double lengthOf(const map::LandmarkShape& shape) {
  double sum = 0;
  for (const auto& [from, to] : shape.lines) sum += (to - from).norm();
  return sum;
}

Eigen::AlignedBox3d boxOf(const map::LandmarkShape& shape) {
  Eigen::AlignedBox3d box;
  for (const auto& surface : shape.surfaces)
    for (const auto& vertex : surface.vertices) box.extend(vertex);
  for (const auto& [from, to] : shape.lines) box.extend(from).extend(to);
  for (const auto& point : shape.points) box.extend(point);
  return box;
}

std::string photographAddress(const map::LandmarkShape& shape) {
  if (!shape.photograph) return {};
  const auto& [width, height, rgb] = *shape.photograph;
  draw::Image image(width, height, {});
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
  return draw::pngAddress(draw::encodePng(image));
}

geometry::Plane3 planeOf(const geometry::Polygon3& surface, const map::LandmarkShape& shape) {
  Eigen::Vector3d normal = geometry::areaVector(surface).normalized();
  if (shape.normal && shape.normal->dot(normal) < 0) normal = -normal;
  return geometry::Plane3::through(surface.vertices.front(), normal);
}

}  // namespace omnimapper::derived
