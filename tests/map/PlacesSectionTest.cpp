#include <gtest/gtest.h>
#include <omnimapper/base/Bytes.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/Places.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

namespace omnimapper::map::places_section_test {
namespace {

MapSection toSection(const Places& places) {
  return layerToSection(Places::kLayer, LayerOf<Places>(places));
}

Places somePlaces() {
  Place sign;
  sign.id = {2, 7};
  sign.kind = "sign";
  sign.label = "sign 7";
  sign.caption = std::string("2\0\xff", 3);
  sign.moved = true;
  sign.properties = {{"number", "213"},
                     {"looks", std::uint64_t{7}},
                     {"area", Measure{0.125, "m2"}},
                     {"repeated_elsewhere", true},
                     {"first_place_last_seen", base::stampFromUnix(1.15e9)}};
  sign.position = {1, -2, 0.5};
  sign.extent.points = {{1, -2}};
  sign.extent.lines = {{{0, 1}, {2, 3}}};
  sign.extent.outlines = {{{0, 0}, {1, 0}, {0, 1}}, {}};
  sign.extent.holes = {{{0.1, 0.1}}};
  sign.extent.bottom = -1;
  sign.extent.top = 2;
  sign.normal = Eigen::Vector3d(0, 0.6, 0.8);
  sign.seen_from = Eigen::Vector3d(1, 0, 0);
  sign.measurements = 41;
  sign.seen_by = {{"", 1}, {"camera", 40}};
  sign.first_seen = base::stampFromUnix(1.1e9);
  sign.last_seen = base::stampFromUnix(1.2e9 + 1e-7);
  sign.sigma = 0.04;
  sign.sigma_is_along_normal = true;
  Places places;
  places.places = {sign, Place()};
  places.last_pose = LastPose{1, 2, 3, base::stampFromUnix(1.3e9), 4};
  return places;
}

std::string refusal(const std::string& bytes) {
  try {
    Places::fromSection({Places::kLayer, Places::kLayerVersion, bytes});
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    return error.what();
  }
  return {};
}

TEST(PlacesSection, KeepsEveryField) {
  const Places before = somePlaces(), after = Places::fromSection(toSection(before));
  ASSERT_EQ(after.places.size(), 2U);
  const Place &a = before.places[0], &b = after.places[0];
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.caption, b.caption);
  EXPECT_EQ(a.moved, b.moved);
  ASSERT_EQ(a.properties.size(), b.properties.size());
  for (std::size_t i = 0; i < a.properties.size(); ++i) {
    EXPECT_EQ(keyOf(a.properties[i]), keyOf(b.properties[i]));
    EXPECT_EQ(textOf(a.properties[i]), textOf(b.properties[i]));
    EXPECT_EQ(a.properties[i].value.index(), b.properties[i].value.index());
  }
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.extent.points, b.extent.points);
  EXPECT_EQ(a.extent.lines, b.extent.lines);
  EXPECT_EQ(a.extent.outlines, b.extent.outlines);
  EXPECT_EQ(a.extent.holes, b.extent.holes);
  EXPECT_EQ(a.extent.bottom, b.extent.bottom);
  EXPECT_EQ(a.extent.top, b.extent.top);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.seen_from, b.seen_from);
  EXPECT_EQ(a.measurements, b.measurements);
  EXPECT_EQ(a.seen_by, b.seen_by);
  EXPECT_EQ(a.first_seen, b.first_seen);
  EXPECT_EQ(a.last_seen, b.last_seen);
  EXPECT_EQ(a.sigma, b.sigma);
  EXPECT_EQ(a.sigma_is_along_normal, b.sigma_is_along_normal);
  EXPECT_FALSE(after.places[1].sigma || after.places[1].normal || after.places[1].moved);
  EXPECT_EQ(after.last_pose->yaw, 3);
  EXPECT_EQ(after.last_pose->session, 4);
  EXPECT_EQ(after.last_pose->stamp, before.last_pose->stamp);
  EXPECT_EQ(toSection(after).bytes, toSection(before).bytes);
  EXPECT_FALSE(Places::fromSection(toSection(Places{})).last_pose);
}

