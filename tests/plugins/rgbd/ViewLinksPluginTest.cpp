#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/plugin/FactoryOf.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <memory>
#include <vector>

#include "RenderedScan.h"
#include "rgbd/ViewLinksPlugin.h"

namespace omnimapper::plugins::view_links_plugin_test {
namespace {

using geometry::Se3;
using mrpt::poses::CPose3D;
using Says = mapper::Evidence::Says;

const CPose3D kBaseFromCamera(0.1, 0.05, 0.2, 0.1, 0.2, 0);

base::Stamp at(double seconds) {
  return base::stampFromUnix(1.6e9) + base::durationFromSeconds(seconds);
}

Se3 moved(double x, double y, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {x, y, 0}};
}

using Factory = mapper::FactoryOf<ViewLinksPlugin, ViewLinksOptions>;

/// A run whose key frames are added by hand, one each second.
class ViewLinks : public ::testing::Test {
 protected:
  ViewLinks() {
    context_.section = "view_links";
    context_.motion = mapper::Motion::spatial;
    tracking_.depth_readout = tracking_.picture_readout = tracking_.picture_delay = tracking_.picture_delay_sigma = 0;
    make({});
  }

  void make(const ViewLinksOptions& options) {
    plugin_ = std::make_unique<ViewLinksPlugin>(options, ViewLinksPlugin::Camera{"", tracking_, {}}, context_);
  }

  mapper::Batch measured(const map::KeyFrame& frame, const mrpt::obs::CObservation& scan,
                         const perception::Blackboard& board = {}) {
    const auto prepared = plugin_->prepareUsing(scan, board);
    return plugin_->measure(frame, {scan, prepared.get()}, run_.view());
  }

  /// Adds a key frame. `start_from_base`: its true pose. `estimate`: its pose in the map.
  mapper::Batch see(const Se3& start_from_base, const Se3& estimate, bool is_covered = false) {
    const double seconds = static_cast<double>(run_.map.key_frames.size());
    map::KeyFrame frame;
    frame.id = run_.map.key_frames.nextId(0);
    frame.stamp = at(seconds);
    frame.map_from_base = geometry::toMrpt(estimate);
    frame.pose = run_.graph.addVariable(mapper::poseVariable(context_.motion),
                                        mapper::poseValue(context_.motion, frame.map_from_base));
    run_.map.key_frames.insert(frame);
    const auto scan = renderedScan(room_, kRoomFromStart * start_from_base, kBaseFromCamera, frame.stamp, is_covered);
    EXPECT_TRUE(plugin_->wants(*scan));
    return measured(run_.map.key_frames.at(frame.id), *scan);
  }
  mapper::Batch see(const Se3& start_from_base) { return see(start_from_base, start_from_base); }

  base::VariableId poseOfFrame(std::size_t position) const { return run_.map.key_frames[position].pose; }

