#include <gtest/gtest.h>
#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/Triangulate.h>

#include <cmath>

namespace mesh_builder_test {
namespace {

using namespace omnimapper;
using Eigen::Vector2d;
using Eigen::Vector3d;
using sim::MeshBuilder;
using sim::Ring;

double areaOf(const sim::Body& body, const sim::Triangle& triangle) {
  const auto& v = body.vertices_in_body;
  const Vector3d& a = v[triangle.corners[0]];
  return (v[triangle.corners[1]] - a).cross(v[triangle.corners[2]] - a).norm() / 2;
}

double areaOf(const sim::Body& body) {
  double area = 0;
  for (const auto& triangle : body.triangles) area += areaOf(body, triangle);
  return area;
}

// Volume inside a closed body whose triangles are counter-clockwise from outside.
double volumeOf(const sim::Body& body) {
  double volume = 0;
  for (const auto& t : body.triangles) {
    const auto& v = body.vertices_in_body;
    volume += v[t.corners[0]].dot(v[t.corners[1]].cross(v[t.corners[2]])) / 6;
  }
  return volume;
}

double areaOf(const std::vector<Ring>& rings) {
  double area = 0;
  for (const Ring& ring : rings) area += (&ring == &rings.front() ? 1 : -1) * std::abs(sim::doubleArea(ring)) / 2;
  return area;
}

double areaOf(const std::vector<Ring>& rings, const std::vector<std::array<int, 3>>& triangles) {
  Ring points;
  for (const Ring& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
  double area = 0;
  for (const auto& t : triangles) {
    const double twice = sim::doubleArea({points[t[0]], points[t[1]], points[t[2]]});
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  return area;
}

TEST(Triangulate, aSquareWithASquareHoleIsEightTriangles) {
  const std::vector<Ring> rings{{{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}};
  const auto triangles = sim::triangulate(rings);
  EXPECT_EQ(triangles.size(), 8u);
  EXPECT_DOUBLE_EQ(areaOf(rings, triangles), 8);
}

TEST(Triangulate, starsWithHolesKeepTheirArea) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    sim::Random random(seed, {1});
    std::vector<Ring> rings(1);
    const int corners = random.integer(5, 30);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * M_PI * i / corners, radius = random.uniform(4, 9);
      rings[0].emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    // The disc of radius 4 cos(36 deg) is inside all of these outlines: holes are on a raster within 2 m.
    for (int x = -2; x <= 1; ++x) {
      for (int y = -2; y <= 1; ++y) {
        if (!random.chance(0.5)) continue;
        const Vector2d low(x + random.uniform(0.05, 0.4), y + random.uniform(0.05, 0.4));
        rings.push_back({low, low + Vector2d(0, 0.5), low + Vector2d(0.5, 0.5), low + Vector2d(0.5, 0)});
      }
    }
    EXPECT_NEAR(areaOf(rings, sim::triangulate(rings)), areaOf(rings), 1e-9) << seed;
  }
}

TEST(Triangulate, straightCornersStayCorners) {
  const std::vector<Ring> rings{{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}};
  const auto triangles = sim::triangulate(rings);
  EXPECT_EQ(triangles.size(), 4u);
  EXPECT_DOUBLE_EQ(areaOf(rings, triangles), 2);
}

TEST(Triangulate, whatIsNoPolygonIsRefused) {
  EXPECT_THROW(sim::triangulate({{{0, 0}, {1, 1}}}), std::invalid_argument);
  EXPECT_THROW(sim::triangulate({{{0, 0}, {1, 0}, {2, 0}}}), std::invalid_argument);
}

TEST(MeshBuilder, shapesHaveTheAreaAndVolumeOfTheirFormulas) {
  const auto shape = [](const std::function<void(MeshBuilder&, int)>& add) {
    MeshBuilder builder("thing");
    add(builder, builder.addSurface("", sim::SurfaceKind::object, {}));
    return builder.build();
  };
  const auto box = shape([](MeshBuilder& b, int s) { b.addBox(s, {-1, 0, 1}, {1, 3, 2}); });
  EXPECT_DOUBLE_EQ(areaOf(box), 2 * (2 * 3 + 2 * 1 + 3 * 1));
  EXPECT_NEAR(volumeOf(box), 6, 1e-12);
  const auto prism = shape([](MeshBuilder& b, int s) { b.addPrism(s, {{0, 0}, {3, 0}, {0, 4}}, 1, 3); });
  EXPECT_NEAR(areaOf(prism), 2 * 6 + 12 * 2, 1e-12);
  EXPECT_NEAR(volumeOf(prism), 12, 1e-12);
  // A cylinder of 4 sides is a square prism of diagonal 2 r.
  const auto cylinder = shape([](MeshBuilder& b, int s) { b.addCylinder(s, 1, 0, 2, 4); });
  EXPECT_NEAR(volumeOf(cylinder), 4, 1e-12);
  EXPECT_NEAR(areaOf(cylinder), 2 * 2 + 4 * std::sqrt(2.0) * 2, 1e-12);
  const auto cone = shape([](MeshBuilder& b, int s) { b.addCone(s, 1, 0, 3, 4); });
  EXPECT_NEAR(volumeOf(cone), 2, 1e-12);
  const auto sphere = shape([](MeshBuilder& b, int s) { b.addSphere(s, 2, 96); });
  EXPECT_NEAR(volumeOf(sphere), 4.0 / 3 * M_PI * 8, 0.1);
  EXPECT_NEAR(areaOf(sphere), 4 * M_PI * 4, 0.1);
}

TEST(MeshBuilder, aPlaneReportsItsTruthInTheBody) {
  MeshBuilder builder("wall");
  builder.at({Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ())), {5, 0, 0}});
  // In the part a wall of 4 x 3 m is along x and faces -y; in the body it is along y at x = 5 and faces +x.
  builder.addPlane("face", sim::SurfaceKind::wall, {}, {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}},
                   {{{1, 0, 1}, {2, 0, 1}, {2, 0, 2}, {1, 0, 2}}});
  const sim::Body body = builder.build();
  ASSERT_EQ(body.surfaces.size(), 1u);
  EXPECT_EQ(body.surfaces[0].name, "wall/face");
  const sim::PlanarFace& face = *body.surfaces[0].face;
  EXPECT_TRUE(face.plane_in_body.normal.isApprox(Vector3d::UnitX()));
  EXPECT_NEAR(face.plane_in_body.distance, -5, 1e-12);
  EXPECT_NEAR(sim::areaOf(face), 11, 1e-12);
  EXPECT_NEAR(areaOf(body), 11, 1e-12);
  for (const Vector3d& p : body.vertices_in_body)
    EXPECT_NEAR(geometry::signedDistance(face.plane_in_body, p), 0, 1e-12);
}

TEST(MeshBuilder, texturesLieUprightForWhoLooks) {
  // The face looks to -x; -y is to the right of somebody who looks along +x.
  const std::vector<Vector3d> outline{{0, 2, 0}, {0, 0, 0}, {0, 0, 1}, {0, 2, 1}};
  MeshBuilder builder("sign");
  builder.layout(sim::TextureLayout::fitted()).addPlane("", sim::SurfaceKind::sign, {}, outline);
  builder.layout({{0.5, 0.25}}).addPlane("tiled", sim::SurfaceKind::sign, {}, outline);
  const sim::Body body = builder.build();
  ASSERT_EQ(body.triangles.size(), 4u);
  for (const auto& triangle : body.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vector3d& p = body.vertices_in_body[triangle.corners[i]];
      const Vector2d share((2 - p.y()) / 2, p.z());
      const Vector2d expected = triangle.surface == 0 ? share : Vector2d(share.x() * 4, share.y() * 4);
      EXPECT_NEAR((triangle.texture_at[i].cast<double>() - expected).norm(), 0, 1e-6);
    }
  }
}

}  // namespace
}  // namespace mesh_builder_test