// Version 1 kept properties as texts, and the names of measures, counts and times ended in what they were.
TEST(PlacesSection, PropertiesOfVersionOneGetTheirKinds) {
  Places places;
  places.places.emplace_back();
  std::string bytes = toSection(places).bytes;
  base::ByteWriter old;
  const std::vector<std::pair<std::string, std::string>> texts{{"number", "213"},
                                                               {"words", "a, b"},
                                                               {"area_m2", "8.000"},
                                                               {"repeated_elsewhere", "yes"},
                                                               {"place_2_measurements", "1e300"},
                                                               {"place_2_last_seen", "1e15"},
                                                               {"place_1_last_seen", "5"},
                                                               {"count_of_seen", ""},
                                                               {"place_1_measurements", "12"}};
  old.uint(texts.size(), 4);
  for (const auto& [name, text] : texts) {
    old.block(name);
    old.block(text);
  }
  constexpr std::size_t kBefore = 4 + 6 + 3 * 8;  // number of places, id, three empty texts
  bytes.replace(kBefore, 4, old.bytes());
  const auto read = Places::fromSection({Places::kLayer, 1, bytes}).places.at(0).properties;
  ASSERT_EQ(read.size(), texts.size());
  EXPECT_EQ(std::get<std::string>(read[0].value), "213") << "a number of a door is a name";
  EXPECT_EQ(std::get<std::string>(read[1].value), "a, b");
  EXPECT_EQ(read[2].name, "area");
  EXPECT_EQ(std::get<Measure>(read[2].value).value, 8);
  EXPECT_EQ(keyOf(read[2]), "area_m2");
  EXPECT_TRUE(std::get<bool>(read[3].value));
  EXPECT_EQ(std::get<base::Stamp>(read[6].value), base::stampFromUnix(5));
  EXPECT_EQ(std::get<std::string>(read[4].value), "1e300") << "no count";
  EXPECT_EQ(std::get<std::string>(read[5].value), "1e15") << "no time";
  EXPECT_EQ(std::get<std::string>(read[7].value), "");
  EXPECT_EQ(std::get<std::uint64_t>(read[8].value), 12u);
}

TEST(PlacesSection, AnyCutIsNoticedAndNoByteDoesHarm) {
  const std::string bytes = toSection(somePlaces()).bytes;
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_NE(refusal(bytes.substr(0, length)), "") << length;
  EXPECT_NE(refusal(bytes + "x").find("goes on"), std::string::npos);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const char value : {'\0', '\x7f', '\xff'}) {
      std::string damaged = bytes;
      damaged[i] = value;
      refusal(damaged);
    }
  }
}

TEST(PlacesSection, NumbersThatAreNoneAreRefused) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    Places places = somePlaces();
    places.places[0].extent.lines[0].second.x() = bad;
    EXPECT_NE(refusal(toSection(places).bytes).find("not finite"), std::string::npos);
    places = somePlaces();
    places.last_pose->x = bad;
    EXPECT_NE(refusal(toSection(places).bytes), "");
  }
  Places places = somePlaces();
  places.places[0].normal = Eigen::Vector3d(0, 0, 0);
  EXPECT_NE(refusal(toSection(places).bytes).find("direction"), std::string::npos);
  places = somePlaces();
  places.places[0].sigma = -1;
  EXPECT_NE(refusal(toSection(places).bytes).find("below zero"), std::string::npos);
}

// Damage in a section that is not read goes unnoticed; in the section that is read, and in the bytes that lead to it,
// it is noticed.
TEST(PlacesSection, IsReadWithoutTheOthers) {
  testing::ScratchFolder folder;
  const std::string path = folder / "map.omnimap";
  MapFile file;
  file.set({"frames", 1, std::string(1000, 'f')});
  file.set(toSection(somePlaces()));
  file.set({"graph", 1, "ggg"});
  file.write(path);
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto read = [&](const std::string& content) -> std::string {
    std::ofstream(path, std::ios::binary) << content;
    try {
      const auto part = MapFile::readOnly(path, {Places::kLayer, "absent"});
      return part.sections().size() == 1 && part.find(Places::kLayer) ? "read" : "missed";
    } catch (const base::Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(read(bytes), "read");
  std::string damaged = bytes;
  damaged[bytes.find("fff") + 10] = 'x';
  EXPECT_EQ(read(damaged), "read");
  EXPECT_THROW(MapFile::read(path), base::Error);
  damaged = bytes;
  damaged[bytes.find("213")] = 'x';
  EXPECT_NE(read(damaged).find("section \"places\": its checksum"), std::string::npos);
  EXPECT_NE(read(bytes.substr(0, bytes.size() - 1)).find("section \"graph\": truncated"), std::string::npos);
  EXPECT_NE(read(bytes + "x").find("goes on"), std::string::npos);
}

}  // namespace
}  // namespace omnimapper::map::places_section_test