  // The room's z is forward and its y down.
  const Se3 kRoomFromStart{Eigen::Quaterniond(geometry::sensorFromOptical().rotation.conjugate()), {0, 0.1, -0.3}};
  matching::RenderedRoom room_;
  mapper::PluginContext context_;
  matching::RgbdTrackerOptions tracking_;
  mapper::ViewedRun run_;
  std::unique_ptr<ViewLinksPlugin> plugin_;
};

TEST_F(ViewLinks, tieAKeyFrameToTheSecondAndThirdBeforeIt) {
  EXPECT_TRUE(see(moved(0, 0, 0)).addedFactors().empty());
  EXPECT_TRUE(see(moved(0.04, 0.01, 0.03)).addedFactors().empty());
  EXPECT_EQ(see(moved(0.08, 0.01, 0.06)).addedFactors().size(), 1u);
  const auto batch = see(moved(0.12, 0.02, 0.09));
  ASSERT_EQ(batch.addedFactors().size(), 2u);
  EXPECT_EQ(batch.addedFactors()[0].variables, (std::vector{poseOfFrame(1), poseOfFrame(3)}));
  EXPECT_EQ(batch.addedFactors()[1].variables, (std::vector{poseOfFrame(0), poseOfFrame(3)}));
  for (const auto& factor : batch.addedFactors()) EXPECT_FALSE(factor.tags.hypothesis);
}

TEST_F(ViewLinks, measureTheTrueMotionWhateverTheMapHas) {
  see(moved(0, 0, 0));
  see(moved(0.04, 0.01, 0.03));
  const auto batch = see(moved(0.08, 0.01, 0.06), moved(0.11, -0.01, 0.04));
  ASSERT_EQ(batch.addedFactors().size(), 1u);
  // The error of the factor at the true poses.
  const auto& factor = batch.addedFactors().front();
  const std::vector<Eigen::VectorXd> truth{
      mapper::poseValue(context_.motion, geometry::toMrpt(moved(0, 0, 0))),
      mapper::poseValue(context_.motion, geometry::toMrpt(moved(0.08, 0.01, 0.06)))};
  const double* values[] = {truth[0].data(), truth[1].data()};
  Eigen::Matrix<double, 6, 1> error;
  factor.factor->evaluate(values, error.data(), nullptr);
  EXPECT_LT(error.head<3>().norm(), 0.004);
  EXPECT_LT(error.tail<3>().norm(), 0.003);
}

TEST_F(ViewLinks, doNotTieWhatACoveredLensShows) {
  see(moved(0, 0, 0));
  see(moved(0.04, 0.01, 0.03));
  EXPECT_TRUE(see(moved(0.08, 0.01, 0.06), moved(0.08, 0.01, 0.06), true).addedFactors().empty());
}

// The camera turns by more than a radian, in steps whose views no longer show the one before last, and back again.
TEST_F(ViewLinks, proposeAViewThatComesBack) {
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i) see(moved(0, 0, 0.12 * i));
  std::size_t proposed = 0, left = 0;
  for (int i = kSteps; i >= 0; --i) {
    const auto batch = see(moved(0, 0, 0.12 * i + 0.01));
    for (const auto& factor : batch.addedFactors()) proposed += factor.tags.hypothesis;
    for (const auto& decision : batch.decisions()) left += decision.is_loop_closure && decision.accepted;
  }
  EXPECT_GT(left, 0u);
  EXPECT_GE(proposed, left);
  const auto evidence = plugin_->evidence(run_.view());
  ASSERT_EQ(evidence.size(), 4u);
  EXPECT_EQ(evidence[0].name, "camera_returns");
  EXPECT_EQ(evidence[0].value, static_cast<double>(left));
  EXPECT_EQ(evidence[1].name, "camera_returned_percent");
  EXPECT_GT(evidence[1].value, 50);
  for (const auto& one : evidence) EXPECT_EQ(one.says, Says::good) << one.reason;
}

// In the map the camera is back where it started, but the image shows another side of the room.
TEST_F(ViewLinks, areEvidenceAgainstADistortedMap) {
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i) see(moved(0, 0, 0.12 * i));
  for (int i = 0; i < kSteps; ++i) see(moved(0, 0, 0.12 * kSteps), moved(0, 0, 0.01 * i));
  const auto evidence = plugin_->evidence(run_.view());
  ASSERT_EQ(evidence.size(), 4u);
  EXPECT_EQ(evidence[0].says, Says::too_little);
  EXPECT_EQ(evidence[3].name, "camera_returns_missed_percent");
  EXPECT_EQ(evidence[3].says, Says::against_it);
  EXPECT_NE(evidence[3].reason.find("distorted"), std::string::npos);
}

// By its images the camera turned back, but in the finished map it is half a radian away.
TEST_F(ViewLinks, reportAMapThatHasReturnsElsewhere) {
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i) see(moved(0, 0, 0.12 * i));
  for (int i = kSteps; i >= 0; --i) see(moved(0, 0, 0.12 * i + 0.01));
  EXPECT_EQ(plugin_->evidence(run_.view())[2].value, 0);
  for (std::size_t i = kSteps; i < run_.map.key_frames.size(); ++i) {
    auto& frame = run_.map.key_frames.edit(run_.map.key_frames[i].id);
    frame.map_from_base = frame.map_from_base + geometry::toMrpt(moved(0, 0, 0.5));
  }
  const auto evidence = plugin_->evidence(run_.view());
  EXPECT_EQ(evidence[2].name, "camera_returns_elsewhere_percent");
  EXPECT_EQ(evidence[2].value, 100);
  EXPECT_EQ(evidence[2].says, Says::too_little);
  EXPECT_EQ(evidence[0].value, 0);
}

