#include <gtest/gtest.h>
#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/WorldIni.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace world_ini_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;

sim::World readText(const std::string& text) {
  return sim::readWorld(base::Config::fromText(text, "w.ini"));
}

// Two rooms of 4 x 3 m with 0.2 m of wall between, and one door, to which cases add.
std::string twoRooms(const std::string& world_keys, const std::string& sections) {
  return "[world]\nrooms = kitchen, hall\ndoors = door\n" + world_keys +
         "\n[kitchen]\nclass = room\nrectangle_m = 0 0 4 3\nkind = kitchen\n[hall]\nclass = room\nrectangle_m = 4.2 0 "
         "8.2 3\n"
         "[door]\nclass = door\nrooms = kitchen hall\nx_m = 4.1\ny_m = 1.5\n" +
         sections;
}

const sim::Surface* find(const sim::World& world, const std::string& name) {
  for (const auto& body : world.bodies) {
    for (const auto& surface : body.surfaces) {
      if (surface.name == name) return &surface;
    }
  }
  return nullptr;
}

TEST(WorldIni, aRoomWithADoorHasTheAreasOfItsWalls) {
  const sim::World world = readText(twoRooms("", ""));
  ASSERT_EQ(world.rooms.size(), 2u);
  std::map<std::string, double> area;
  for (const auto& body : world.bodies) {
    for (const auto& surface : body.surfaces) {
      if (surface.face) area[surface.name] = sim::areaOf(*surface.face);
    }
  }
  EXPECT_NEAR(area["kitchen/floor"], 12, 1e-12);
  EXPECT_NEAR(area["kitchen/ceiling"], 12, 1e-12);
  // Outline 0 0, 4 0, 4 3, 0 3: wall 1 is y = 0, wall 2 is x = 4 with the door of 0.9 x 2.05 m.
  EXPECT_NEAR(area["kitchen/wall_1"], 4 * 2.6, 1e-12);
  EXPECT_NEAR(area["kitchen/wall_2"], 3 * 2.6 - 0.9 * 2.05, 1e-12);
  EXPECT_NEAR(area["hall/wall_4"], 3 * 2.6 - 0.9 * 2.05, 1e-12);
  EXPECT_NEAR(area["door/threshold"], 0.9 * 0.2, 1e-12);
  const auto& wall = find(world, "kitchen/wall_2")->face->plane_in_body;
  EXPECT_TRUE(wall.normal.isApprox(-Vector3d::UnitX()));
  EXPECT_NEAR(wall.distance, 4, 1e-12);
  EXPECT_TRUE(find(world, "kitchen/floor")->face->plane_in_body.normal.isApprox(Vector3d::UnitZ()));
  EXPECT_TRUE(find(world, "kitchen/ceiling")->face->plane_in_body.normal.isApprox(-Vector3d::UnitZ()));
  // The leaf hangs on the left, seen from the kitchen, and is open by 1.6 rad into it: it reaches 0.9 m before the
  // wall.
  const auto leaf =
      std::find_if(world.bodies.begin(), world.bodies.end(), [](const auto& b) { return b.name == "door_leaf"; });
  ASSERT_NE(leaf, world.bodies.end());
  const Vector3d tip = *leaf->track.at(0) * Vector3d(0.9, 0, 0);
  EXPECT_NEAR(tip.x(), 4 - 0.9 * std::sin(1.6), 1e-9);
  EXPECT_NEAR(tip.y(), 1.95 - 0.9 * std::cos(1.6), 1e-9);
}

