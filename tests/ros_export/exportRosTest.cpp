#include <omnimapper/ros_export/exportRos.h>

#include <map>

#include "../query/MapWithFrames.h"
#include "ros_log/Container.h"
#include "ros_log/Value.h"

namespace omnimapper::ros_export::export_ros_test {
namespace {

/// The messages of an MCAP file by their topics, read by the definitions that the file has.
class ReadBack {
 public:
  explicit ReadBack(const std::string& path) : file_(ros::openContainer(path, channels_)) {
    for (std::size_t i = 0; i < file_->chunks().size(); ++i)
      for (const auto& message : file_->load(i)) messages_[channels_[message.channel].topic].push_back(message);
  }
  std::size_t count(const std::string& topic) const {
    const auto found = messages_.find(topic);
    return found == messages_.end() ? 0 : found->second.size();
  }
  std::int64_t time(const std::string& topic, std::size_t index = 0) const {
    return messages_.at(topic).at(index).time;
  }
  ros::Value value(const std::string& topic, std::size_t index = 0) {
    const auto& message = messages_.at(topic).at(index);
    const auto& channel = channels_[message.channel];
    EXPECT_EQ(channel.encoding, "cdr");
    auto& definition = definitions_[channel.type];
    if (!definition) definition = std::make_unique<ros::Definition>(channel.type, channel.definition);
    return decoded(definition->layout(), message.bytes, ros::Encoding::cdr);
  }
  const std::string& damage() const { return file_->damage().what; }
  std::size_t chunks() const { return file_->chunks().size(); }

