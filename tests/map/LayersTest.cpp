#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/testing/Fixtures.h>

namespace omnimapper::map::layers_test {
namespace {

// A layer of a plugin of one's own: which landmarks are in which room.
struct Rooms {
  static constexpr char kLayer[] = "rooms";
  static constexpr std::uint32_t kLayerVersion = 2;

  std::string names;
  base::LandmarkId door;

  std::string toBytes() const { return names; }
  static Rooms fromSection(const MapSection& section) {
    if (section.version > kLayerVersion) throw base::Error(base::ExitCode::unreadable_input, "a later version");
    return {section.bytes, {0, 3}};
  }
  LayerReferences references() const { return {{}, {door}, {}}; }
};

TEST(Layers, areFoundByTypeAndName) {
  Layers layers;
  EXPECT_FALSE(layers.find<Rooms>());
  layers.set(Rooms{"kitchen", {0, 3}});
  layers.set(Rooms{"atrium", {0, 4}}, "rooms of the floor above");
  ASSERT_TRUE(layers.find<Rooms>());
  EXPECT_EQ(layers.find<Rooms>()->names, "kitchen");
  EXPECT_EQ(layers.find<Rooms>("rooms of the floor above")->names, "atrium");
  EXPECT_FALSE(layers.find<Level>("rooms")) << "it is of another type";
  EXPECT_EQ(layers.find("rooms")->references().landmarks, std::vector<base::LandmarkId>({{0, 3}}));
  layers.set(Rooms{"office", {0, 3}});
  EXPECT_EQ(layers.find<Rooms>()->names, "office");
  layers.remove("rooms");
  layers.remove("rooms");
  EXPECT_FALSE(layers.find<Rooms>());
  EXPECT_EQ(layers.size(), 1u);
}

TEST(Layers, ofACopyStayWhenTheOriginalChanges) {
  Map map;
  map.layers.set(Rooms{"kitchen", {}});
  const Map copy = map;
  EXPECT_EQ(copy.layers.find<Rooms>(), map.layers.find<Rooms>()) << "copies share the data";
  map.layers.set(Rooms{"office", {}});
  EXPECT_EQ(copy.layers.find<Rooms>()->names, "kitchen");
}

TEST(Layers, haveNamesThatOtherSectionsOfAMapFileDoNotHave) {
  for (const std::string& name : {std::string(), std::string(257, 'a'), std::string("graph"), std::string("frames"),
                                  std::string("landmarks"), std::string("sessions")}) {
    EXPECT_FALSE(isLayerName(name)) << name;
    EXPECT_THROW(Layers().set(Rooms{}, name), base::Error) << name;
    EXPECT_THROW(LayerRegistry().add<Rooms>(name), base::Error) << name;
  }
  EXPECT_TRUE(isLayerName("plugin graph"));
}

TEST(LayerRegistry, readsWhatItKnowsAndKeepsTheRest) {
  LayerRegistry registry;
  registry.add<Rooms>();
  EXPECT_THROW(registry.add<Rooms>(), base::Error) << "registered twice";
  Layers layers;
  layers.set("rooms", registry.read({"rooms", 1, "kitchen"}));
  layers.set("of the future", registry.read({"of the future", 7, std::string("\0x", 2)}));
  EXPECT_EQ(layers.find<Rooms>()->names, "kitchen");
  const auto kept = layerToSection("of the future", *layers.find("of the future"));
  EXPECT_EQ(kept.version, 7u);
  EXPECT_EQ(kept.bytes, std::string("\0x", 2));
  EXPECT_EQ(layerToSection("rooms", *layers.find("rooms")).version, 2u) << "written in the newest version";
  EXPECT_THROW(registry.read({"rooms", 3, ""}), base::Error);
}

}  // namespace
}  // namespace omnimapper::map::layers_test
