#include <gtest/gtest.h>
#include <omnimapper/surfaces/Classification.h>

namespace omnimapper::surfaces::surface_context_test {

namespace {

using Class = SurfaceClass;
using Eigen::Vector3d;

Surface quad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  Surface surface;
  surface.plane = geometry::Plane3::through(a, (b - a).cross(c - b).normalized());
  surface.parts.push_back({{a, b, c, d}, {}});
  return surface;
}

/// Upright, from x = `from` to `to`, seen from lower y, from z = 0 to `top`.
Surface front(double from, double to, double y, double top) {
  return quad({from, y, 0}, {to, y, 0}, {to, y, top}, {from, y, top});
}
/// The same seen from higher y.
Surface back(double from, double to, double y, double top) {
  return quad({to, y, 0}, {from, y, 0}, {from, y, top}, {to, y, top});
}
/// Upright at that x, from y = `from` to `to`, seen from lower x.
Surface side(double x, double from, double to, double top) {
  return quad({x, to, 0}, {x, from, 0}, {x, from, top}, {x, to, top});
}
Surface level(double length, double width, double z, double x = 0, double y = 0) {
  return quad({x, y, z}, {x + length, y, z}, {x + length, y + width, z}, {x, y + width, z});
}

/// The classes of surfaces that are alike known examples of the given classes, so that only their surroundings can
/// change these.
std::vector<Class> judged(const std::vector<Surface>& surfaces, const std::vector<Class>& alike) {
  const auto facts = factsOf(surfaces, 0);
  std::vector<Example> examples;
  for (std::size_t i = 0; i < surfaces.size(); ++i) examples.push_back({alike[i], facts[i]});
  std::vector<Class> classes;
  for (const auto& judgement : classify(surfaces, 0, examples)) classes.push_back(judgement.is);
  return classes;
}

}  // namespace

TEST(SurfaceContext, TwoFacesBackToBackAreALeaf) {
  EXPECT_EQ(judged({front(0, 0.9, 3, 1.9), back(0.5, 0.9, 3.04, 1.3)}, {Class::wall, Class::appliance}),
            (std::vector<Class>{Class::door, Class::door}));
  EXPECT_EQ(judged({front(0, 4, 3, 2), back(0, 4, 3.06, 2)}, {Class::wall, Class::wall}),
            (std::vector<Class>{Class::wall, Class::wall}))
      << "a thin wall is wider than a leaf";
  EXPECT_EQ(judged({front(0, 0.9, 3, 1.9), back(0, 0.9, 3.3, 1.9)}, {Class::cabinet, Class::cabinet}),
            (std::vector<Class>{Class::cabinet, Class::cabinet}))
      << "a cabinet is thicker than a leaf";
}

TEST(SurfaceContext, AFrontWithASideIsNoWall) {
  EXPECT_EQ(judged({front(0, 1.9, 3, 1.9), side(0, 3, 3.6, 1.8)}, {Class::wall, Class::cabinet}).front(),
            Class::cabinet);
  EXPECT_EQ(judged({front(0, 1.9, 3, 1.9), side(0, 3, 5, 1.8)}, {Class::wall, Class::cabinet}).front(), Class::wall)
      << "no furniture is so deep";
  EXPECT_EQ(judged({front(0, 1.9, 3, 1.9), side(0, 3, 3.2, 1.9)}, {Class::wall, Class::door_frame}).front(),
            Class::wall);
}

TEST(SurfaceContext, AWallIsNotNarrow) {
  EXPECT_EQ(judged({front(0, 0.45, 3, 0.9)}, {Class::wall}).front(), Class::surface);
  EXPECT_EQ(judged({front(0, 0.45, 3, 1.9)}, {Class::wall}).front(), Class::wall) << "high as one";
  EXPECT_EQ(judged({front(0, 0.12, 3, 1.5)}, {Class::wall}).front(), Class::door_frame);
  EXPECT_EQ(judged({front(0, 0.45, 3, 0.9), front(0.9, 3, 3, 1.9)}, {Class::wall, Class::wall}).front(), Class::wall)
      << "a part of a longer one";
}

TEST(SurfaceContext, ADeepSeatHasABackOrArms) {
  EXPECT_EQ(judged({level(1.1, 0.6, 0.42)}, {Class::seat}).front(), Class::table);
  EXPECT_EQ(judged({level(1.1, 0.6, 0.42), front(0, 1.1, 0.6, 0.8)}, {Class::seat, Class::seat}).front(), Class::seat);
  EXPECT_EQ(judged({level(0.45, 0.45, 0.45)}, {Class::seat}).front(), Class::seat) << "a stool";
}

TEST(SurfaceContext, TheReasonNamesIt) {
  const auto surfaces = std::vector<Surface>{front(0, 0.45, 3, 0.9)};
  const auto judgement = classify(surfaces, 0, {{Class::wall, factsOf(surfaces, 0).front()}}).front();
  EXPECT_NE(judgement.reason.find("too narrow for a wall"), std::string::npos) << judgement.reason;
}

}  // namespace omnimapper::surfaces::surface_context_test
