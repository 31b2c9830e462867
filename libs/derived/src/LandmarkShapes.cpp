#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/map/Corrections.h>
#include <omnimapper/plugin/LandmarkShape.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::derived {

namespace {

bool isSurface(const geometry::Polygon3& polygon) {
  const auto& vertices = polygon.vertices;
  return std::all_of(vertices.begin(), vertices.end(), [](const auto& v) { return v.allFinite(); }) &&
         geometry::area(polygon) > 0;
}

bool isBox(const map::Box& box) {
  return box.middle.allFinite() && box.size.allFinite() && box.size.minCoeff() > 0 &&
         std::abs(box.map_from_box.norm() - 1) < 1e-3;  // false for a number that is not finite, too
}

bool isMesh(const map::Mesh& mesh) {
  const auto is_corner = [&](std::uint32_t index) { return index < mesh.vertices.size(); };
  return !mesh.vertices.empty() && !mesh.triangles.empty() &&
         std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const auto& v) { return v.allFinite(); }) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const auto& t) { return std::all_of(t.begin(), t.end(), is_corner); });
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
  if (shape.box && !isBox(*shape.box)) shape.box.reset();
  if (shape.mesh && !isMesh(*shape.mesh)) shape.mesh = nullptr;
  if (shape.normal && !(shape.normal->norm() > 0.5 && shape.normal->allFinite())) shape.normal.reset();
}

// The centre of its surfaces, else of its box, else of its mesh, else of its lines, else of its points.
Eigen::Vector3d middleOf(const map::LandmarkShape& shape) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0;
  const auto add = [&](const Eigen::Vector3d& at, double of) {
    sum += of * at;
    weight += of;
  };
  for (const auto& surface : shape.surfaces) {
    const auto& corners = surface.vertices;
    const Eigen::Vector3d normal = geometry::areaVector(surface).normalized();
    // Triangles that share the first corner; where the outline is concave their areas are negative.
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const double twice = (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]).dot(normal);
      add((corners[0] + corners[i - 1] + corners[i]) / 3, twice / 2);
    }
  }
  if (weight > 0) return sum / weight;
  if (shape.box) return shape.box->middle;
  sum.setZero();
  weight = 0;
  if (shape.mesh)
    for (const auto& vertex : shape.mesh->vertices) add(vertex, 1);
  if (weight > 0) return sum / weight;
  for (const auto& [from, to] : shape.lines) add((from + to) / 2, (to - from).norm());
  if (weight > 0) return sum / weight;
  for (const auto& [from, to] : shape.lines) add((from + to) / 2, 1);
  for (const auto& point : shape.points) add(point, 1);
  return sum / weight;
}

}  // namespace

Eigen::Vector3d referencePoint(const map::LandmarkShape& shape) {
  const auto& stamps = shape.point_stamps;
  if (stamps.empty() || stamps.size() != shape.points.size()) return middleOf(shape);
  return shape.points[static_cast<std::size_t>(std::max_element(stamps.begin(), stamps.end()) - stamps.begin())];
}

std::vector<ShapedLandmark> shapesOf(const mapper::State& state, Candidates candidates) {
  std::vector<ShapedLandmark> shapes;
  const auto deleted = map::deletedLandmarks(state.map);
  for (const auto& [id, landmark] : state.map.landmarks) {
    if (landmark.state == map::Landmark::State::merged || deleted.count(id) > 0) continue;
    ShapedLandmark shaped{&landmark, mapper::shapeOf(landmark, state), landmark.state == map::Landmark::State::retired};
    if (shaped.shape.is_candidate && candidates == Candidates::left_out) continue;
    keepFinite(shaped.shape);
    shapes.push_back(std::move(shaped));
  }
  return shapes;
}

std::string sensorsText(const std::map<std::string, std::uint64_t>& seen_by) {
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
  if (shape.box)
    for (const auto& corner : shape.box->corners()) box.extend(corner);
  if (shape.mesh)
    for (const auto& vertex : shape.mesh->vertices) box.extend(vertex);
  return box;
}

std::vector<geometry::Polygon3> facesOf(const map::Box& box) {
  const auto corners = box.corners();
  std::vector<geometry::Polygon3> faces;
  for (const auto& [a, b, c, d] : {std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}, std::array{0, 1, 5, 4},
                                   std::array{2, 6, 7, 3}, std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}}) {
    const auto at = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
    faces.push_back({{at(a), at(b), at(c), at(d)}});
  }
  return faces;
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
