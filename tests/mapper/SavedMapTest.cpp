#include <gtest/gtest.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/HandMadeRun.h>
#include <omnimapper/testing/MapperRun.h>

#include <filesystem>
#include <fstream>

namespace omnimapper::mapper::saved_map_test {
namespace {

using mrpt::poses::CPose3D;

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The section of a plugin that does not exist any more.
class Foreign : public map::LandmarkPayload {
 public:
  std::string_view kind() const override { return "foreign"; }
  void write(std::ostream& out) const override { out << std::string("\0\1 bytes", 8); }
};

class SavedMapFile : public ::testing::Test {
 protected:
  SavedMapFile() {
    mapper::loadFeatures();
    for (int i = 0; i < 4; ++i) run_.addFrame(CPose3D(i, 0.1 * i, 0, 0.3 * i, 0, 0));
    for (std::uint32_t i = 0; i + 1 < 4; ++i) {
      run_.graph.addFactor(betweenPoses(Motion::planar, run_.map.key_frames[i].pose, run_.map.key_frames[i + 1].pose,
                                        {CPose3D(1, 0.1, 0, 0.3, 0, 0), Eigen::Matrix<double, 6, 6>::Identity()},
                                        "odometry"));
    }
    run_.map.sessions.push_back({0, "first", run_.map.key_frames[0].pose, true});
    map::Landmark landmark;
    landmark.kind = "thing";
    landmark.variables = {run_.map.key_frames[2].pose};
    landmark.payload = std::make_shared<Foreign>();
    run_.map.landmarks.add(0, landmark);
    run_.map.layers.set("plugin gone", std::make_shared<const map::RawLayer>(7, std::string("a\0b", 3)));
    run_.map.layers.set("of the future", std::make_shared<const map::RawLayer>(1, "c"));
  }
  map::MapFile file() const { return derived::mapFileOf(run_.map, run_.graph); }
  std::string refusal(const map::MapFile& file) const {
    file.write(path_);
    return refusal();
  }
  std::string refusal() const {
    try {
      derived::readMap(path_, registeredKinds());
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input) << error.what();
      EXPECT_EQ(std::string(error.what()).rfind(path_, 0), 0U) << "names the file: " << error.what();
      return error.what();
    }
    return {};
  }

