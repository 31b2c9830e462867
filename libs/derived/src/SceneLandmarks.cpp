#include <omnimapper/derived/PlanShape.h>
#include <omnimapper/derived/SceneLandmarks.h>
#include <omnimapper/draw/LabelColours.h>
#include <omnimapper/obs/SceneDrawing.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::derived {

namespace {

using mrpt::img::TColor;
using mrpt::opengl::CSetOfObjects;
using mrpt::opengl::CSetOfTriangles;

constexpr double kLineStroke = 0.05, kOutlineStroke = 0.015, kPointBall = 0.06, kDash = 0.12;  // [m]
constexpr std::uint8_t kTranslucent = 90, kFaint = 40;

TColor inkOf(const ShapedLandmark& landmark, std::uint8_t alpha = 255) {
  const draw::Rgb colour = draw::colourOfLabel(landmark.shape.label);
  return {colour.r, colour.g, colour.b, alpha};
}

Eigen::Vector3d middleOfSurface(const geometry::Polygon3& surface) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& vertex : surface.vertices) sum += vertex;
  return sum / static_cast<double>(surface.vertices.size());
}

void addDashed(CSetOfTriangles& strokes, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double width) {
  for (const auto& [begin, end] : dashesOf((to - from).norm(), kDash))
    obs::addStroke(strokes, from + begin * (to - from), from + end * (to - from), width);
}

void addMesh(CSetOfTriangles& triangles, const map::Mesh& mesh) {
  const auto at = [&](std::uint32_t index) {
    const Eigen::Vector3d& p = mesh.vertices[index];
    return mrpt::math::TPoint3Df(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  };
  for (const auto& [a, b, c] : mesh.triangles) triangles.insertTriangle(mrpt::opengl::TTriangle(at(a), at(b), at(c)));
}

// The outlines and lines of a landmark, dashed if it has moved.
CSetOfTriangles::Ptr landmarkStrokes(const ShapedLandmark& landmark) {
  auto strokes = CSetOfTriangles::Create();
  const auto add = landmark.moved ? addDashed : obs::addStroke;
  const auto addWalk = [&](const geometry::Polygon3& walk) {
    const auto& vertices = walk.vertices;
    for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++)
      add(*strokes, vertices[j], vertices[i], kOutlineStroke);
  };
  for (const auto& surface : landmark.shape.surfaces) addWalk(surface);
  for (const auto& hole : landmark.shape.holes) addWalk(hole);
  if (landmark.shape.box)
    for (const auto& face : facesOf(*landmark.shape.box)) addWalk(face);
  for (const auto& [from, to] : landmark.shape.lines) add(*strokes, from, to, kLineStroke);
  // A dashed path through its former places.
  if (!landmark.shape.point_stamps.empty()) {
    const auto& points = landmark.shape.points;
    for (std::size_t i = 1; i < points.size(); ++i) addDashed(*strokes, points[i - 1], points[i], kOutlineStroke);
  }
  strokes->setColor_u8(inkOf(landmark));
  strokes->enableLight(false);
  return strokes;
}

// An arrow on the largest surface, towards its free side.
void addNormal(CSetOfObjects& scene, const ShapedLandmark& landmark) {
  const auto& surfaces = landmark.shape.surfaces;
  if (surfaces.empty() || !landmark.shape.normal) return;
  const auto largest = std::max_element(surfaces.begin(), surfaces.end(), [](const auto& a, const auto& b) {
    return geometry::area(a) < geometry::area(b);
  });
  const double length = std::clamp(0.3 * std::sqrt(geometry::area(*largest)), 0.1, 0.4);  // [m]
  const Eigen::Vector3d middle = middleOfSurface(*largest);
  obs::addArrow(scene, middle, middle + length * *landmark.shape.normal, inkOf(landmark));
}

// A place for the name that does not hide the landmark.
Eigen::Vector3d namePlace(const map::LandmarkShape& shape) {
  const Eigen::Vector3d above(0, 0, 0.1);
  if (!shape.surfaces.empty()) return middleOfSurface(shape.surfaces.front()) + above;
  if (shape.box || shape.mesh) return referencePoint(shape) + above;
  if (!shape.lines.empty()) return 0.5 * (shape.lines.front().first + shape.lines.front().second) + above;
  return shape.points.back() + above;
}