TEST(WorldIni, whatSectionsNameStandsWhereTheySay) {
  const sim::World world = readText(
      twoRooms("furniture = desk\nobjects = mug\nsigns = sign\nmarkers = tag\nlandmarks = point\nposters = print",
               "[desk]\nclass = table\nx_m = 1.5\ny_m = 2.4\nheight_m = 0.7\n"
               "[mug]\nclass = cup\nx_m = 1.2\ny_m = 2.3\non = desk/top\nmoves = 30 2 1 90 | 60 away\n"
               "[sign]\nclass = dark\nroom = kitchen\ntext = 7 | Kitchen\nx_m = 4.3\ny_m = 0.5\nz_m = 1.4\n"
               "[tag]\nclass = wall\nid = 3\nx_m = 2\ny_m = 0.1\nlandmark = true\n"
               "[point]\nclass = point\nid = 9\nx_m = 1\ny_m = 2\nz_m = 0.5\n"
               "[print]\nclass = poster\nx_m = 0.1\ny_m = 1.5\n"));
  const auto poseOf = [&](const std::string& name, double time) {
    for (const auto& body : world.bodies) {
      if (body.name == name) return body.track.at(time);
    }
    return std::optional<geometry::Se3>();
  };
  EXPECT_TRUE(poseOf("mug", 0)->translation.isApprox(Vector3d(1.2, 2.3, 0.7)));
  EXPECT_TRUE(poseOf("mug", 30)->translation.isApprox(Vector3d(2, 1, 0)));
  EXPECT_FALSE(poseOf("mug", 60));
  // The sign is on the hall's side of the wall, so it faces +x.
  ASSERT_EQ(world.signs.size(), 1u);
  const geometry::Se3 sign = world.signs[0].map_from_sign;
  EXPECT_NEAR(sign.translation.x(), 4.2, 0.01);
  EXPECT_NEAR(sign.translation.y(), 0.5, 1e-9);
  EXPECT_NEAR(sign.translation.z(), 1.4, 1e-9);
  EXPECT_TRUE((sign.rotation * Vector3d::UnitZ()).isApprox(Vector3d::UnitX()));
  EXPECT_EQ(world.signs[0].lines, (std::vector<std::string>{"7", "Kitchen"}));
  ASSERT_EQ(world.point_landmarks.size(), 2u);
  EXPECT_EQ(world.point_landmarks[0].body, "tag");
  EXPECT_EQ(world.point_landmarks[1].id, 9);
}

struct Bad {
  const char* name;
  std::string keys, sections, section, key;
};

