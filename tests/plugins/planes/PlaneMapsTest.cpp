#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/PlacedVariable.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <sstream>

#include "SurfaceRun.h"
#include "planes/PlanePayload.h"

namespace omnimapper::plugins::plane_maps_test {
namespace {

using namespace surface_run;

class PlaneMaps : public SurfaceRun {};

TEST_F(PlaneMaps, GoOnInAMapThatIsContinued) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  make({});
  plugin_->restore(nullptr, run_.view());
  see(planesOf({wallPlane(3, -1, 1)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 2U);
}

TEST_F(PlaneMaps, OneThatIsHeldGetsNoNewLandmarks) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  run_.map_is_held = true;
  see(planesOf({wallPlane(3, -1, 1), tableTop(2, 0, 0.7)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 2U);
  EXPECT_EQ(run_.decisions.back().reason, "not in the map: none is near");
  EXPECT_FALSE(run_.decisions.back().accepted);
}

TEST_F(PlaneMaps, MadeWithWallsAreNotContinuedWithPlanes) {
  PlaneLandmarksOptions walls;
  walls.form = PlaneLandmarksOptions::Form::wall;
  make(walls);
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}));
  make({});
  try {
    plugin_->restore(nullptr, run_.view());
    ADD_FAILURE() << "a map of another form was taken";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    EXPECT_NE(std::string(error.what()).find("[planes] the map has landmarks of form = wall"), std::string::npos)
        << error.what();
  }
}

// The pose of the second session is a guess until a consistency-tested hypothesis ties it to the map.
TEST_F(PlaneMaps, ASessionOfUnknownPlaceIsTiedOnlyByWhatIsTested) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  run_.map.sessions = {{0, "first", {}, true}, {1, "second", {}, false}};
  run_.graph.setSession(1);
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(run_.decisions.back().reason, "waits for the consistency test");
  EXPECT_EQ(active()[0].evidence, 1U);
}

// A wall fits many places. A plugin that distinguishes them ties the session, and then it is the same wall.
TEST_F(PlaneMaps, ASessionThatOthersSeekInTheMapKeepsItsLandmarksToItselfUntilItIsAligned) {
  driveTo({});
  for (int i = 0; i < 3; ++i) see(planesOf({wallPlane(3, -1, 1)}));
  run_.map.sessions = {{0, "first", {}, true}, {1, "second", {}, false}};
  run_.graph.setSession(1);
  driveTo({});
  plugin_->leaveSeeking(true);
  for (int i = 0; i < 3; ++i) see(planesOf({wallPlane(3, -1, 1)}));
  ASSERT_EQ(active().size(), 2U);
  EXPECT_EQ(active()[1].evidence, 3U);
  for (const auto& [id, record] : run_.graph.factors()) EXPECT_FALSE(record.tags.hypothesis);
  run_.map.sessions[1].aligned = true;
  plugin_->leaveSeeking(false);
  commit();
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 6U);
}

// Between two solves only the placing of a session moves its surfaces.
TEST_F(PlaneMaps, AreKnownAgainWhereTheirSessionWasPlaced) {
  driveTo({});
  see(planesOf({wallPlane(3, -1, 1)}));
  const CPose3D moved(10, 5, 0, M_PI / 2, 0, 0);
  const map::KeyFrame& frame = run_.map.key_frames.back();
  run_.graph.setValue(frame.pose, mapper::poseValue(run_.motion, moved));
  run_.map.key_frames.edit(frame.id).map_from_base = moved;
  const auto* kind = dynamic_cast<const graph::PlacedVariable*>(plane_factors::planeVariable().get());
  ASSERT_NE(kind, nullptr);
  const auto variable = active()[0].variables.front();
  Eigen::VectorXd value = run_.graph.value(variable);
  kind->move(geometry::fromMrpt(moved), value.data(), value.data());
  run_.graph.setValue(variable, value);
  run_.uncertainty = mapper::Uncertainty(run_.graph);
  see(planesOf({wallPlane(3, -1, 1)}));
  ASSERT_EQ(active().size(), 1U);
  EXPECT_EQ(active()[0].evidence, 2U);
}

// Two walls may look like one by chance while the relative pose of their sessions is unknown.
TEST_F(PlaneMaps, LandmarksOfSessionsThatAreNotAlignedAreNotMerged) {
  driveTo({});
  for (int i = 0; i < 3; ++i) see(planesOf({wallPlane(3, -1, 1)}));
  run_.map.sessions = {{0, "first", {}, true}, {1, "second", {}, false}};
  run_.graph.setSession(1);
  driveTo({});
  for (int i = 0; i < 3; ++i) see(planesOf({wallPlane(3.4, -1, 1)}));
  ASSERT_EQ(active().size(), 2U);
  run_.graph.setValue(active()[1].variables[0], run_.graph.value(active()[0].variables[0]));
  commit();
  EXPECT_EQ(active().size(), 2U);
  run_.map.sessions[1].aligned = true;
  commit();
  EXPECT_EQ(active().size(), 1U);
}

TEST_F(PlaneMaps, PayloadComesBackFromAFile) {
  driveTo({});
  see(linesOf({line({3, -2}, {3, 2})}));
  see(planesOf({wallPlane(3, -1, 1)}));
  const auto& payload = dynamic_cast<const PlanePayload&>(*active()[0].payload);
  std::ostringstream bytes, again;
  payload.write(bytes);
  map::PayloadRegistry registry;
  PlanePayload::addTo(registry);
  const auto back = registry.read("plane", bytes.str());
  back->write(again);
  EXPECT_EQ(again.str(), bytes.str());
  const std::string future = "\x09" + bytes.str().substr(1);
  EXPECT_THROW(registry.read("plane", future), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::plane_maps_test
