#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/plugin/SessionStart.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "SurfaceRun.h"
#include "planes/SessionByPlanes.h"

namespace omnimapper::plugins::session_by_planes_test {
namespace {

using namespace surface_run;
using geometry::Se3;

/// Half-axes a and b of a rectangle about `middle`; a x b points to the free side.
struct Rectangle {
  Vector3d middle, a, b;
};

// A room of 6 x 4 x 2.5 m about the origin, seen from inside; nothing in it.
std::vector<Rectangle> emptyRoom() {
  return {{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}},
          {{3, 0, 1.25}, {0, -2, 0}, {0, 0, 1.25}},
          {{-3, 0, 1.25}, {0, 2, 0}, {0, 0, 1.25}},
          {{0, 2, 1.25}, {3, 0, 0}, {0, 0, 1.25}},
          {{0, -2, 1.25}, {-3, 0, 0}, {0, 0, 1.25}}};
}

// The same with a corner cut off by a slanted wall. It is convex, so that nothing hides anything.
std::vector<Rectangle> room() {
  return {{{-0.75, 0, 0}, {2.25, 0, 0}, {0, 2, 0}},  {{2.25, -1, 0}, {0.75, 0, 0}, {0, 1, 0}},
          {{3, -1, 1.25}, {0, -1, 0}, {0, 0, 1.25}}, {{2.25, 1, 1.25}, {0.75, -1, 0}, {0, 0, 1.25}},
          {{-3, 0, 1.25}, {0, 2, 0}, {0, 0, 1.25}},  {{-0.75, 2, 1.25}, {2.25, 0, 0}, {0, 0, 1.25}},
          {{0, -2, 1.25}, {-3, 0, 0}, {0, 0, 1.25}}};
}

std::vector<obs::ObservedPlane> seen(const std::vector<Rectangle>& room, const Se3& sensor_from_map) {
  std::vector<obs::ObservedPlane> planes;
  for (const auto& part : room)
    planes.push_back(
        plane(sensor_from_map * part.middle, sensor_from_map.rotation * part.a, sensor_from_map.rotation * part.b));
  return planes;
}

class SessionPlanes : public SurfaceRun {
 protected:
  // A map of what is seen from its origin at eye height, and the beginning of a second session that may be anywhere.
  void mapOf(const std::vector<Rectangle>& room) {
    run_.motion = mapper::Motion::spatial;
    make({});
    driveTo(kFirst);
    for (int i = 0; i < 3; ++i) see(planesOf(seen(room, inverse(geometry::fromMrpt(kFirst)))));
    run_.map.sessions = {{0, "first", {}, true}, {1, "second", {}, false}};
    run_.graph.setSession(1);
  }
  // Sees the room from several places along a path, which begins at the origin of the session.
  void goOn(const std::vector<Rectangle>& room, const Se3& map_from_session) {
    for (const double x : {0.0, 0.7, 1.4, 1.5, 1.6, 1.7, 1.8}) {
      const CPose3D session_from_base(x, 0, 0, 0.8 * x, 0, 0);
      addAnywhere(session_from_base);
      see(planesOf(seen(room, inverse(map_from_session * geometry::fromMrpt(session_from_base)))));
    }
  }
  // A key frame whose place in the map is unknown, while its place in the session is known.
  void addAnywhere(const CPose3D& session_from_base) {
    const bool is_first = run_.map.key_frames.back().id.session == 0;
    const map::KeyFrame before = run_.map.key_frames.back();
    const map::KeyFrame& frame = run_.addFrame(session_from_base);
    if (is_first) {
      run_.map.sessions[1].anchor = frame.pose;
      run_.graph.addFactor(mapper::startFactor(run_.motion, frame.pose, mapper::startAnywhere(run_.map)));
    } else {
      link(before, frame, 1e-6);
    }
    run_.uncertainty = mapper::Uncertainty(run_.graph);
  }
  bool isSaid(const std::string& reason) const {
    return std::any_of(run_.decisions.begin(), run_.decisions.end(),
                       [&](const mapper::Decision& decision) { return decision.reason == reason; });
  }

  std::optional<mapper::SessionPlace> place_;
  void see(const mrpt::obs::CObservation& observation) {
    const auto batch = plugin_->measure(run_.map.key_frames.back(), {observation, nullptr}, run_.view());
    if (batch.sessionPlace()) place_ = batch.sessionPlace();
    for (const auto& decision : batch.decisions()) run_.decisions.push_back(decision);
    if (run_.map.key_frames.back().id.session == 0) SurfaceRun::apply(batch);
  }

