#include <omnimapper/map/LabelledPlaces.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/editRooms.h>

#include <thread>

#include "MapWithFrames.h"
#include "omnimapper/query/editLabels.h"

namespace omnimapper::query::edit_labels_test {
namespace {

using Words = std::vector<std::string>;

class EditLabels : public MapWithFrames {
 protected:
  EditLabels() { write(); }
  std::string edit(const Words& words) {
    return editLabels(folder_.path(), {words, "anna", base::stampFromUnix(1'700'000'500)}, history_);
  }
  std::string refusal(const Words& words) {
    const std::string before = bytes();
    const std::string said = refusalOf([&] { edit(words); }, base::ExitCode::command_line);
    EXPECT_FALSE(said.empty()) << words.front();
    EXPECT_EQ(bytes(), before) << "nothing changes";
    return said;
  }
  std::string bytes() const {
    std::ifstream in(map_.file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  map::Labels labels() const {
    const auto file = map::MapFile::read(map_.file);
    const auto* section = file.find(map::Labels::kLayer);
    return section ? map::Labels::fromSection(*section) : map::Labels();
  }
  map::Places places() const { return openMap(map_.file).places; }
  std::string found(const std::string& text) const {
    const auto all = places();
    const auto found = find(all.places, text);
    return found.places.empty() ? "" : toString(found.places.front().place->id);
  }

  map::LabelEdits history_;
};

TEST_F(EditLabels, AThingIsFoundByItsNewNameAndNothingElseChanges) {
  const auto before = map::MapFile::read(map_.file);
  EXPECT_EQ(edit({"name", "0:2", "Anna's bed"}), "it is called 'Anna's bed' now");
  EXPECT_EQ(found("Anna's bed"), "0:2");
  const auto after = map::MapFile::read(map_.file);
  for (const char* section : {"frames", "landmarks", building::kRoomsLayer})
    EXPECT_EQ(after.find(section)->bytes, before.find(section)->bytes) << section;
  const auto label = labels().labels.at(0);
  EXPECT_EQ(label.text, "Anna's bed");
  EXPECT_EQ(label.landmark, (base::LandmarkId{0, 2}));
  EXPECT_EQ(label.who, "anna");
  EXPECT_EQ(label.when, base::stampFromUnix(1'700'000'500));
  // The bed is at (7, 1, 0.5): 1 m to the right of key frame 0:1, which looks along y.
  EXPECT_EQ(label.frame, (base::KeyFrameId{0, 1}));
  EXPECT_TRUE(label.in_frame.isApprox(Eigen::Vector3d(0, -1, 0.5), 1e-9)) << label.in_frame.transpose();
}

TEST_F(EditLabels, ASpotOfTheFloorGetsAName) {
  edit({"name", "6.5", "2", "charger"});
  const auto label = labels().labels.at(0);
  EXPECT_FALSE(label.landmark);
  EXPECT_EQ(label.frame, (base::KeyFrameId{0, 1}));
  EXPECT_TRUE(label.in_frame.isApprox(Eigen::Vector3d(1, -0.5, 0), 1e-9)) << label.in_frame.transpose();
  const auto place = places().places.back();
  EXPECT_EQ(place.kind, map::Labels::kPlace);
  EXPECT_TRUE(place.position.isApprox(Eigen::Vector3d(6.5, 2, 0), 1e-9));
  EXPECT_EQ(found("charger"), toString(place.id));
}

TEST_F(EditLabels, ANameOfAFaceIsThatOfItsThing) {
  edit({"name", "0:9", "kitchen table"});
  EXPECT_EQ(found("kitchen table"), "0:3");
}

TEST_F(EditLabels, ALabelFollowsALandmarkThatWasMerged) {
  map::Labels earlier;
  map::Label label;
  label.text = "worktop";
  label.landmark = base::LandmarkId{0, 6};
  earlier.labels = {label};
  auto file = map::MapFile::read(map_.file);
  file.set(map::layerToSection(map::Labels::kLayer, map::LayerOf<map::Labels>(earlier)));
  file.write(map_.file);
  edit({"name", "0:2", "bed"});
  EXPECT_EQ(found("worktop"), "0:1");
}

TEST_F(EditLabels, SeveralThingsOfOneNameAreARegion) {
  edit({"name", "0:4", "corner"});
  edit({"name", "0:3", "corner"});
  const auto region = places().places.back();
  EXPECT_EQ(region.kind, map::Labels::kRegion);
  EXPECT_EQ(region.label, "corner");
  EXPECT_EQ(places().places.size(), map_.places.places.size() + 1);
  EXPECT_NE(refusal({"name", toString(region.id), "x"}).find("'corner' is a name already"), std::string::npos);
  edit({"delete", "corner"});
  EXPECT_EQ(places().places.size(), map_.places.places.size());
}

TEST_F(EditLabels, UndoGivesBackTheMapOfBeforeByteForByte) {
  std::vector<std::string> states{bytes()};
  for (const auto& words : {Words{"name", "0:2", "bed 1"}, Words{"name", "1", "1", "door mat"},
                            Words{"rename", "bed 1", "Anna's bed"}, Words{"delete", "Anna's bed"}}) {
    edit(words);
    states.push_back(bytes());
  }
  EXPECT_EQ(found("Anna's bed"), "");
  for (std::size_t i = states.size() - 1; i > 0; --i) {
    edit({"undo"});
    EXPECT_EQ(bytes(), states[i - 1]) << i;
  }
  EXPECT_NE(refusal({"undo"}).find("nothing to undo"), std::string::npos);
}

TEST_F(EditLabels, WhatSomebodyElseChangedSinceIsNotUndone) {
  edit({"name", "0:2", "bed 1"});
  map::LabelEdits of_another;
  editLabels(map_.file, {{"name", "0:1", "worktop"}, "ben", {}}, of_another);
  EXPECT_NE(refusal({"undo"}).find("nothing to undo"), std::string::npos);
  EXPECT_EQ(labels().labels.size(), 2U);
}

TEST_F(EditLabels, WhatIsNoChangeIsRefusedWithAReason) {
  edit({"name", "0:2", "bed 1"});
  const std::vector<std::pair<Words, std::string>> refused{{{"name", "0:2", "bed 1"}, "already"},
                                                           {{"name", "0:77", "x"}, "number '0:77'"},
                                                           {{"name", "0:2", " "}, "is empty"},
                                                           {{"name", "0:2", "a\nb"}, "control characters"},
                                                           {{"name", "1", "far", "x"}, "coordinate"},
                                                           {{"name", "1", "nan", "x"}, "coordinate"},
                                                           {{"rename", "none", "x"}, "no label"},
                                                           {{"rename", "bed 1", ""}, "is empty"},
                                                           {{"delete", "none"}, "no label"},
                                                           {{"burn"}, "is one of"},
                                                           {{"name"}, "is one of"}};
  for (const auto& [words, reason] : refused) {
    const std::string said = refusal(words);
    EXPECT_NE(said.find(reason), std::string::npos) << said;
  }
}

TEST_F(EditLabels, NoChangeOfSeveralAtOnceIsLost) {
  constexpr int kChanges = 10;
  building::Building building;
  building.storeys = {*map_.rooms};
  putFile(folder_ / "rooms.json", building::encodeRooms(building));
  const auto give = [&](const std::string& who) {
    map::LabelEdits history;
    for (int i = 0; i < kChanges; ++i)
      editLabels(folder_.path(), {{"name", "1", "1", who + std::to_string(i)}, who, {}}, history);
  };
  std::thread anna([&] { give("anna"); });
  std::thread ben([&] { give("ben"); });
  for (int i = 0; i < kChanges; ++i) editRooms(folder_.path(), {"rename", "room 1", "room of " + std::to_string(i)});
  anna.join();
  ben.join();
  EXPECT_EQ(labels().labels.size(), 2U * kChanges);
  EXPECT_EQ(openMap(map_.file).rooms->rooms.front().name, "room of 9");
}

TEST_F(EditLabels, AMapThatIsStillMadeIsNotChanged) {
  std::filesystem::rename(map_.file, folder_ / "checkpoint.omnimap");
  EXPECT_NE(refusalOf(
                [&] {
                  edit({"name", "0:2", "x"});
                },
                base::ExitCode::unreadable_input)
                .find("has not ended"),
            std::string::npos);
}

}  // namespace
}  // namespace omnimapper::query::edit_labels_test
