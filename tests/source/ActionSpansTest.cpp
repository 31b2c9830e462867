#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/random/RandomGenerators.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

#include <cmath>

namespace omnimapper::source::action_spans_test {
namespace {

using namespace logs;
using Strings = std::vector<std::string>;

constexpr double kQuarter = 1.57079632679489662;

class ActionSpansTest : public ::testing::Test {
 protected:
  // "begin-end" in seconds of each motion, and the motions themselves in motions_.
  Strings spansOf(const std::string& bytes, ActionSpan mode) {
    SourceOptions options;
    options.action_span = mode;
    RawlogSource source(writeGzip(folder_ / "x.rawlog", bytes), options);
    motions_ = motionsOf(all_ = readAll(source));
    report_ = source.report();
    Strings spans;
    for (const auto& motion : motions_) {
      const auto seconds = [](base::Stamp stamp) {
        char text[40];
        std::snprintf(text, sizeof text, "%g", base::isValid(stamp) ? base::secondsBetween(at(1), stamp) + 1 : 0.0);
        return std::string(text);
      };
      spans.push_back(seconds(motion->begin) + "-" + seconds(motion->timestamp));
    }
    return spans;
  }

  testing::ScratchFolder folder_;
  Observations all_;
  std::vector<obs::CObservationRelativeMotion::Ptr> motions_;
  SourceReport report_;
};

std::string stamped() {
  return Bytes().frame({scan(1)}).action(1, 0, 0, 1.4).frame({scan(2)}).action(2, 0, 0, 2.4).frame({scan(3)}).string();
}

std::string unstamped() {
  return Bytes().frame({scan(1)}).action(1, 0, 0).frame({scan(2)}).action(2, 0, 0).frame({scan(3)}).string();
}

TEST_F(ActionSpansTest, framesSpanFromFrameToFrame) {
  EXPECT_EQ(spansOf(stamped(), ActionSpan::frames), (Strings{"1-2", "2-3"}));
  EXPECT_EQ(motions_[1]->begin_from_end.x(), 2);
}

TEST_F(ActionSpansTest, ownSpansFromTheFirstFrameThenFromActionToAction) {
  EXPECT_EQ(spansOf(stamped(), ActionSpan::own), (Strings{"1-1.4", "1.4-2.4"}));
  EXPECT_EQ(listing(all_), (Strings{"laser 1", "odometry 1.4", "laser 2", "odometry 2.4", "laser 3"}));
}

TEST_F(ActionSpansTest, automaticIsOwnForActionsWithStampsElseFrames) {
  EXPECT_EQ(spansOf(stamped(), ActionSpan::automatic), (Strings{"1-1.4", "1.4-2.4"}));
  EXPECT_EQ(spansOf(unstamped(), ActionSpan::automatic), (Strings{"1-2", "2-3"}));
}

TEST_F(ActionSpansTest, actionBeforeTheFirstFrameSpansNothingAndIsCounted) {
  const auto log = Bytes().action(9, 0, 0).frame({scan(1)}).action(1, 0, 0).frame({scan(2)}).action(5, 0, 0).string();
  EXPECT_EQ(spansOf(log, ActionSpan::frames), (Strings{"1-2"}));
  EXPECT_EQ(motions_[0]->begin_from_end.x(), 1);
  EXPECT_EQ(report_.dropped_actions, 2u) << "one before the first frame, one after the last";
}

TEST_F(ActionSpansTest, ownActionFromBeforeTheFirstFrameOnlySetsTheStart) {
  const auto log = Bytes().frame({scan(1)}).action(9, 0, 0, 0.9).frame({scan(2)}).action(1, 0, 0, 1.9).string();
  EXPECT_EQ(spansOf(log, ActionSpan::own), (Strings{"0.9-1.9"}));
  EXPECT_EQ(motions_[0]->begin_from_end.x(), 1);
  EXPECT_EQ(report_.dropped_actions, 1u);
}

TEST_F(ActionSpansTest, spansLeaveNoGapWhereFramesFollowEachOther) {
  const auto log = Bytes()
                       .frame({scan(1)})
                       .action(1, 0, 0)
                       .frame({scan(2)})
                       .frame({scan(3)})
                       .action(2, 0, 0)
                       .frame({scan(4)})
                       .string();
  EXPECT_EQ(spansOf(log, ActionSpan::frames), (Strings{"1-2", "2-4"}));
}

TEST_F(ActionSpansTest, twoActionsBetweenTwoFramesAreJoined) {
  // One metre ahead with a quarter turn, then one metre ahead: one metre ahead and one to the left.
  const auto log = Bytes().frame({scan(1)}).action(1, 0, kQuarter).action(1, 0, 0).frame({scan(2)}).string();
  EXPECT_EQ(spansOf(log, ActionSpan::frames), (Strings{"1-2"}));
  const auto& pose = motions_[0]->begin_from_end;
  EXPECT_NEAR(pose.x(), 1, 1e-12);
  EXPECT_NEAR(pose.y(), 1, 1e-12);
  EXPECT_NEAR(pose.yaw(), kQuarter, 1e-12);
  // A turn error of the first part moves the end sideways: variance of y is at least that times the distance squared.
  const auto& cov = motions_[0]->covariance;
  const double first_yaw_variance = std::pow(mrpt::DEG2RAD(0.2) + mrpt::DEG2RAD(1.0) + 0.05 * kQuarter, 2);
  EXPECT_GT(cov(1, 1), first_yaw_variance);
  EXPECT_GT(cov(5, 5), first_yaw_variance);
  EXPECT_EQ(cov(2, 2), 0);
}

TEST_F(ActionSpansTest, motionToAFrameWithoutStampIsJoinedToTheNext) {
  const auto log = Bytes().frame({scan(1)}).action(1, 0, 0).frame({scan(0)}).action(2, 0, 0).frame({scan(3)}).string();
  EXPECT_EQ(spansOf(log, ActionSpan::frames), (Strings{"1-3"}));
  EXPECT_EQ(motions_[0]->begin_from_end.x(), 3);
  EXPECT_EQ(report_.zeroStamps(), 1u);
}

TEST_F(ActionSpansTest, frameWithoutStampTakesItsActionsAndGivesItToItsObservations) {
  const auto log =
      Bytes().frame({scan(1)}).action(1, 0, 0, 1.9).frame({scan(0)}).action(1, 0, 0, 2.9).frame({scan(3)}).string();
  EXPECT_EQ(spansOf(log, ActionSpan::frames), (Strings{"1-1.9", "1.9-3"}));
  EXPECT_EQ(listing(all_), (Strings{"laser 1", "odometry 1.9", "laser 1.9", "odometry 3", "laser 3"}));
  EXPECT_EQ(report_.repaired_stamps, 1u);
  EXPECT_EQ(report_.zeroStamps(), 0u);
}

TEST_F(ActionSpansTest, observationWithoutStampTakesTheLatestOfItsFrame) {
  EXPECT_TRUE(spansOf(Bytes().frame({scan(1), scan(0, "b"), scan(1.5, "c")}).string(), ActionSpan::frames).empty());
  EXPECT_EQ(listing(all_), (Strings{"laser 1", "b 1.5", "c 1.5"}));
}

TEST_F(ActionSpansTest, logWithoutAnyStampIsHandedOutAsItIs) {
  const auto log = Bytes().frame({scan(0)}).action(1, 0, 0).frame({scan(0)}).action(2, 0, 0).frame({scan(0)}).string();
  EXPECT_EQ(spansOf(log, ActionSpan::automatic), (Strings{"0-0", "0-0"}));
  EXPECT_EQ(motions_[1]->begin_from_end.x(), 2);
  EXPECT_EQ(report_.zeroStamps(), 5u);
}

TEST_F(ActionSpansTest, backwardFrameStampsMakeNoBackwardSpan) {
  const auto log = Bytes().frame({scan(2)}).action(1, 0, 0).frame({scan(1)}).action(2, 0, 0).frame({scan(3)}).string();
  EXPECT_EQ(spansOf(log, ActionSpan::frames), (Strings{"2-3"}));
  EXPECT_EQ(motions_[0]->begin_from_end.x(), 3);
}

TEST_F(ActionSpansTest, planarCovarianceIsTurnedIntoTheMovedFrame) {
  // MRPT's covariance is in the axes of the start. After a quarter turn, the start's x is the end's -y.
  mrpt::obs::CActionRobotMovement2D action;
  action.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  auto pdf = mrpt::poses::CPosePDFGaussian::Create();
  pdf->mean = mrpt::poses::CPose2D(1, 0, kQuarter);
  pdf->cov.setZero();
  pdf->cov(0, 0) = 0.04;
  pdf->cov(1, 1) = 0.01;
  pdf->cov(2, 2) = 0.0009;
  action.poseChange = pdf;
  mrpt::obs::CActionCollection actions;
  actions.insert(action);
  const auto log =
      Bytes().frame({scan(1)}).string() + (Bytes() << actions).string() + Bytes().frame({scan(2)}).string();
  spansOf(log, ActionSpan::frames);
  ASSERT_EQ(motions_.size(), 1u);
  EXPECT_EQ(motions_[0]->sensorLabel, "odometry_scan_matching") << "another estimate of the motion has its own label";
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  expected.diagonal() << 0.01, 0.04, 0, 0, 0, 0.0009;
  EXPECT_LT((motions_[0]->covariance - expected).norm(), 1e-12);
}

TEST_F(ActionSpansTest, spatialActionKeepsItsGaussian) {
  mrpt::obs::CActionRobotMovement3D action;
  action.estimationMethod = mrpt::obs::CActionRobotMovement3D::emVisualOdometry;
  action.poseChange.mean = mrpt::poses::CPose3D(0.1, 0.2, 0.3, 0.4, 0.5, 0.6);
  action.poseChange.cov.setDiagonal(6, 0.01);
  mrpt::obs::CActionCollection actions;
  actions.insert(action);
  const auto log =
      Bytes().frame({scan(1)}).string() + (Bytes() << actions).string() + Bytes().frame({scan(2)}).string();
  spansOf(log, ActionSpan::frames);
  ASSERT_EQ(motions_.size(), 1u);
  EXPECT_EQ(motions_[0]->sensorLabel, "odometry_visual");
  EXPECT_LT((motions_[0]->covariance - geometry::fromMrpt(action.poseChange).cov).norm(), 1e-12);
  EXPECT_LT(
      (motions_[0]->begin_from_end.asVectorVal().asEigen() - action.poseChange.mean.asVectorVal().asEigen()).norm(),
      1e-12);
}

// MRPT samples the particles of Thrun's model anew at each reading; the motion that is handed out must not depend on
// them.
TEST_F(ActionSpansTest, thrunsModelGivesTheSameBitsAtEachReadingAndTheCovarianceOfItsParticles) {
  mrpt::obs::CActionRobotMovement2D action;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmThrun;
  model.thrunModel.nParticlesCount = 20000;
  model.thrunModel.alfa3_trans_trans = 0.05f;
  mrpt::random::getRandomGenerator().randomize(5);
  action.computeFromOdometry(mrpt::poses::CPose2D(1.0, 0.4, 0.3), model);
  mrpt::obs::CActionCollection actions;
  actions.insert(action);
  const auto log =
      Bytes().frame({scan(1)}).string() + (Bytes() << actions).string() + Bytes().frame({scan(2)}).string();
  spansOf(log, ActionSpan::frames);
  const auto first = (Bytes() << motions_.at(0)).string();
  const Eigen::Matrix<double, 6, 6> covariance = motions_[0]->covariance;
  spansOf(log, ActionSpan::frames);
  EXPECT_EQ((Bytes() << motions_.at(0)).string(), first);
  EXPECT_EQ(motions_[0]->begin_from_end.x(), 1.0);

  // The sample covariance of MRPT's particles, in the axes of the start.
  const auto& particles = dynamic_cast<const mrpt::poses::CPosePDFParticles&>(*action.poseChange).m_particles;
  Eigen::MatrixXd sample(3, static_cast<Eigen::Index>(particles.size()));
  for (std::size_t i = 0; i < particles.size(); ++i)
    sample.col(static_cast<Eigen::Index>(i)) << particles[i].d.x, particles[i].d.y, particles[i].d.phi;
  sample.colwise() -= sample.rowwise().mean().eval();
  const Eigen::Matrix3d sample_covariance = sample * sample.transpose() / static_cast<double>(particles.size());
  const Eigen::Matrix3d sampled = geometry::covarianceFromMrpt(mrpt::poses::CPose2D(1.0, 0.4, 0.3), sample_covariance);
  const Eigen::Matrix3d ours = geometry::planarPart(covariance);
  EXPECT_LT((ours - sampled).norm(), 0.03 * sampled.norm()) << ours << "\nsampled\n" << sampled;
}

}  // namespace
}  // namespace omnimapper::source::action_spans_test
