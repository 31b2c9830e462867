#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/TumLine.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "TextColumns.h"

namespace omnimapper::eval {

using base::Error;
using base::ExitCode;

namespace {
constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kGroundTruthColumns = 4;

StampedPose tumPose(const TextColumns& line) {
  line.expect(kTumColumns, "stamp x y z qx qy qz qw");
  const Eigen::Quaterniond q(line.number(7), line.number(4), line.number(5), line.number(6));
  if (std::abs(q.norm() - 1) > 0.01) {
    throw Error(
        ExitCode::unreadable_input,
        line.at +
            "columns 5 to 8 are no unit quaternion qx qy qz qw; for a file of relations use omnimapper-eval relations");
  }
  return {line.stamp(0), {q.normalized(), {line.number(1), line.number(2), line.number(3)}}};
}

StampedPose groundTruthPose(const TextColumns& line) {
  line.expect(kGroundTruthColumns, "stamp x y yaw");
  return {line.stamp(0), geometry::lift({line.number(1), line.number(2), geometry::wrapToPi(line.number(3))})};
}

Trajectory readPoses(const std::string& path, StampedPose (*poseOf)(const TextColumns&)) {
  std::vector<StampedPose> poses;
  std::map<base::Stamp, std::string> places;
  forEachLine(path, [&](const TextColumns& line) {
    poses.push_back(poseOf(line));
    const auto [place, is_new] = places.emplace(poses.back().stamp, line.at);
    if (!is_new) {
      throw Error(ExitCode::unreadable_input,
                  line.at + "the stamp " + line.texts[0] + " is used already at " + place->second +
                      "remove one; if this is the map of two logs of the same time, map and judge each log alone");
    }
    return true;
  });
  if (poses.empty()) throw Error(ExitCode::unreadable_input, path + ": holds no pose");
  return sortedByStamp(std::move(poses), path);
}
}  // namespace

Trajectory readTum(const std::string& path) {
  return readPoses(path, tumPose);
}

Trajectory readMrptGroundTruth(const std::string& path) {
  return readPoses(path, groundTruthPose);
}

Trajectory readTrajectory(const std::string& path) {
  const auto inside = std::filesystem::path(path) / "trajectory.tum";
  if (std::filesystem::exists(inside))
    throw Error(ExitCode::unreadable_input, path + ": is a folder; its trajectory is " + inside.string());
  std::size_t columns = 0;
  forEachLine(path, [&](const TextColumns& line) {
    columns = line.texts.size();
    return false;
  });
  return columns == kGroundTruthColumns ? readMrptGroundTruth(path) : readTum(path);
}

void writeTum(const std::string& path, const Trajectory& trajectory) {
  base::writeFile(path, [&](std::ostream& out) {
    out << "# stamp x y z qx qy qz qw\n";
    for (const auto& [stamp, pose] : trajectory) out << geometry::tumLine(stamp, pose);
  });
}

}  // namespace omnimapper::eval
