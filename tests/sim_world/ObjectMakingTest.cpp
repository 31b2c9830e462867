#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/ObjectMaking.h>

#include <array>
#include <map>

namespace object_making_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;

using Place = std::array<double, 3>;
Place placeOf(const Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

// Number of triangles along each directed edge, by the places of its ends. In a closed body the numbers of both
// directions are equal.
std::map<std::pair<Place, Place>, int> edgesOf(const sim::Body& body) {
  std::map<std::pair<Place, Place>, int> edges;
  for (const auto& triangle : body.triangles) {
    for (int i = 0; i < 3; ++i) {
      ++edges[{placeOf(body.vertices_in_body[triangle.corners[i]]),
               placeOf(body.vertices_in_body[triangle.corners[(i + 1) % 3]])}];
    }
  }
  return edges;
}

double volumeOf(const sim::Body& body) {
  double volume = 0;
  for (const auto& t : body.triangles) {
    const auto& v = body.vertices_in_body;
    volume += v[t.corners[0]].dot(v[t.corners[1]].cross(v[t.corners[2]])) / 6;
  }
  return volume;
}

sim::ObjectSpec spec(const std::string& shape, std::uint64_t seed) {
  sim::ObjectSpec spec;
  spec.name = "thing";
  spec.shape = shape;
  spec.seed = seed;
  return spec;
}

TEST(ObjectMaking, everyShapeIsClosedWithItsOutsideOut) {
  EXPECT_GE(sim::objectShapes().size(), 10u);
  for (const std::string& shape : sim::objectShapes()) {
    const sim::Body body = sim::makeObject(spec(shape, 1)).body;
    const auto edges = edgesOf(body);
    int open = 0;
    for (const auto& [edge, count] : edges) {
      const auto back = edges.find({edge.second, edge.first});
      open += back == edges.end() || back->second != count;
    }
    EXPECT_EQ(open, 0) << shape;
    const Vector3d size = sim::extentsOf(body);
    EXPECT_GT(volumeOf(body), 0.03 * size.prod()) << shape;
  }
}

TEST(ObjectMaking, everyShapeStandsOnItsBaseAboveItsOrigin) {
  for (const std::string& shape : sim::objectShapes()) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const sim::Body body = sim::makeObject(spec(shape, seed)).body;
      Vector3d low = body.vertices_in_body[0], high = low;
      for (const Vector3d& p : body.vertices_in_body) low = low.cwiseMin(p), high = high.cwiseMax(p);
      EXPECT_DOUBLE_EQ(low.z(), 0) << shape;
      EXPECT_LT(low.x(), -0.3 * (high.x() - low.x())) << shape;
      EXPECT_GT(high.y(), 0.3 * (high.y() - low.y())) << shape;
    }
  }
}

TEST(ObjectMaking, aSizeIsKeptAndWithoutOneTheSeedVariesIt) {
  for (const std::string& shape : sim::objectShapes()) {
    auto wanted = spec(shape, 1);
    const Vector3d one = sim::extentsOf(sim::makeObject(wanted).body);
    wanted.seed = 2;
    const Vector3d two = sim::extentsOf(sim::makeObject(wanted).body);
    EXPECT_FALSE(one.isApprox(two, 1e-3)) << shape;
    EXPECT_LT((one - two).norm(), 0.45 * one.norm()) << shape;
    wanted.size = Vector3d(0.2, 0.1, 0.3);
    EXPECT_TRUE(sim::extentsOf(sim::makeObject(wanted).body).isApprox(Vector3d(0.2, 0.1, 0.3), 1e-12)) << shape;
  }
}

TEST(ObjectMaking, sameSpecSameBody) {
  for (const std::string& shape : sim::objectShapes()) {
    const auto a = sim::makeObject(spec(shape, 9)), b = sim::makeObject(spec(shape, 9));
    EXPECT_EQ(a.body.vertices_in_body, b.body.vertices_in_body) << shape;
    for (std::size_t i = 0; i < a.body.surfaces.size(); ++i) {
      const auto &one = a.body.surfaces[i].material, &two = b.body.surfaces[i].material;
      EXPECT_EQ(one.colour, two.colour);
      ASSERT_EQ(one.texture != nullptr, two.texture != nullptr);
      if (one.texture) {
        EXPECT_EQ(one.texture->rgb, two.texture->rgb);
      }
    }
    EXPECT_EQ(a.object.name, "thing");
    EXPECT_EQ(a.body.surfaces[0].name, "thing");
  }
}

TEST(ObjectMaking, anUnknownShapeOrSizeIsRefusedWithTheKnownOnes) {
  try {
    sim::makeObject(spec("cupp", 1));
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    for (const char* word : {"'cup'", "bottle", "laptop"}) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word;
    }
  }
  auto flat = spec("box", 1);
  flat.size = Vector3d(0.1, 0, 0.1);
  EXPECT_THROW(sim::makeObject(flat), base::Error);
}

}  // namespace
}  // namespace object_making_test
