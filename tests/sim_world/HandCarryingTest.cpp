// People take objects, carry them and put them down.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Scene.h>
#include <omnimapper/sim_world/WorldIni.h>

#include <algorithm>
#include <cmath>

namespace hand_carrying_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;

// A room with two tables, of which the first has a tray with a can on it and a cup.
std::string room(const std::string& person, const std::string& more = "") {
  return "[world]\nrooms = room\nfurniture = a b\nobjects = tray can cup\npeople = anna\n"
         "[room]\nclass = room\nrectangle_m = 0 0 6 4\n"
         "[a]\nclass = table\nx_m = 1.5\ny_m = 3.3\n[b]\nclass = table\nx_m = 4.5\ny_m = 3.3\n"
         "[tray]\nclass = box\nx_m = 1.2\ny_m = 3.1\nyaw_deg = 15\nlength_m = 0.3\nwidth_m = 0.2\nheight_m = 0.04\n"
         "on = a/top\n"
         "[can]\nclass = can\nx_m = 1.25\ny_m = 3.1\non = tray/top\n"
         "[cup]\nclass = cup\nx_m = 1.8\ny_m = 3\non = a/top\n" +
         more + "[anna]\nclass = person\n" + person;
}
const std::string kPath = "path = 0 1.3 2.6 | 5 1.3 2.6 | 9 4.4 2.6\n";

sim::World read(const std::string& text) {
  return sim::readWorld(base::Config::fromText(text, "w.ini"));
}

const sim::Body& bodyOf(const sim::World& world, const std::string& name) {
  for (const auto& body : world.bodies) {
    if (body.name == name) return body;
  }
  throw std::runtime_error("no body " + name);
}

geometry::Se3 poseOf(const sim::World& world, const std::string& name, double time) {
  return *bodyOf(world, name).track.at(time);
}

Vector3d handOf(const sim::World& world, const std::string& hand, double time) {
  return sim::jointOf(world.people.at(0), hand).in_map.at(time)->translation;
}

// Distance of a point from the surface of a body: the least distance to a point of its triangles, sampled.
double distanceTo(const sim::World& world, const std::string& name, const Vector3d& point, double time) {
  const sim::Body& body = bodyOf(world, name);
  double least = 1e9;
  for (const auto& triangle : body.triangles) {
    std::array<Vector3d, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = *body.track.at(time) * body.vertices_in_body[triangle.corners[i]];
    for (int i = 0; i <= 10; ++i) {
      for (int j = 0; j <= 10 - i; ++j) {
        const Vector3d p = corners[0] + i / 10.0 * (corners[1] - corners[0]) + j / 10.0 * (corners[2] - corners[0]);
        least = std::min(least, (p - point).norm());
      }
    }
  }
  return least;
}

TEST(HandCarrying, anObjectStandsUntilItIsTakenAndAfterItIsPutDown) {
  const sim::World world = read(room(kPath + "carrying = 3 12 cup 4.4 3.1 90 b/top\n"));
  EXPECT_TRUE(poseOf(world, "cup", 0).translation.isApprox(Vector3d(1.8, 3, 0.74)));
  EXPECT_TRUE(poseOf(world, "cup", 3).translation.isApprox(Vector3d(1.8, 3, 0.74)));
  EXPECT_TRUE(poseOf(world, "cup", 12).translation.isApprox(Vector3d(4.4, 3.1, 0.74)));
  EXPECT_TRUE(poseOf(world, "cup", 40).translation.isApprox(Vector3d(4.4, 3.1, 0.74)));
  EXPECT_NEAR((poseOf(world, "cup", 40).rotation * Vector3d::UnitX()).y(), 1, 1e-9) << "turned by 90 deg";
  const auto& stands = world.objects.at(2).stands;
  ASSERT_EQ(stands.size(), 3u);
  EXPECT_EQ(stands[1].on, "anna");
  EXPECT_EQ(stands[2].on, "b/top");
}

