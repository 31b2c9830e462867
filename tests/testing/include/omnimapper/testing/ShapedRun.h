#pragma once

#include <omnimapper/map/Landmark.h>
#include <omnimapper/testing/BoxWorld.h>

#include <limits>

/// The box world with landmarks whose payload only this test knows.
namespace shaped_run {

using namespace box_world;
using Eigen::Vector3d;

struct TestPayload : map::LandmarkPayload {
  explicit TestPayload(map::LandmarkShape its_shape) : kept(std::move(its_shape)) {}
  std::string_view kind() const override { return "test"; }
  void write(std::ostream&) const override {}
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>&, const map::KeyFrames&) const override { return kept; }
  map::LandmarkShape kept;
};

/// An upright wall of 4 x 2 m along y = 2, seen by both sensors; its free side faces the room.
inline map::LandmarkShape wall() {
  map::LandmarkShape shape;
  shape.label = "wall";
  shape.surfaces = {{{{-1, 2, 0}, {3, 2, 0}, {3, 2, 2}, {-1, 2, 2}}}};
  shape.normal = Vector3d(0, -1, 0);
  shape.properties = {{"area", map::Measure{8, "m2"}}};
  shape.seen_by = {{"kinect", 3}, {"laser", 9}};
  return shape;
}

/// A wall along x = 3 that only the laser saw.
inline map::LandmarkShape line() {
  map::LandmarkShape shape;
  shape.label = "wall";
  shape.lines = {{{3, -1, 0.3}, {3, 2, 0.3}}};
  shape.normal = Vector3d(-1, 0, 0);
  shape.properties = {{"length", map::Measure{3, "m"}}};
  shape.seen_by = {{"laser", 5}};
  return shape;
}

/// A concave table top of 0.75 m^2 at 0.7 m, its corners clockwise as seen from above.
inline map::LandmarkShape table() {
  map::LandmarkShape shape;
  shape.label = "table";
  shape.surfaces = {
      {{{0, -0.9, 0.7}, {0, 0.1, 0.7}, {0.5, 0.1, 0.7}, {0.5, -0.4, 0.7}, {1, -0.4, 0.7}, {1, -0.9, 0.7}}}};
  shape.normal = Vector3d(0, 0, 1);
  shape.properties = {{"area", map::Measure{0.75, "m2"}}, {"top", "oak <old>"}};
  shape.seen_by = {{"kinect", 4}};
  return shape;
}

inline map::LandmarkShape floor() {
  map::LandmarkShape shape;
  shape.label = "floor";
  shape.surfaces = {{{{-1, -1, 0}, {3, -1, 0}, {3, 2, 0}, {-1, 2, 0}}}};
  shape.normal = Vector3d(0, 0, 1);
  return shape;
}

/// A chair that was in two places.
inline map::LandmarkShape movedChair() {
  map::LandmarkShape shape;
  shape.label = "chair";
  shape.points = {{2.5, 0, 0.4}, {2.5, 0.8, 0.4}};
  shape.point_stamps = {at(0), at(2)};
  return shape;
}

inline base::LandmarkId add(RunRecord& run, const std::string& kind, map::LandmarkShape shape,
                            map::Landmark::State state = map::Landmark::State::active) {
  map::Landmark landmark;
  landmark.id = run.map.landmarks.nextId(0);
  landmark.kind = kind;
  landmark.owner = "test";
  landmark.payload = std::make_shared<TestPayload>(std::move(shape));
  landmark.evidence = 10 + landmark.id.index;
  landmark.first_seen = at(0);
  landmark.last_seen = at(2);
  landmark.state = state;
  return run.map.landmarks.add(0, landmark);
}

/// wall 0:0, line 0:1, table 0:2, floor 0:3, the chair 0:4, which has moved, and 0:5, which was merged.
inline RunRecord shapedRun() {
  RunRecord run = boxRun();
  run.map.sessions.push_back({0, "box <world>", {}});
  add(run, "plane", wall());
  add(run, "plane", line());
  add(run, "plane", table());
  add(run, "plane", floor());
  add(run, "object", movedChair(), map::Landmark::State::retired);
  add(run, "plane", wall(), map::Landmark::State::merged);
  return run;
}

}  // namespace shaped_run