TEST(WorldIni, impossibleWorldsAreRefusedWithTheirPlace) {
  const std::string desk = "[desk]\nclass = table\nx_m = 1.5\ny_m = 2.4\n";
  const std::string chest = "[chest]\nclass = cabinet\nx_m = 1.5\ny_m = 2.4\n";
  const std::vector<Bad> cases{
      {"furniture in a wall", "furniture = f", "[f]\nclass = table\nx_m = 0.3\ny_m = 1.5", "f", "x_m"},
      {"furniture in no room", "furniture = f", "[f]\nclass = table\nx_m = 40\ny_m = 1.5", "f", "x_m"},
      {"furniture in furniture", "furniture = desk f", desk + "[f]\nclass = cabinet\nx_m = 1.6\ny_m = 2.4\n", "f",
       "x_m"},
      {"furniture through the ceiling", "furniture = f", "[f]\nclass = rack\nx_m = 1.6\ny_m = 2.4\nheight_m = 3\n", "f",
       "height_m"},
      {"unknown shape", "furniture = f", "[f]\nclass = tabel\nx_m = 1.6\ny_m = 2.4\n", "f", "class"},
      {"unknown object", "objects = o", "[o]\nclass = cupp\nx_m = 1.6\ny_m = 2.4\n", "o", "class"},
      {"unknown material", "furniture = f", "[f]\nclass = table\nx_m = 1.6\ny_m = 2.4\nmaterial = oack\n", "f",
       "material"},
      {"negative size", "furniture = f", "[f]\nclass = table\nx_m = 1.6\ny_m = 2.4\nlength_m = -1\n", "f", "length_m"},
      {"unknown key", "furniture = f", "[f]\nclass = table\nx = 1.6\n", "f", "x_m"},
      {"sign far from any wall", "signs = s", "[s]\nclass = dark\ntext = A\nx_m = 2\ny_m = 1.5\n", "s", "x_m"},
      {"sign over the door", "signs = s", "[s]\nclass = dark\ntext = A\nx_m = 3.9\ny_m = 1.5\n", "s", "x_m"},
      {"sign of no room", "signs = s", "[s]\nclass = dark\nroom = attic\nx_m = 2\ny_m = 0.1\n", "s", "room"},
      {"moves not in order", "objects = o", "[o]\nclass = cup\nx_m = 1\ny_m = 1\nmoves = 20 2 1 0 | 10 2 2 0\n", "o",
       "moves"},
      {"a move into a wall", "objects = o", "[o]\nclass = cup\nx_m = 1\ny_m = 1\nmoves = 20 4.1 2.8 0\n", "o", "moves"},
      {"a move into furniture", "furniture = chest\nobjects = o",
       chest + "[o]\nclass = cup\nx_m = 3\ny_m = 1\nmoves = 10 1.5 2.4 0 chest/top | 20 1.5 2.4 0\n", "o", "moves"},
      {"a move into what stands there then", "objects = a b",
       "[a]\nclass = cup\nx_m = 1\ny_m = 1\nmoves = 10 2 2 0\n[b]\nclass = cup\nx_m = 3\ny_m = 1\nmoves = 20 2 2 0\n",
       "b", "moves"},
      {"a stand in furniture", "furniture = chest\nmarkers = m",
       chest + "[m]\nclass = stand\nid = 1\nx_m = 3\ny_m = 1\nmoves = 10 1.5 2.4 0\n", "m", "moves"},
      {"a landmark in a wall", "landmarks = l", "[l]\nclass = point\nid = 1\nx_m = 4.1\ny_m = 0.5\n", "l", "x_m"},
      {"a landmark in no room", "landmarks = l", "[l]\nclass = point\nid = 1\nx_m = 40\ny_m = 0.5\n", "l", "x_m"},
      {"a landmark above the ceiling", "landmarks = l", "[l]\nclass = point\nid = 1\nx_m = 1\ny_m = 0.5\nz_m = 3\n",
       "l", "z_m"},
      {"an object on nothing", "objects = o", "[o]\nclass = cup\nx_m = 1\ny_m = 1\non = desk/topp\n", "o", "on"},
      {"an object over the rim", "furniture = desk\nobjects = o",
       desk + "[o]\nclass = cup\nx_m = 2.3\ny_m = 2.4\non = desk/top\n", "o", "x_m"},
      {"a section that is not there", "objects = o", "", "world", "lists"},
      {"a person in no room", "people = p", "[p]\nclass = person\npath = 0 2 9 | 9 2 2\n", "p", "path"},
      {"a person who walks through a wall", "people = p", "[p]\nclass = person\npath = 0 2 0.5 | 9 6 0.5\n", "p",
       "path"},
      {"a person who walks through furniture", "furniture = desk\npeople = p",
       desk + "[p]\nclass = person\npath = 0 1.5 1 | 9 1.5 2.9\n", "p", "path"},
      {"a person who stands where something is put later", "objects = o\npeople = p",
       "[o]\nclass = box\nx_m = 1\ny_m = 1\nmoves = 60 2 2 0\n[p]\nclass = person\npath = 0 3 2 | 9 2 2\n", "p",
       "path"},
      {"a person who walks for years", "people = p", "[p]\nclass = person\npath = 0 2 1 | 1e9 3 1\n", "p", "path"},
      {"furniture of a kilometre", "furniture = f", "[f]\nclass = table\nx_m = 1.6\ny_m = 2.4\nheight_m = 1000\n", "f",
       "height_m"},
      {"a sign that no memory holds", "signs = s",
       "[s]\nclass = dark\ntext = A\nx_m = 2\ny_m = 0.1\nwidth_m = 100000\nheight_m = 2\n", "s", "width_m"},
      {"a person who points with a foot", "people = p",
       "[p]\nclass = person\npath = 0 2 1 | 9 2 1\npointing = 2 4 2 3 1 foot\n", "p", "pointing"},
      {"a companion without a known place", "people = p", "[p]\nclass = companion\nplace = besides\n", "p", "place"},
      {"a companion at a negative distance", "people = p", "[p]\nclass = companion\ndistance_m = -1\n", "p",
       "distance_m"},
      {"a companion in the robot", "people = p", "[p]\nclass = companion\nplace = beside\nside_m = 0.2\n", "p",
       "side_m"},
      {"a companion who leaves before it comes", "people = p", "[p]\nclass = companion\nfrom_s = 20\nuntil_s = 10\n",
       "p", "until_s"},
      {"a companion with a path", "people = p", "[p]\nclass = companion\npath = 0 2 1\n", "p", "path"},
      {"an unknown group of companions", "companions = mob", "", "world", "companions"},
      {"a person with the name of a companion", "people = companion_1\ncompanions = guide",
       "[companion_1]\nclass = person\npath = 0 2 1\n", "companion_1", "name"},
      {"a person who points at nothing", "people = p",
       "[p]\nclass = person\npath = 0 2 1 | 9 2 1\npointing = 2 4 vase\n", "p", "pointing"},
  };
  for (const Bad& bad : cases) {
    try {
      readText(twoRooms(bad.keys, bad.sections));
      ADD_FAILURE() << bad.name << " is accepted";
    } catch (const base::Error& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("w.ini"), std::string::npos) << bad.name << ": " << what;
      EXPECT_NE(what.find("[" + bad.section + "]"), std::string::npos) << bad.name << ": " << what;
      EXPECT_NE(what.find(bad.key), std::string::npos) << bad.name << ": " << what;
    }
  }
}

