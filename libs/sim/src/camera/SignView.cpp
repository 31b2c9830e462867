#include <omnimapper/sim/SignView.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "FaceView.h"

namespace omnimapper::sim {

namespace {

constexpr double kVisitGap = 30;  // [s]

// Height in the picture of an upright length in the middle of a sign [pixel].
double heightInPicture(const CameraView& view, const geometry::Se3& map_from_sign, double length) {
  const geometry::Se3 optical_from_sign = geometry::inverse(view.map_from_optical) * map_from_sign;
  const auto top = view.camera.project(optical_from_sign * Eigen::Vector3d(0, length / 2, 0)),
             bottom = view.camera.project(optical_from_sign * Eigen::Vector3d(0, -length / 2, 0));
  return top && bottom ? (*top - *bottom).norm() : 0;
}

int count(const std::vector<SignReadings>& readings, int SignReadings::*of, int at_least) {
  return static_cast<int>(
      std::count_if(readings.begin(), readings.end(), [&](const SignReadings& r) { return r.*of >= at_least; }));
}

}  // namespace

std::vector<SignView> signsInView(const World& world, const Scenes& scenes, const Scene& scene,
                                  const CameraView& view) {
  std::vector<SignView> views;
  if (world.signs.empty()) return views;
  const auto bodies = bodiesByName(world);
  for (std::size_t i = 0; i < world.signs.size(); ++i) {
    const Sign& sign = world.signs[i];
    const BodyAt& at = bodies.at(sign.name);
    const auto face =
        viewOf({scenes, scene, view}, {sign.map_from_sign, sign.width, sign.height, at.first_surface, at.past});
    if (!face) continue;
    SignView sign_view{*face};
    sign_view.sign = static_cast<int>(i);
    if (!sign.capitals.empty()) {
      sign_view.capitals = heightInPicture(view, sign.map_from_sign, sign.capitals.front());
      sign_view.least_capitals =
          heightInPicture(view, sign.map_from_sign, *std::min_element(sign.capitals.begin(), sign.capitals.end()));
    }
    views.push_back(sign_view);
  }
  return views;
}

bool isLegible(const SignView& view, const Legibility& legibility) {
  return view.is_whole && view.capitals >= legibility.capitals && view.incidence <= legibility.incidence &&
         view.visible >= legibility.visible;
}

void SignCounter::add(double time, const std::vector<SignView>& signs) {
  for (const SignView& view : signs) {
    if (!isLegible(view)) continue;
    SignReadings& reading = readings_[static_cast<std::size_t>(view.sign)];
    double& last = last_[static_cast<std::size_t>(view.sign)];
    if (reading.pictures++ == 0 || time - last > kVisitGap) ++reading.visits;
    last = time;
  }
}

int SignCounter::pictures() const {
  return std::accumulate(readings_.begin(), readings_.end(), 0,
                         [](int sum, const SignReadings& reading) { return sum + reading.pictures; });
}

int SignCounter::inPictures(int at_least) const {
  return count(readings_, &SignReadings::pictures, at_least);
}

int SignCounter::onVisits(int at_least) const {
  return count(readings_, &SignReadings::visits, at_least);
}

}  // namespace omnimapper::sim