// Shows the photograph of a landmark at a point, upright in front of it.
void addPhotograph(CSetOfObjects& object, const map::LandmarkShape& shape) {
  constexpr double kHalfHeight = 0.08, kBefore = 0.05;  // [m]
  if (!shape.photograph || !shape.normal || shape.points.size() != 1) return;
  const auto& [width, height, rgb] = *shape.photograph;
  mrpt::img::CImage image(static_cast<unsigned>(width), static_cast<unsigned>(height), mrpt::img::CH_RGB);
  for (int y = 0; y < height; ++y) {
    auto* pixel = image.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
    for (int x = 0; x < width; ++x, pixel += 3) {  // MRPT stores blue first
      const auto* from = rgb.data() + std::size_t{3} * (static_cast<std::size_t>(y) * width + x);
      std::reverse_copy(from, from + 3, pixel);
    }
  }
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ(), right = down.cross(-*shape.normal);
  if (!(right.norm() > 0.5)) return;
  obs::addPicture(object, shape.points.front() + kBefore * *shape.normal,
                  kHalfHeight * width / height * right.normalized(), kHalfHeight * down, image);
}

CSetOfObjects::Ptr objectOf(const ShapedLandmark& landmark, bool with_name) {
  auto object = CSetOfObjects::Create();
  const map::LandmarkShape& shape = landmark.shape;
  const std::string name = shape.label + " " + toString(landmark.landmark->id);
  object->setName(name);
  if (!landmark.moved) {
    const std::uint8_t alpha = draw::coversThePlan(shape.label) || landmark.isFaint() ? kFaint : kTranslucent;
    for (std::size_t i = 0; i < shape.surfaces.size(); ++i)
      obs::addFilled(*object, planeOf(shape.surfaces[i], shape), withHoles(i, shape), inkOf(landmark, alpha));
    if (shape.box && !shape.mesh)
      for (const auto& face : facesOf(*shape.box))
        obs::addFilled(*object, planeOf(face, {}), {face}, inkOf(landmark, alpha));
    if (shape.mesh) {
      auto surface = CSetOfTriangles::Create();
      addMesh(*surface, *shape.mesh);
      surface->setColor_u8(inkOf(landmark));
      object->insert(surface);
    }
    if (!landmark.isFaint()) addNormal(*object, landmark);
  }
  if (const auto strokes = landmarkStrokes(landmark); strokes->getTrianglesCount() > 0) object->insert(strokes);
  for (const auto& point : shape.points) obs::addBall(*object, point, kPointBall, inkOf(landmark));
  addPhotograph(*object, shape);
  if (with_name && !landmark.isFaint()) {
    const std::string text =
        shape.label + " " + (shape.caption.empty() ? std::to_string(landmark.landmark->id.index) : shape.caption);
    obs::addText(*object, namePlace(shape), landmark.moved ? text + " (moved)" : text, inkOf(landmark));
  }
  return object;
}

// Two square pyramids joined at their bases.
void addOctahedron(CSetOfTriangles& triangles, const Eigen::Vector3d& middle) {
  const auto corner = [&](int axis, double side) {
    Eigen::Vector3d p = middle;
    p[axis] += side * kPointBall;
    return mrpt::math::TPoint3Df(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  };
  for (const double z : {1, -1}) {
    for (const double y : {1, -1}) {
      for (const double x : {1, -1}) {
        const bool outwards = x * y * z > 0;
        const auto a = corner(0, x), b = corner(1, y), c = corner(2, z);
        triangles.insertTriangle(outwards ? mrpt::opengl::TTriangle(a, b, c) : mrpt::opengl::TTriangle(b, a, c));
      }
    }
  }
}

}  // namespace

CSetOfObjects::Ptr landmarkObjects(const std::vector<ShapedLandmark>& landmarks, bool with_names) {
  auto objects = CSetOfObjects::Create();
  objects->setName("landmarks");
  for (const auto& landmark : landmarks)
    if (landmark.isSomewhere()) objects->insert(objectOf(landmark, with_names));
  return objects;
}

std::vector<mrpt::opengl::TTriangle> landmarkTriangles(const std::vector<ShapedLandmark>& landmarks) {
  std::vector<mrpt::opengl::TTriangle> all;
  for (const auto& landmark : landmarks) {
    if (landmark.moved) continue;
    const map::LandmarkShape& shape = landmark.shape;
    const auto take = [&](const CSetOfTriangles& triangles) {
      for (std::size_t i = 0; i < triangles.getTrianglesCount(); ++i) {
        triangles.getTriangle(i, all.emplace_back());
        all.back().setColor(inkOf(landmark));
      }
    };
    for (std::size_t i = 0; i < shape.surfaces.size(); ++i)
      take(*obs::filled(planeOf(shape.surfaces[i], shape), withHoles(i, shape)));
    CSetOfTriangles more;
    for (const auto& [from, to] : shape.lines) obs::addStroke(more, from, to, kLineStroke);
    for (const auto& point : shape.points) addOctahedron(more, point);
    if (shape.mesh) {
      addMesh(more, *shape.mesh);
    } else if (shape.box) {
      for (const auto& face : facesOf(*shape.box)) take(*obs::filled(planeOf(face, {}), {face}));
    }
    take(more);
  }
  return all;
}

}  // namespace omnimapper::derived