TEST(WorldIni, aPlaceThatIsLeftIsFreeForOthers) {
  const std::string box = "class = box\ny_m = 2\n";
  const sim::World world =
      readText(twoRooms("objects = a b\npeople = p", "[a]\nx_m = 1\nmoves = 10 3 2 0 | 30 away\n" + box +
                                                         "[b]\nx_m = 2\nmoves = 10 1 2 0 | 30 3 2 0\n" + box +
                                                         "[p]\nclass = person\npath = 0 2 1 | 15 2 1 | 18 2 2.6\n"));
  EXPECT_EQ(world.objects.size(), 2u);
}

TEST(WorldIni, whereverSomethingStandsOnTheFloorIsInTheRobotsWay) {
  const std::string empty = twoRooms("", "");
  const auto added = [&](const std::string& keys, const std::string& sections) {
    return readText(twoRooms(keys, sections)).obstacles.size() - readText(empty).obstacles.size();
  };
  EXPECT_EQ(added("objects = o", "[o]\nclass = box\nx_m = 1\ny_m = 1\nmoves = 10 2 2 0 | 20 away | 30 3 2 0\n"), 3u);
  EXPECT_EQ(added("markers = m", "[m]\nclass = stand\nid = 1\nx_m = 1\ny_m = 1\nmoves = 10 2 2 0\n"), 2u);
  EXPECT_EQ(added("markers = m", "[m]\nclass = wall\nid = 1\nx_m = 2\ny_m = 0.1\n"), 0u);
}

TEST(WorldIni, impossibleRoomsAndDoorsAreRefused) {
  const auto expectRefused = [](const std::string& text, const std::string& section, const std::string& key) {
    try {
      readText(text);
      ADD_FAILURE() << text;
    } catch (const base::Error& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("[" + section + "] " + key), std::string::npos) << what;
    }
  };
  const std::string a = "[a]\nrectangle_m = 0 0 4 3\n";
  const std::string room = "class = room\n";
  expectRefused("[world]\nrooms = a b\n" + a + room + "[b]\nclass = room\nrectangle_m = 3.9 0 8 3\n", "b", "outline_m");
  expectRefused("[world]\nrooms = a b\n" + a + room + "[b]\nclass = room\nrectangle_m = 4 0 8 3\n", "a", "outline_m");
  expectRefused("[world]\nrooms = a\n[a]\nclass = room\nrectangle_m = 0 0 0 3\n", "a", "rectangle_m");
  expectRefused("[world]\nrooms = a\n[a]\nclass = room\noutline_m = 0 0 4 3 4 0 0 3\n", "a", "outline_m");
  expectRefused("[world]\nrooms = a\n[a]\nclass = room\noutline_m = 0 0 4 x 4 0\n", "a", "outline_m");
  expectRefused("[world]\nrooms = a\n[a]\nclass = room\nrectangle_m = 0 0 3000 3000\n", "a", "outline_m");
  expectRefused("[world]\nrooms = a b\n" + a + room + "[b]\nclass = outdoors\nrectangle_m = 400 400 500 500\n", "b",
                "outline_m");
  expectRefused("[world]\nrooms = a\n[a]\nclass = room\nrectangle_m = 1e12 0 1000000000004 3\n", "a", "outline_m");
  expectRefused("[world]\ngenerator = loop\nlength_m = 2000\n", "world", "length_m");
  const auto door = [&](const std::string& keys) {
    return "[world]\nrooms = a b\ndoors = d\n" + a + room +
           "[b]\nclass = room\nrectangle_m = 4.2 0 8 3\n[d]\nclass = door\n" + keys;
  };
  expectRefused(door("rooms = a c\nx_m = 4.1\ny_m = 1\n"), "d", "rooms");
  expectRefused(door("rooms = a\nx_m = 4.1\ny_m = 1\n"), "d", "rooms");
  expectRefused(door("rooms = a b\nx_m = 0\ny_m = 1\n"), "d", "rooms");
  expectRefused(door("rooms = a b\nx_m = 4.1\ny_m = 0.2\n"), "d", "width_m");
  expectRefused(door("rooms = a b\nx_m = 4.1\ny_m = 1.5\nheight_m = 3\n"), "d", "height_m");
}

