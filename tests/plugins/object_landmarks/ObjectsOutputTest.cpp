#include <gtest/gtest.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "object_landmarks/ObjectPayload.h"
#include "object_landmarks/ObjectsOutput.h"

namespace omnimapper::plugins::objects_output_test {
namespace {

using nlohmann::json;
using State = map::Landmark::State;

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

class ObjectsFiles : public ::testing::Test {
 protected:
  ObjectsFiles() { run_.addFrame({1, 0, 0, 0, 0, 0}); }

  base::LandmarkId add(State state, bool confirmed, bool pictured = false) {
    auto payload = std::make_shared<ObjectPayload>();
    ObjectView view;
    view.frame = run_.map.key_frames.front().id;
    view.points = {{1, 0, 0.7F}, {1.1F, 0, 0.7F}, {1.1F, 0.2F, 0.7F}, {1, 0.2F, 1}};
    view.colours = {{9, 8, 7}, {9, 8, 7}, {9, 8, 7}, {9, 8, 7}};
    payload->model = std::make_shared<const ObjectModel>(std::vector<ObjectView>{view});
    payload->is_confirmed = confirmed;
    payload->evidence.add(Sight::seen, base::stampFromUnix(1'000'000'000.5));
    payload->evidence.add(Sight::absent, base::stampFromUnix(1'000'000'002));
    if (pictured)
      payload->picture = ObjectPicture{60, std::make_shared<const map::Photograph>(map::Photograph{1, 1, {1, 2, 3}})};
    payload->on = base::LandmarkId{0, 0};
    map::Landmark landmark;
    landmark.id = run_.map.landmarks.nextId(0);
    landmark.kind = "object";
    landmark.state = state;
    landmark.payload = payload;
    return run_.map.landmarks.add(0, landmark);
  }
  json written() {
    mapper::PluginContext context;
    context.section = "object_files";
    context.title = title_;
    context.output_folder = folder_ / "";
    ObjectsOutput({}, context).finish(run_.view());
    return json::parse(contentOf(folder_ / "objects.json"));
  }

  std::string title_ = "a \"map\"";
  testing::HandMadeRun run_;
  testing::ScratchFolder folder_;
};

TEST_F(ObjectsFiles, HaveEachObjectWithItsEvidence) {
  add(State::active, true, true);
  add(State::retired, true);
  add(State::active, false);
  add(State::merged, true);
  add(State::retired, false);
  const json all = written();
  EXPECT_EQ(all["schema"], "omnimapper-objects");
  EXPECT_EQ(all["version"], 1);
  EXPECT_EQ(all["map"], "a \"map\"");
  EXPECT_EQ(all["merged"], 1);
  ASSERT_EQ(all["objects"].size(), 3U) << "neither what was merged nor a candidate that was given up";
  EXPECT_EQ(all["objects"][0]["state"], "present");
  EXPECT_EQ(all["objects"][1]["state"], "gone");
  EXPECT_EQ(all["objects"][2]["state"], "candidate");
  const json& first = all["objects"][0];
  EXPECT_EQ(first["id"], "0-0");
  EXPECT_EQ(first["label"], "object");
  EXPECT_NEAR(first["box"]["middle"][0], 2.05, 1e-5) << "in the map";
  EXPECT_NEAR(first["box"]["size"][2], 0.3, 1e-5);
  EXPECT_EQ(first["points"], 4);
  EXPECT_EQ(first["views"], 1);
  EXPECT_EQ(first["seen_in"], 1);
  EXPECT_EQ(first["hidden_in"], 0);
  EXPECT_EQ(first["absent_in"], 1);
  EXPECT_EQ(first["absent_at"].size(), 1U);
  EXPECT_NEAR(first["last_seen"], 1'000'000'000.5, 1e-3);
  EXPECT_NEAR(first["last_looked"], 1'000'000'002.0, 1e-3);
  EXPECT_EQ(first["on"], "0-0");
  EXPECT_EQ(all["objects"][1]["picture"], nullptr);
  EXPECT_EQ(contentOf(folder_ / first["picture"].get<std::string>()).substr(1, 3), "PNG");
  const std::string ply = contentOf(folder_ / first["model"].get<std::string>());
  EXPECT_NE(ply.find("element vertex 4"), std::string::npos);
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 4 * 15);
}

TEST_F(ObjectsFiles, OfALogWhoseNameIsNoTextAreWritten) {
  title_ = "caf\xE9";
  add(State::active, true);
  EXPECT_EQ(written()["objects"].size(), 1U);
}

TEST_F(ObjectsFiles, OfAMapWithoutObjectsAreOneFile) {
  EXPECT_EQ(written()["objects"], json::array());
  EXPECT_FALSE(std::ifstream(folder_ / "objects/0-0.ply").good());
}

}  // namespace
}  // namespace omnimapper::plugins::objects_output_test
