#include <gtest/gtest.h>
#include <omnimapper/query/Find.h>

#include "HandMadeMap.h"

namespace omnimapper::query::find_test {
namespace {

const map::Places kPlaces =
    placesOf({signAt(0, 0, "213", "Printer, Ella Stone"), signAt(4, 0, "214", "Kitchen"), signAt(8, 0, "WOMEN"),
              signAt(9, 0, "WOMEN"), signAt(12, 0, "women"), wallFrom(0, 0, 5, 0)});

std::vector<std::uint32_t> idsOf(const Found& found) {
  std::vector<std::uint32_t> ids;
  for (const auto& each : found.places) ids.push_back(each.place->id.index);
  return ids;
}

TEST(Find, CaptionsLabelsAndWordsOfPropertiesAreNames) {
  EXPECT_EQ(idsOf(find(kPlaces.places, "213")), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(idsOf(find(kPlaces.places, "wall")), (std::vector<std::uint32_t>{5}));
  EXPECT_EQ(idsOf(find(kPlaces.places, "Ella Stone")), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(find(kPlaces.places, "kitchen").places.front().match.grade, MatchGrade::same_letters);
}

TEST(Find, AllThatIsCalledSoIsFoundTheExactFirst) {
  const Found found = find(kPlaces.places, "WOMEN");
  EXPECT_EQ(idsOf(found), (std::vector<std::uint32_t>{2, 3, 4}));
  EXPECT_EQ(found.places[2].match.grade, MatchGrade::same_letters);
  EXPECT_FALSE(found.isOnlyNear());
}

TEST(Find, WhatIsOnlyNearIsFoundWhereNothingFits) {
  const Found found = find(kPlaces.places, "kithcen");
  EXPECT_TRUE(found.isOnlyNear());
  EXPECT_EQ(idsOf(found), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(found.places.front().match.name, "Kitchen");
}

TEST(Find, WhereNothingIsNearTheClosestNamesAreSuggested) {
  const Found found = find(kPlaces.places, "215");
  EXPECT_TRUE(found.places.empty());
  ASSERT_EQ(found.closest.size(), 2U) << "what is far-fetched is not named";
  EXPECT_EQ(found.closest[0], "214");
  EXPECT_EQ(found.closest[1], "213");
  EXPECT_EQ(find(kPlaces.places, "220").closest.front(), "214") << "the number beside it";
  EXPECT_TRUE(find(kPlaces.places, "999").closest.empty());
  EXPECT_TRUE(find({}, "x").closest.empty());
}

TEST(Find, TheFacesOfAThingAreFoundByTheirIdsAlone) {
  auto places = kPlaces;
  places.places[5].properties = {{map::kParts, std::string("0:5, 0:12")}};
  EXPECT_EQ(idsOf(find(places.places, "0:12")), (std::vector<std::uint32_t>{5}));
  EXPECT_TRUE(find(places.places, "12").places.empty());
}

TEST(Find, MeasuresAreNoNames) {
  map::Place wall = wallFrom(0, 0, 5, 0);
  wall.properties = {{"length", map::Measure{5, "m"}}, {"repeated_elsewhere", true}, {"number", "12"}};
  EXPECT_EQ(namesOf(wall), (std::vector<std::string>{"wall", "12"}));
}

TEST(Find, WhatNobodyCanAskIsRefusedShortly) {
  const auto refusal = [](const std::string& text) {
    return refusalOf([&] { find(kPlaces.places, text); }, base::ExitCode::command_line);
  };
  EXPECT_NE(refusal("").find("empty"), std::string::npos);
  EXPECT_NE(refusal(" \t ").find("empty"), std::string::npos);
  const std::string of_huge = refusal(std::string(1'000'000, 'a'));
  EXPECT_NE(of_huge.find("1000000 bytes"), std::string::npos);
  EXPECT_LT(of_huge.size(), 200U);
  EXPECT_NE(refusal("a\x1b[2Jb").find("\\x1b"), std::string::npos);
  EXPECT_NE(refusal("\xff\xfe").find("UTF-8"), std::string::npos);
  EXPECT_NE(refusal(std::string("a\0b", 3)).find("\\x00"), std::string::npos);
}

TEST(Find, NamesThatAreLongOrNoTextDoNoHarm) {
  std::string many;
  for (int i = 0; i < 100'000; ++i) many += "word ";
  const auto places = placesOf({signAt(0, 0, many), signAt(1, 0, "\xff\xc3"), signAt(2, 0, std::string(1 << 20, 'x'))});
  EXPECT_EQ(idsOf(find(places.places, "word")), (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(find(places.places, "213").places.empty());
}

}  // namespace
}  // namespace omnimapper::query::find_test