 private:
  ros::Channels channels_;
  std::unique_ptr<ros::Container> file_;
  std::map<std::string, std::vector<ros::Message>> messages_;
  std::map<std::string, std::unique_ptr<ros::Definition>> definitions_;
};

class ExportRos : public query::MapWithFrames {
 protected:
  ReadBack exported() {
    write();
    last_ = exportRos(folder_.path(), out_);
    return ReadBack(out_);
  }
  const std::string out_ = folder_ / "out.mcap";
  Exported last_;
};

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;  // [ns] of key frame 0:0; 0:1 is 1 s later

TEST_F(ExportRos, PosesAreThoseOfTheKeyFramesWithTheirTimes) {
  auto log = exported();
  EXPECT_EQ(log.damage(), "");
  EXPECT_EQ(last_.poses, 2U);
  ASSERT_EQ(log.count("/tf"), 2U);
  ASSERT_EQ(log.count("/odometry"), 2U);
  EXPECT_EQ(log.time("/tf", 1), kStart + 1'000'000'000);
  const auto tf = log.value("/tf", 1);
  ASSERT_EQ(tf["transforms"].size(), 1U);
  const auto& transform = tf["transforms"][0];
  EXPECT_EQ(transform["header"]["frame_id"].text(), "map");
  EXPECT_EQ(transform["header"]["stamp"].nanoseconds(), kStart + 1'000'000'000);
  EXPECT_EQ(transform["child_frame_id"].text(), "base_link");
  EXPECT_EQ(transform["transform"]["translation"].vector(), Eigen::Vector3d(6, 1, 0));
  EXPECT_NEAR(transform["transform"]["rotation"]["z"].number(), std::sqrt(0.5), 1e-12) << "it looks along y";
  EXPECT_NEAR(transform["transform"]["rotation"]["w"].number(), std::sqrt(0.5), 1e-12);
  const auto odometry = log.value("/odometry", 0);
  EXPECT_EQ(odometry["pose"]["pose"]["position"].vector(), Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(odometry["pose"]["pose"]["orientation"]["w"].number(), 1);
  EXPECT_EQ(odometry["twist"]["covariance"].size(), 36U);
  const auto path = log.value("/path");
  ASSERT_EQ(path["poses"].size(), 2U);
  EXPECT_EQ(path["poses"][1]["pose"]["position"].vector(), Eigen::Vector3d(6, 1, 0));
}

TEST_F(ExportRos, TheGridIsThatOfTheMap) {
  auto log = exported();
  EXPECT_TRUE(last_.has_grid);
  ASSERT_EQ(log.count("/map"), 1U);
  EXPECT_EQ(log.time("/map"), kStart);
  const auto grid = log.value("/map");
  EXPECT_EQ(grid["info"]["width"].integer(), 80);
  EXPECT_EQ(grid["info"]["height"].integer(), 40);
  EXPECT_FLOAT_EQ(static_cast<float>(grid["info"]["resolution"].number()), 0.1F);
  EXPECT_EQ(grid["info"]["origin"]["position"].vector(), Eigen::Vector3d(0, 0, 0));
  const auto& cells = grid["data"];
  ASSERT_EQ(cells.size(), 3200U);
  EXPECT_EQ(cells.number(0), 100) << "the wall around both rooms";
  EXPECT_EQ(cells.number(81), 0);
  EXPECT_EQ(cells.number(20 * 80 + 60), 100) << "the column in the middle of room 2";
  std::filesystem::remove(folder_ / "grid.yaml");
  auto without = exported();
  EXPECT_EQ(without.count("/map"), 0U);
  ASSERT_EQ(last_.notes.size(), 1U);
  EXPECT_NE(last_.notes[0].find("no grid.yaml"), std::string::npos);
}

TEST_F(ExportRos, LandmarksAreMarkersWithTheirEdgesAndNames) {
  map::Place wall = query::wallFrom(0, 0, 3, 0);
  wall.extent.top = 2;
  wall.moved = true;
  map_.places = query::placesOf({wall, query::signAt(6, 4, "118")});
  auto log = exported();
  EXPECT_EQ(last_.landmarks, 2U);
  const auto array = log.value("/landmarks");
  const auto& markers = array["markers"];
  ASSERT_EQ(markers.size(), 4U) << "edges and name of the wall, point and name of the sign";
  const auto& edges = markers[0];
  EXPECT_EQ(edges["header"]["frame_id"].text(), "map");
  EXPECT_EQ(edges["ns"].text(), "moved");
  EXPECT_EQ(edges["type"].integer(), 5) << "a list of lines";
  ASSERT_EQ(edges["points"].size(), 8U) << "below, above, and at both ends";
  EXPECT_EQ(edges["points"][1].vector(), Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(edges["points"][3].vector(), Eigen::Vector3d(3, 0, 2));
  EXPECT_LT(edges["color"]["a"].number(), 1);
  const auto& name = markers[1];
  EXPECT_EQ(name["type"].integer(), 9);
  EXPECT_EQ(name["text"].text(), "wall");
  EXPECT_NEAR((name["pose"]["position"].vector() - Eigen::Vector3d(1.5, 0, 2.2)).norm(), 0, 1e-12);
  EXPECT_EQ(markers[2]["ns"].text(), "sign");
  EXPECT_EQ(markers[2]["type"].integer(), 7) << "spheres";
  EXPECT_EQ(markers[2]["points"][0].vector(), Eigen::Vector3d(6, 4, 1.5));
  EXPECT_EQ(markers[2]["color"]["a"].number(), 1);
  EXPECT_EQ(markers[3]["text"].text(), "118");
  EXPECT_EQ(markers[3]["id"].integer(), 3);
}

TEST_F(ExportRos, ManyMessagesAreInSeveralChunksAndTheSameEachTime) {
  map_.places = query::placesOf(std::vector<map::Place>(4000, query::signAt(6, 4, "118")));
  auto log = exported();
  EXPECT_GT(log.chunks(), 1U);
  EXPECT_EQ(log.count("/tf"), 2U);
  const auto bytes = [&] {
    std::ifstream in(out_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string first = bytes();
  exported();
  EXPECT_EQ(bytes(), first);
}

TEST_F(ExportRos, AMapIsNotReplacedAndWhatIsNoMapIsRefused) {
  write();
  EXPECT_NE(query::refusalOf([&] { exportRos(folder_.path(), map_.file); }, base::ExitCode::command_line), "");
  EXPECT_NE(query::refusalOf([&] { exportRos(folder_ / "none", out_); }, base::ExitCode::unreadable_input), "");
  const std::string bag = folder_ / "out.bag";
  EXPECT_NE(query::refusalOf([&] { exportRos(folder_.path(), bag); }, base::ExitCode::command_line).find(".mcap"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out_) || std::filesystem::exists(bag));
}

TEST_F(ExportRos, TimesForWhichRosHasNoStampsAreRefused) {
  for (const auto start : {base::stampFromUnix(2147483647), base::stampFromUnix(-0.5), base::Stamp(),
                           base::Stamp::max() - base::durationFromSeconds(2)}) {
    start_ = start;
    write();
    const auto refusal = query::refusalOf([&] { exportRos(folder_.path(), out_); }, base::ExitCode::unreadable_input);
    EXPECT_NE(refusal.find("for which ROS has no stamps"), std::string::npos) << refusal;
  }
  start_ = base::stampFromUnix(2147483646);
  EXPECT_EQ(exported().time("/tf", 1), 2'147'483'647'000'000'000);
}

}  // namespace
}  // namespace omnimapper::ros_export::export_ros_test