// Each of two links that share an image has twice the covariance of a single link.
TEST_F(ViewLinks, shareTheirImage) {
  const auto informationOfTheFirst = [&](int back) {
    ViewLinksOptions options;
    options.key_frames_back = back;
    make(options);
    run_ = mapper::ViewedRun();
    for (int i = 0; i < 3; ++i) see(moved(0.04 * i, 0, 0.03 * i));
    const auto batch = see(moved(0.12, 0, 0.09));
    EXPECT_EQ(batch.addedFactors().size(), static_cast<std::size_t>(back - 1));
    return batch.addedFactors().front().noise.information();
  };
  const Eigen::MatrixXd alone = informationOfTheFirst(2), of_two = informationOfTheFirst(3);
  EXPECT_LT((2 * of_two - alone).norm(), 1e-6 * alone.norm());
}

TEST_F(ViewLinks, leaveOutAnImageThatCannotBeRead) {
  see(moved(0, 0, 0));
  see(moved(0.04, 0.01, 0.03));
  auto scan = renderedScan(room_, kRoomFromStart, kBaseFromCamera, at(2));
  scan->cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  EXPECT_TRUE(measured(run_.map.key_frames.back(), *scan).empty());
  EXPECT_EQ(see(moved(0.08, 0.01, 0.06)).addedFactors().size(), 1u);
}

TEST_F(ViewLinks, haveNoEvidenceWithoutOldViews) {
  ViewLinksOptions options;
  options.old_views = 0;
  make(options);
  for (int i = 0; i < 5; ++i) see(moved(0, 0, 0.12 * i));
  EXPECT_TRUE(plugin_->evidence(run_.view()).empty());
}

TEST_F(ViewLinks, takeOneCameraAlone) {
  see(moved(0, 0, 0));
  see(moved(0.04, 0.01, 0.03));
  auto scan = renderedScan(room_, kRoomFromStart, kBaseFromCamera, at(2));
  scan->sensorLabel = "another";
  EXPECT_TRUE(measured(run_.map.key_frames.back(), *scan).empty());
}

TEST_F(ViewLinks, takeTheImageThatTheOdometryHasMade) {
  see(moved(0, 0, 0));
  see(moved(0.04, 0.01, 0.03));
  const auto scan = renderedScan(room_, kRoomFromStart, kBaseFromCamera, at(2));
  const auto another = renderedScan(room_, kRoomFromStart, kBaseFromCamera, at(2), true);
  perception::Blackboard board;
  const camera::LensStraightener lens;
  StraightImage::share(std::make_shared<const StraightImage>(scan, lens), board);
  EXPECT_EQ(plugin_->prepareUsing(*another, {}), nullptr) << "no depths";
  EXPECT_NE(plugin_->prepareUsing(*another, board), nullptr) << "those of the image on the board";
}

TEST(ViewLinksOptions, nameASectionThatIsThere) {
  mapper::PluginContext context;
  context.section = "view_links";
  context.config_text = "[view_links]\nclass = ViewLinksPlugin\nodometry = nothing\n";
  const auto config = base::Config::fromText(context.config_text, "test.ini");
  try {
    Factory().make(config.section("view_links"), context);
    FAIL() << "a section that is not there was taken";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("[nothing]"), std::string::npos) << error.what();
  }
}

TEST(ViewLinksOptions, nameAnOdometryOfACamera) {
  mapper::PluginContext context;
  context.section = "view_links";
  context.config_text = "[view_links]\nodometry = wheels\n[wheels]\nclass = OdometryPlugin\n";
  const auto config = base::Config::fromText(context.config_text, "test.ini");
  EXPECT_THROW(Factory().make(config.section("view_links"), context), base::Error);
}

TEST(ViewLinksOptions, takeDefaultsBesideAnotherOdometry) {
  mapper::PluginContext context;
  context.section = "view_links";
  context.config_text =
      "[view_links]\nclass = ViewLinksPlugin\n[visual_odometry]\nclass = CloudOdometryPlugin\nsource = voxels\n";
  const auto config = base::Config::fromText(context.config_text, "test.ini");
  EXPECT_NE(Factory().make(config.section("view_links"), context), nullptr);
}

}  // namespace
}  // namespace omnimapper::plugins::view_links_plugin_test