  testing::HandMadeRun run_;
  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "map.omnimap";
};

TEST_F(SavedMapFile, WrittenReadAndWrittenAgainItHasTheSameBytesTwice) {
  file().write(path_);
  const std::string first = contentOf(path_);
  for (int trip = 0; trip < 2; ++trip) {
    const auto saved = derived::readMap(path_, registeredKinds());
    ASSERT_EQ(saved.map.layers.size(), 2U);
    const auto gone = saved.map.layers.find("plugin gone");
    ASSERT_TRUE(gone);
    EXPECT_EQ(gone->version(), 7U);
    EXPECT_EQ(gone->bytes(), std::string("a\0b", 3));
    EXPECT_EQ(saved.map.landmarks.find({0, 0})->payload->kind(), "foreign");
    derived::mapFileOf(saved.map, saved.graph).write(path_);
    EXPECT_TRUE(contentOf(path_) == first) << "trip " << trip;
  }
}

TEST_F(SavedMapFile, TheFolderThatHoldsItIsAsGood) {
  file().write(path_);
  EXPECT_EQ(derived::readMap(folder_.path(), registeredKinds()).map.key_frames.size(), 4U);
}

TEST_F(SavedMapFile, AMapOfVersionOneIsReadWithASessionMadeUp) {
  const std::string old = testing::sourceFile("tests/map/data/version1.omnimap");
  const auto saved = derived::readMap(old, registeredKinds());
  EXPECT_FALSE(map::MapFile::read(old).find("sessions"));
  ASSERT_GT(saved.map.key_frames.size(), 3U);
  EXPECT_EQ(saved.motion(), Motion::planar);
  ASSERT_EQ(saved.map.sessions.size(), 1U);
  EXPECT_EQ(saved.map.sessions[0].anchor, saved.map.key_frames.front().pose);
  EXPECT_TRUE(saved.map.sessions[0].aligned);
  for (const auto& frame : saved.map.key_frames) {
    EXPECT_TRUE(frame.reference);
    EXPECT_EQ(frame.observations.size(), 2U) << "the scan and its points";
  }
  EXPECT_TRUE(saved.map.landmarks.empty());
  derived::mapFileOf(saved.map, saved.graph).write(path_);
  const std::string first = contentOf(path_);
  const auto again = derived::readMap(path_, registeredKinds());
  derived::mapFileOf(again.map, again.graph).write(path_);
  EXPECT_TRUE(contentOf(path_) == first);
}

TEST_F(SavedMapFile, WhatIsMissingDamagedOrOfTheFutureIsRefusedByName) {
  EXPECT_NE(refusal().find("cannot be opened"), std::string::npos);
  file().write(path_);
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  EXPECT_NE(refusal(), "");
  for (const std::string name : {"graph", "frames", "landmarks", "sessions"}) {
    auto later = file();
    later.set({name, 99, later.find(name)->bytes});
    EXPECT_NE(refusal(later).find("version 99"), std::string::npos) << name;
    auto cut = file();
    cut.set({name, cut.find(name)->version, cut.find(name)->bytes.substr(0, 20)});
    EXPECT_NE(refusal(cut), "") << name;
  }
  map::MapFile partial;
  partial.set(*file().find("frames"));
  EXPECT_NE(refusal(partial).find("no section \"graph\""), std::string::npos);
}

TEST_F(SavedMapFile, KindsOfAPluginThatIsNotLoadedAreRefusedWithTheRemedy) {
  auto strange = file();
  std::string bytes = strange.find("graph")->bytes;
  const std::string kind(run_.graph.factors().begin().operator*().second.factor->kind());
  bytes.replace(bytes.find(kind), kind.size(), std::string(kind.size(), 'z'));
  strange.set({"graph", 1, bytes});
  const std::string message = refusal(strange);
  EXPECT_NE(message.find("plugin_libraries"), std::string::npos) << message;
  EXPECT_NE(message.find(std::string(kind.size(), 'z')), std::string::npos) << message;
}

TEST_F(SavedMapFile, PartsThatDoNotFitEachOtherAreRefused) {
  const auto whole = run_;
  run_.map.key_frames.edit({0, 2}).pose = {0, 99};
  EXPECT_NE(refusal(file()).find("key frame 0:2"), std::string::npos);
  run_ = whole;
  run_.map.sessions[0].anchor = {5, 5};
  EXPECT_NE(refusal(file()).find("session 0"), std::string::npos);
  run_ = whole;
  run_.map.sessions[0].number = 1;
  EXPECT_NE(refusal(file()).find("no known session"), std::string::npos);
  run_ = whole;
  run_.map.landmarks.edit({0, 0})->variables = {{0, 77}};
  EXPECT_NE(refusal(file()).find("landmark 0:0"), std::string::npos);
  run_ = whole;
  map::Landmark merged;
  merged.state = map::Landmark::State::merged;
  merged.merged_into = {0, 2};
  run_.map.landmarks.add(0, merged);
  merged.merged_into = {0, 1};
  run_.map.landmarks.add(0, merged);
  EXPECT_NE(refusal(file()).find("landmark 0:1 is merged into itself"), std::string::npos);
  run_ = whole;
  EXPECT_EQ(refusal(file()), "");
}

TEST_F(SavedMapFile, AGraphThatLeavesThePlaceOfAPoseOpenIsRefused) {
  const auto loose = run_.graph.addVariable(graph::se2(), Eigen::Vector3d(5, 5, 0));
  run_.graph.addFactor(betweenPoses(Motion::planar, loose,
                                    run_.graph.addVariable(graph::se2(), Eigen::Vector3d(6, 5, 0)),
                                    {CPose3D(1, 0, 0, 0, 0, 0), Eigen::Matrix<double, 6, 6>::Identity()}, "odometry"));
  EXPECT_NE(refusal(file()).find("does not determine the map"), std::string::npos);
}

TEST_F(SavedMapFile, AFactorThatLeavesNoDigitsToTheOthersIsRefused) {
  const auto refusalOfDeviation = [this](double deviation) {
    auto record = betweenPoses(Motion::planar, run_.map.key_frames[0].pose, run_.map.key_frames[1].pose,
                               {CPose3D(1, 0.1, 0, 0.3, 0, 0), Eigen::Matrix<double, 6, 6>::Identity()}, "odometry");
    record.noise = graph::SquareRootInformation::fromSigmas(Eigen::Vector3d::Constant(deviation));
    const auto more = run_.graph.addFactor(record);
    const auto reason = refusal(file());
    run_.graph.removeFactor(more);
    return reason;
  };
  EXPECT_EQ(refusalOfDeviation(1e-6), "");
  const auto reason = refusalOfDeviation(1e-9);
  EXPECT_NE(reason.find("precision of a double"), std::string::npos) << reason;
}

TEST_F(SavedMapFile, ANewSessionStartsWhereTheOptionsSay) {
  run_.map.key_frames.edit({0, 3}).dependents.push_back(
      {run_.map.key_frames[3].stamp + base::Duration(1), CPose3D(0.2, 0, 0, 0, 0, 0)});
  SessionOptions options;
  const auto end = options.startOn(run_.map);
  EXPECT_LT((end.map_from_base - (run_.map.key_frames[3].map_from_base + CPose3D(0.2, 0, 0, 0, 0, 0))).norm(), 1e-12);
  EXPECT_EQ(end.position_sigma, 1);
  EXPECT_NEAR(end.angle_sigma, 0.5236, 1e-4);
  options.start = SessionOptions::Start::origin;
  EXPECT_EQ(options.startOn(run_.map).map_from_base.norm(), 0);
  options.start = SessionOptions::Start::pose;
  options.start_x = 3, options.start_y = -4, options.start_yaw = 1;
  const auto pose = options.startOn(run_.map).map_from_base;
  EXPECT_EQ(pose.x(), 3);
  EXPECT_EQ(pose.y(), -4);
  EXPECT_NEAR(pose.yaw(), 1, 1e-12);
}

}  // namespace
}  // namespace omnimapper::mapper::saved_map_test