TEST(HandCarrying, theHandIsOnTheObjectAndTheObjectMovesWithoutJumps) {
  const sim::World world = read(room(kPath + "carrying = 3 12 cup 4.4 3.1 90 b/top\n"));
  Vector3d before = poseOf(world, "cup", 2.5).translation;
  for (int i = 0; i <= 200; ++i) {
    const double time = 2.5 + 0.05 * i;
    const geometry::Se3 pose = poseOf(world, "cup", time);
    EXPECT_LT((pose.translation - before).norm(), 0.05 * 2.5) << "at most 2.5 m/s at " << time << " s";
    EXPECT_NEAR((pose.rotation * Vector3d::UnitZ()).z(), 1, 1e-9) << "upright at " << time << " s";
    before = pose.translation;
    if (time < 3 || time > 12) continue;
    // The hand is a ball of 4.2 cm.
    EXPECT_LT(distanceTo(world, "cup", handOf(world, "right_hand", time), time), 0.042) << time << " s";
  }
  EXPECT_GT(poseOf(world, "cup", 7).translation.z(), 0.9) << "carried before the chest";
  EXPECT_LT(handOf(world, "left_hand", 7).z(), 0.9) << "the other hand hangs";
}

TEST(HandCarrying, aWideObjectIsHeldByBothHandsAndWhatStandsOnItGoesAlong) {
  const sim::World world = read(room(kPath + "carrying = 3 12 tray 4.4 3.1 0 b/top\n"));
  const geometry::Se3 tray_from_can = inverse(poseOf(world, "tray", 0)) * poseOf(world, "can", 0);
  for (const double time : {2.0, 3.0, 3.4, 7.0, 11.6, 12.0, 20.0}) {
    const geometry::Se3 can = poseOf(world, "tray", time) * tray_from_can;
    EXPECT_TRUE(can.translation.isApprox(poseOf(world, "can", time).translation, 1e-9)) << time;
    if (time < 3 || time > 12) continue;
    for (const char* hand : {"left_hand", "right_hand"})
      EXPECT_LT(distanceTo(world, "tray", handOf(world, hand, time), time), 0.042) << hand << " at " << time << " s";
  }
  EXPECT_TRUE(
      poseOf(world, "can", 20).translation.isApprox((poseOf(world, "tray", 20) * tray_from_can).translation, 1e-9));
  EXPECT_NEAR(poseOf(world, "can", 20).translation.z(), 0.78, 1e-9);
}

TEST(HandCarrying, armsKeepTheirLengthAndFeetTheirPlaceWhileThePersonBendsToTheFloor) {
  const sim::World world = read(room("path = 0 1.6 2.55\ncarrying = 3 8 cup 1.6 2.05 0\n"));
  const double arm = 0.186 * 1.72, forearm = 0.19 * 1.72;
  for (double time = 0; time < 12; time += 0.1) {
    for (const std::string side : {"left_", "right_"}) {
      const Vector3d elbow = handOf(world, side + "elbow", time);
      EXPECT_NEAR((elbow - handOf(world, side + "shoulder", time)).norm(), arm, 0.01) << side << time;
      EXPECT_NEAR((elbow - handOf(world, side + "hand", time)).norm(), forearm, 0.01) << side << time;
      EXPECT_LT(handOf(world, side + "foot", time).z(), 0.08) << side << time;
    }
  }
  EXPECT_LT(handOf(world, "right_hand", 8).z(), 0.12) << "down at the floor";
  EXPECT_GT(handOf(world, "head", 12).z(), 1.5) << "and upright again";
}

