// How many of a map's loop closures are right, by a reference trajectory. Prints precision and recall as Markdown.
//
// A closure is right if its measurement is within 0.25 m and 3 deg of the reference's motion. That is the motion
// between the reference poses that are nearest in time, composed with the map's own motion from there to the key frames
// (at most 3 m). A key frame could have closed a loop if the reference was within 2 m and 45 deg of its pose at least 8
// m of travel before. The recall is the share of these key frames that have an accepted closure to an earlier one.
//
// Example: omnimapper-graphslam -i ini/laser2d.ini -r aces.rawlog -o out/aces
//          bench-closures --map out/aces --reference aces.reference.tum --list
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <set>

namespace {

using namespace omnimapper;
using geometry::Se3;

constexpr double kRightDistance = 0.25, kRightAngle = 3 * geometry::kPi / 180;       // [m] [rad]
constexpr double kNearDistance = 2, kNearAngle = geometry::kPi / 4, kMinTravel = 8;  // [m] [rad] [m]

double turnOf(const Se3& motion) {
  return std::abs(geometry::project(motion).yaw);
}

// Poses of the base at the stamps of key frames, by the reference.
class Reference {
 public:
  Reference(const std::string& path, const eval::Trajectory& mapped) : poses_(eval::readTum(path)), mapped_(mapped) {}

  std::optional<Se3> at(base::Stamp stamp) const {
    const auto near = eval::nearestPose(poses_, stamp, base::durationFromSeconds(30));
    if (!near) return std::nullopt;
    const auto own = eval::interpolatedPose(mapped_, stamp, base::durationFromSeconds(5)),
               own_near = eval::interpolatedPose(mapped_, poses_[*near].stamp, base::durationFromSeconds(5));
    if (!own || !own_near) return std::nullopt;
    const Se3 near_from_here = inverse(*own_near) * *own;
    constexpr double kLocal = 3;  // [m] largest motion of the map that is trusted
    if (near_from_here.translation.norm() > kLocal) return std::nullopt;
    return poses_[*near].world_from_body * near_from_here;
  }

 private:
  eval::Trajectory poses_;
  const eval::Trajectory& mapped_;
};

struct Counts {
  int accepted = 0, right = 0, refused = 0, refused_right = 0, unknown = 0;
};

void print(const graph::FactorRecord& record, const map::KeyFrame& a, const map::KeyFrame& b, const Se3& error) {
  std::printf("%s %s -> %s, %.2f m %.1f deg from the reference, sigma %.3f m\n",
              record.weight > 0 ? "accepted" : "refused", toString(b.id).c_str(), toString(a.id).c_str(),
              error.translation.norm(), turnOf(error) * 180 / geometry::kPi,
              1 / std::sqrt(record.noise.information().diagonal().minCoeff()));
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder, reference_path;
  bool list = false;
  CLI::App app{"Prints precision and recall of a map's loop closures."};
  app.add_option("--map", folder, "folder of the map")->required();
  app.add_option("--reference", reference_path, "reference trajectory, TUM format")->required();
  app.add_flag("--list", list, "list every wrong closure that was accepted and every right one that was refused");
  CLI11_PARSE(app, argc, argv);

  omnimapper::mapper::loadFeatures();
  const auto saved = derived::readMap(folder, mapper::registeredKinds());
  const auto mapped = eval::readTum(folder + "/trajectory.tum");
  const Reference reference(reference_path, mapped);
  std::map<base::VariableId, const map::KeyFrame*> frames;
  for (const auto& frame : saved.map.key_frames) frames[frame.pose] = &frame;

  Counts counts;
  std::set<base::KeyFrameId> closed;
  for (const auto& [id, record] : saved.graph.factors()) {
    const auto* between = dynamic_cast<const graph::BetweenSe2*>(record.factor.get());
    if (!record.tags.hypothesis || !between) continue;
    const auto &a = *frames.at(record.variables[0]), &b = *frames.at(record.variables[1]);
    const auto at_a = reference.at(a.stamp), at_b = reference.at(b.stamp);
    if (record.weight > 0) closed.insert(b.id);
    if (!at_a || !at_b) {
      ++counts.unknown;
      continue;
    }
    const Se3 error = inverse(inverse(*at_a) * *at_b) * geometry::lift(between->measured());
    const bool right = error.translation.norm() <= kRightDistance && turnOf(error) <= kRightAngle;
    (record.weight > 0 ? counts.accepted : counts.refused) += 1;
    (record.weight > 0 ? counts.right : counts.refused_right) += right;
    if (list && right != (record.weight > 0)) print(record, a, b, error);
  }

  int could = 0, did = 0;
  std::vector<std::pair<double, Se3>> visited;  // distance travelled [m], pose
  double travel = 0;
  const map::KeyFrame* before = nullptr;
  for (const auto& frame : saved.map.key_frames) {
    if (before) travel += (frame.map_from_base - before->map_from_base).translation().norm();
    before = &frame;
    const auto here = reference.at(frame.stamp);
    if (!here) continue;
    bool near = false;
    for (const auto& [then, place] : visited) {
      if (travel - then < kMinTravel) break;
      const Se3 motion = inverse(place) * *here;
      near = near || (motion.translation.norm() < kNearDistance && turnOf(motion) < kNearAngle);
    }
    visited.emplace_back(travel, *here);
    could += near;
    did += near && closed.count(frame.id) > 0;
  }
  std::printf(
      "| accepted | right | precision | refused by the test | of these right | not judged | recall |\n"
      "|---|---|---|---|---|---|---|\n| %d | %d | %.1f %% | %d | %d | %d | %d of %d key frames, %.0f %% |\n",
      counts.accepted, counts.right, 100.0 * counts.right / std::max(1, counts.accepted), counts.refused,
      counts.refused_right, counts.unknown, did, could, 100.0 * did / std::max(1, could));
  return 0;
}