  const CPose3D kFirst{0, 0, 1.2, 0, 0, 0};
  // Turned by 140 deg and tilted, because a hand-held camera does not know how it is held when it starts.
  const Se3 kSession{
      Eigen::Quaterniond(Eigen::AngleAxisd(2.4, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.2, Vector3d::UnitX())),
      {0.5, -0.8, 1.4}};
};

TEST_F(SessionPlanes, AreFoundInTheMapWhateverTheStart) {
  mapOf(room());
  goOn(room(), kSession);
  ASSERT_TRUE(place_);
  const auto& frame = run_.map.keyFrame(place_->frame);
  const auto error = geometry::minus(geometry::fromMrpt(place_->start.map_from_base),
                                     kSession * geometry::fromMrpt(frame.map_from_base));
  EXPECT_LT(error.head<3>().norm(), 0.03);
  EXPECT_LT(error.tail<3>().norm(), 0.02);
}

// An empty room fits itself when it is turned by 180 deg.
TEST_F(SessionPlanes, OfAnEmptyRoomFitTwoPlaces) {
  mapOf(emptyRoom());
  goOn(emptyRoom(), kSession);
  EXPECT_FALSE(place_);
  EXPECT_TRUE(isSaid("the planes that are seen fit more than one place of the map"));
}

TEST_F(SessionPlanes, OfOneWallFitNowhere) {
  mapOf({emptyRoom()[1]});
  goOn({emptyRoom()[1]}, kSession);
  EXPECT_FALSE(place_);
}

// The corner of a room is in every room; the rest shows that it is another one.
TEST_F(SessionPlanes, OfAnotherRoomFitNowhere) {
  mapOf(room());
  std::vector<Rectangle> other = emptyRoom();
  other[0] = {{0.5, 0.5, 0}, {3.5, 0, 0}, {0, 2.5, 0}};
  other[1] = {{4, 0.5, 1.25}, {0, -2.5, 0}, {0, 0, 1.25}};
  other[3] = {{0.5, 3, 1.25}, {3.5, 0, 0}, {0, 0, 1.25}};
  goOn(other, kSession);
  EXPECT_FALSE(place_);
}

TEST_F(SessionPlanes, SeenFromOnePlaceAloneDoNotDecide) {
  mapOf(room());
  for (int i = 0; i < 12; ++i) {
    addAnywhere({0.01 * i, 0, 0, 0, 0, 0});
    see(planesOf(seen(room(), inverse(kSession * geometry::fromMrpt(run_.map.key_frames.back().map_from_base)))));
  }
  EXPECT_FALSE(place_);
}

// Where a session is tied to the wrong place, it sees through walls of the map.
TEST_F(SessionPlanes, ThatContradictTheMapAreNotConfirmed) {
  using Says = mapper::ConfirmsSession::Says;
  mapOf(room());
  EXPECT_EQ(plugin_->aboutSession(), Says::unable);
  run_.map.sessions[1].aligned = true;
  auto large = room();
  for (auto& part : large) part = {1.6 * part.middle, 1.6 * part.a, 1.6 * part.b};
  for (int i = 0; i < 6; ++i) {
    addAnywhere(kFirst);
    see(planesOf(seen(large, inverse(geometry::fromMrpt(kFirst)))));
  }
  EXPECT_EQ(plugin_->aboutSession(), Says::contradicted);
  const auto evidence = plugin_->evidence(run_.view());
  ASSERT_EQ(evidence.size(), 1U);
  EXPECT_EQ(evidence[0].says, mapper::Evidence::Says::against_it);
}

TEST_F(SessionPlanes, ThatAgreeWithTheMapConfirmThePlaceForSomeTime) {
  using Says = mapper::ConfirmsSession::Says;
  mapOf(room());
  run_.map.sessions[1].aligned = true;
  addAnywhere(kFirst);
  see(planesOf(seen(room(), inverse(geometry::fromMrpt(kFirst)))));
  EXPECT_EQ(plugin_->aboutSession(), Says::confirmed);
  EXPECT_EQ(plugin_->evidence(run_.view()).at(0).says, mapper::Evidence::Says::good);
  for (int i = 0; i < 50; ++i) plugin_->afterCommit(run_.map.key_frames.back(), run_.view());
  EXPECT_EQ(plugin_->aboutSession(), Says::nothing);
}

}  // namespace
}  // namespace omnimapper::plugins::session_by_planes_test
