#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/obs/SceneDrawing.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::obs {

namespace {

constexpr double kFarthest = 1e9;        // [m] edges beyond are not drawn, because sums of them might not be finite
constexpr std::size_t kMostSlabs = 300;  // if there are more heights, evenly spaced ones are used instead

struct Edge {
  Eigen::Vector2d low, high;  // ends with the lower and the higher y
};

std::vector<Edge> edgesOf(const std::vector<geometry::Polygon3>& polygons, const Eigen::Vector3d& origin,
                          const Eigen::Matrix<double, 3, 2>& basis) {
  std::vector<Edge> edges;
  for (const auto& polygon : polygons) {
    const auto& vertices = polygon.vertices;
    for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++) {
      const Eigen::Vector2d a = basis.transpose() * (vertices[i] - origin);
      const Eigen::Vector2d b = basis.transpose() * (vertices[j] - origin);
      const double reach = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
      if (!a.allFinite() || !b.allFinite() || reach > kFarthest || a.y() == b.y()) continue;
      edges.push_back(a.y() < b.y() ? Edge{a, b} : Edge{b, a});
    }
  }
  return edges;
}

std::vector<double> heightsOf(const std::vector<Edge>& edges) {
  std::vector<double> heights;
  for (const auto& edge : edges) {
    heights.push_back(edge.low.y());
    heights.push_back(edge.high.y());
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  if (heights.size() <= kMostSlabs) return heights;
  const double low = heights.front(), step = (heights.back() - low) / kMostSlabs;
  heights.clear();
  for (std::size_t i = 0; i <= kMostSlabs; ++i) heights.push_back(low + static_cast<double>(i) * step);
  return heights;
}

double across(const Edge& edge, double y) {
  const double share = std::clamp((y - edge.low.y()) / (edge.high.y() - edge.low.y()), 0.0, 1.0);
  return edge.low.x() + share * (edge.high.x() - edge.low.x());
}

}  // namespace

// The polygons are cut into slabs between the heights of their vertices, in which they consist of trapezoids. Unlike
// triangulation between vertices, this always works with holes, notches and polygons that cross themselves.
mrpt::opengl::CSetOfTriangles::Ptr filled(const geometry::Plane3& plane,
                                          const std::vector<geometry::Polygon3>& polygons) {
  auto triangles = mrpt::opengl::CSetOfTriangles::Create();
  if (!isFinite(plane.normal) || !(std::abs(plane.normal.norm() - 1) < 1e-3) || !std::isfinite(plane.distance)) {
    return triangles;
  }
  const Eigen::Vector3d origin = -plane.distance * plane.normal;
  const auto basis = geometry::tangentBasis(plane.normal);
  const auto edges = edgesOf(polygons, origin, basis);
  const auto heights = heightsOf(edges);
  const auto corner = [&](double x, double y) {
    const Eigen::Vector3d p = origin + basis * Eigen::Vector2d(x, y);
    return mrpt::math::TPoint3Df(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  };
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const double low = heights[i - 1], high = heights[i], middle = 0.5 * (low + high);
    std::vector<std::pair<double, const Edge*>> crossed;
    for (const auto& edge : edges) {
      if (edge.low.y() <= middle && middle < edge.high.y()) crossed.emplace_back(across(edge, middle), &edge);
    }
    std::sort(crossed.begin(), crossed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = 0; k + 1 < crossed.size(); k += 2) {
      const Edge &left = *crossed[k].second, &right = *crossed[k + 1].second;
      const auto a = corner(across(left, low), low), b = corner(across(right, low), low);
      const auto c = corner(across(right, high), high), d = corner(across(left, high), high);
      triangles->insertTriangle(mrpt::opengl::TTriangle(a, b, c));
      triangles->insertTriangle(mrpt::opengl::TTriangle(a, c, d));
    }
  }
  return triangles;
}

void addFilled(mrpt::opengl::CSetOfObjects& scene, const geometry::Plane3& plane,
               const std::vector<geometry::Polygon3>& polygons, const mrpt::img::TColor& colour) {
  const auto triangles = filled(plane, polygons);
  if (triangles->getTrianglesCount() == 0) return;
  triangles->enableLight(false);
  triangles->setColor_u8(colour);
  scene.insert(triangles);
}

}  // namespace omnimapper::obs
