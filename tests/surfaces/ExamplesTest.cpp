#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/surfaces/Classification.h>

#include <set>

namespace omnimapper::surfaces {

namespace {

std::string errorOf(const std::string& text) {
  try {
    readExamples(text, "some.csv");
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    return error.what();
  }
  return "";
}

// A table top 0.74 m high, which is the only surface of the map.
Surface tableTop() {
  Surface surface;
  surface.plane = {Eigen::Vector3d::UnitZ(), -0.74};
  surface.parts.push_back({{{0, 0, 0.74}, {1.2, 0, 0.74}, {1.2, 0.8, 0.74}, {0, 0.8, 0.74}}, {}});
  return surface;
}

}  // namespace

TEST(Examples, AreReadAsTheyWereWritten) {
  Example example{SurfaceClass::table, factsOf({tableTop()}, 0).front()};
  example.facts.has_front = true;
  const std::string text = toCsv({example, example});
  const auto read = readExamples(text, "some.csv");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].is, SurfaceClass::table);
  EXPECT_EQ(read[1].facts.lie, Lie::up);
  EXPECT_NEAR(read[1].facts.bottom, 0.74, 0.006);
  EXPECT_NEAR(read[1].facts.longer, 1.2, 0.03);
  EXPECT_NEAR(read[1].facts.shorter, 0.8, 0.03);
  EXPECT_TRUE(read[1].facts.has_front);
  EXPECT_FALSE(read[1].facts.is_at_bed);
  EXPECT_EQ(toCsv(read), text);
}

TEST(Examples, WhatIsNotATableOfExamplesIsRefusedByLine) {
  const std::string text = toCsv({{SurfaceClass::table, factsOf({tableTop()}, 0).front()}});
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_NE(errorOf("").find("some.csv, line 1: is not the header"), std::string::npos);
  EXPECT_NE(errorOf(with("table,", "tabel,")).find("line 2: 'tabel' is no class"), std::string::npos);
  EXPECT_NE(errorOf(with(",up,", ",upwards,")).find("'upwards' is not up, down"), std::string::npos);
  EXPECT_NE(errorOf(with("0.74", "high")).find("'high' is not a number"), std::string::npos);
  EXPECT_NE(errorOf(text + "table,up\n").find("line 3: has 2 cells"), std::string::npos);
}

TEST(Examples, TheKnownOnesAreOfAllClassesThatSurfacesHave) {
  std::set<SurfaceClass> classes;
  for (const auto& example : knownExamples()) classes.insert(example.is);
  for (const auto is :
       {SurfaceClass::floor, SurfaceClass::ceiling, SurfaceClass::wall, SurfaceClass::door, SurfaceClass::door_frame,
        SurfaceClass::window, SurfaceClass::table, SurfaceClass::counter, SurfaceClass::shelf, SurfaceClass::cabinet,
        SurfaceClass::seat, SurfaceClass::bed, SurfaceClass::appliance, SurfaceClass::object})
    EXPECT_EQ(classes.count(is), 1U) << toString(is);
}

TEST(Examples, OfNoneNothingIsKnown) {
  const auto judged = classify({tableTop()}, 0, {}).front();
  EXPECT_EQ(judged.is, SurfaceClass::surface);
  EXPECT_NE(judged.reason.find("similar to no known example"), std::string::npos) << judged.reason;
}

TEST(Examples, WhatStandsTogetherIsFoundHoweverTheRoomIsTurned) {
  // A box: front and side meet at a corner, the top ends above them.
  const auto upright = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& normal) {
    Surface surface;
    surface.plane = geometry::Plane3::through(a, normal);
    const Eigen::Vector3d up(0, 0, 0.8);
    surface.parts.push_back({{a, b, b + up, a + up}, {}});
    return surface;
  };
  std::vector<Surface> box{upright({0, 0, 0}, {1, 0, 0}, {0, -1, 0}), upright({1, 0, 0}, {1, 0.5, 0}, {1, 0, 0})};
  Surface& top = box.emplace_back();
  top.plane = {Eigen::Vector3d::UnitZ(), -0.8};
  top.parts.push_back({{{0, 0, 0.8}, {1, 0, 0.8}, {1, 0.5, 0.8}, {0, 0.5, 0.8}}, {}});
  for (const double yaw : {0.0, 0.4, 2.0}) {
    SurfaceSet set;
    set.surfaces = box;
    const geometry::Se3 turned{Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {3, -2, 0}};
    const auto facts = factsOf(moved(set, turned).surfaces, 0);
    EXPECT_TRUE(facts[0].has_outer_corner) << yaw;
    EXPECT_FALSE(facts[0].has_inner_corner) << yaw;
    EXPECT_NEAR(facts[0].top_longer, 1, 0.06) << yaw;
    EXPECT_NEAR(facts[1].top_shorter, 0.5, 0.06) << yaw;
    EXPECT_TRUE(facts[2].has_front) << yaw;
    EXPECT_NEAR(facts[0].longer, 1, 0.06) << yaw;
  }
}

}  // namespace omnimapper::surfaces