TEST(WorldIni, generatedPlacesTakeWhatSectionsAdd) {
  const sim::World world =
      readText("[world]\ngenerator = box\nobjects = ball\n[ball]\nclass = ball\nx_m = 3\ny_m = 3\nmoves = 10 1 1 0\n");
  ASSERT_EQ(world.objects.size(), 1u);
  EXPECT_EQ(world.rooms.size(), 1u);
  EXPECT_THROW(readText("[world]\ngenerator = hoem\n"), base::Error);
}

TEST(WorldIni, aPersonPointsWithTheArmThatIsSaid) {
  const sim::World world = readText(
      twoRooms("furniture = desk\npeople = p",
               "[desk]\nclass = table\nx_m = 1.5\ny_m = 2.4\n"
               "[p]\nclass = person\npath = 0 2 1 | 90 2 1\n"
               "pointing = 2 4 desk | 10 14 desk left | 20 24 2 3 1 left | 30 34 2 3 1 right | 40 44 2 3 1\n"));
  ASSERT_EQ(world.people.size(), 1u);
  std::vector<bool> right;
  for (const auto& act : world.people[0].pointing) right.push_back(act.right_arm);
  EXPECT_EQ(right, (std::vector<bool>{true, false, false, true, true}));
  const auto handHeight = [&](const std::string& hand, double time) {
    for (const auto& joint : world.people[0].joints) {
      if (joint.name == hand) return joint.in_map.at(time)->translation.z();
    }
    return 0.0;
  };
  EXPECT_GT(handHeight("right_hand", 32), handHeight("left_hand", 32) + 0.1);
  EXPECT_GT(handHeight("left_hand", 22), handHeight("right_hand", 22) + 0.1);
}

TEST(WorldIni, groupsOfCompanionsFollowThoseOfSectionsAndChangeNothingElse) {
  const auto planOf = [](const std::string& keys) {
    return sim::readWorldPlan(base::Config::fromText("[world]\ngenerator = box\n" + keys, "w.ini"));
  };
  const auto alone = planOf(""), crowd = planOf("companions = crowd\npeople = p\n[p]\nclass = companion\nside_m = 1\n");
  EXPECT_TRUE(alone.companions.empty());
  ASSERT_EQ(crowd.companions.size(), 8u);
  EXPECT_EQ(crowd.companions[0].name, "p");
  EXPECT_EQ(crowd.companions[0].side, 1);
  EXPECT_EQ(crowd.companions[1].name, "companion_1");
  EXPECT_EQ(crowd.furniture.size(), alone.furniture.size());
  EXPECT_EQ(planOf("companions = guide\n").companions.size(), 1u);
  EXPECT_EQ(planOf("companions = guests\n").companions.size(), 2u);
  EXPECT_EQ(planOf("companions = group\n").companions.size(), 5u);
}

TEST(WorldIni, everyKindOfSectionSaysItsOptions) {
  const auto references = sim::worldSectionReferences();
  EXPECT_EQ(references.size(), 10u);
  for (const auto& reference : references) {
    EXPECT_FALSE(reference.class_names.empty()) << reference.list;
    EXPECT_FALSE(reference.options.empty()) << reference.list;
  }
}

}  // namespace
}  // namespace world_ini_test