TEST(HandCarrying, aCameraSeesTheCarriedObject) {
  const sim::World world = read(room(kPath + "carrying = 3 12 cup 4.4 3.1 90 b/top\n"));
  const sim::Scenes scenes(world);
  const auto refs = sim::numberSurfaces(world);
  for (const double time : {1.0, 3.5, 7.0, 11.0, 14.0}) {
    const Vector3d middle = poseOf(world, "cup", time) * Vector3d(0, 0, 0.09);
    const Vector3d eye = middle + Vector3d(0, 0.1, 0.4);
    const sim::Hit hit = scenes.at(time).cast({eye, (middle - eye).normalized(), 0, 10});
    ASSERT_TRUE(hit.isHit()) << time;
    EXPECT_EQ(world.bodies[refs[hit.surface].body].name, "cup") << time;
  }
}

struct Mistake {
  const char* name;
  std::string text, place;
  std::vector<std::string> words;
};

TEST(HandCarrying, whatNoHandCanDoIsRefusedWithPlaceAndRemedy) {
  const auto carry = [](const std::string& carrying) { return room(kPath + "carrying = " + carrying + "\n"); };
  std::string moved = carry("3 12 cup 4.4 3.1 0 b/top");
  moved.replace(moved.find("y_m = 3\n"), 8, "y_m = 3\nmoves = 20 away\n");
  std::string ridden = carry("3 12 tray 4.4 3.1 0 b/top");
  ridden.replace(ridden.find("on = tray/top\n"), 14, "on = tray/top\nmoves = 20 away\n");
  const std::vector<Mistake> mistakes{
      {"too few words", carry("3 12 cup 4.4"), "[anna] carrying", {"begin end object x y yaw"}},
      {"an unknown object", carry("3 12 cupp 4.4 3.1 0 b/top"), "[anna] carrying", {"'cupp'", "did you mean 'cup'"}},
      {"an unknown surface", carry("3 12 cup 4.4 3.1 0 c/top"), "[anna] carrying", {"'c/top'"}},
      {"over the rim", carry("3 12 cup 4.4 2.86 0 b/top"), "[anna] carrying", {"rim of 'b/top'"}},
      {"an object with moves", moved, "[anna] carrying", {"moves of its own"}},
      {"a rider with moves", ridden, "[can] moves", {"'tray'", "carried by hand"}},
      {"twice at once",
       carry("3 12 cup 4.4 3.1 0 b/top | 8 14 cup 4.4 3.1 0 b/top"),
       "[anna] carrying",
       {"in the hands of 'anna' until 12 s"}},
      {"two at once",
       carry("3 12 cup 4.4 3.1 0 b/top | 8 14 tray 4.9 3.2 0 b/top"),
       "[anna] path or carrying",
       {"leave 2 s"}},
      {"in no time", carry("3 4 cup 1.5 3 0 a/top"), "[anna] path or carrying", {"at least 2 s"}},
      {"while walking", carry("4.5 12 cup 4.4 3.1 0 b/top"), "[anna] path or carrying", {"it walks", "stand"}},
      {"out of reach", carry("3 12 cup 4.4 3.6 0 b/top"), "[anna] path or carrying", {"out of reach", "0.4 m"}},
      {"while pointing",
       room(kPath + "pointing = 2 4 tray\ncarrying = 3 12 cup 4.4 3.1 0 b/top\n"),
       "[anna] path or carrying",
       {"points"}},
      {"into another object",
       room(kPath + "carrying = 3 12 cup 1.2 3.1 0 a/top\n"),
       "[anna] carrying",
       {"stands in 'tray'"}},
  };
  for (const Mistake& mistake : mistakes) {
    try {
      read(mistake.text);
      ADD_FAILURE() << mistake.name << " is accepted";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::out_of_range) << mistake.name;
      const std::string what = error.what();
      EXPECT_NE(what.find("w.ini: " + mistake.place), std::string::npos) << mistake.name << ": " << what;
      for (const std::string& word : mistake.words)
        EXPECT_NE(what.find(word), std::string::npos) << mistake.name << ": " << what;
    }
  }
}

}  // namespace
}  // namespace hand_carrying_test
