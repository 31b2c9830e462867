#include <omnimapper/base/Error.h>
#include <omnimapper/eval/RelationError.h>

#include <algorithm>

#include "TextColumns.h"

namespace omnimapper::eval {

namespace {
std::vector<double> squared(std::vector<double> values) {
  for (double& value : values) value *= value;
  return values;
}

Eigen::Quaterniond fromRollPitchYaw(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}
}  // namespace

std::vector<Relation> readRelations(const std::string& path) {
  std::vector<Relation> relations;
  forEachLine(path, [&](const TextColumns& line) {
    line.expect(8, "t1 t2 x y z roll pitch yaw");
    const Eigen::Quaterniond rotation = fromRollPitchYaw(line.number(5), line.number(6), line.number(7));
    relations.push_back({line.stamp(0), line.stamp(1), {rotation, {line.number(2), line.number(3), line.number(4)}}});
    return true;
  });
  if (relations.empty())
    throw base::Error(base::ExitCode::unreadable_input,
                      path + ": holds no relation; expected lines t1 t2 x y z roll pitch yaw");
  return relations;
}

RelationError relationError(const Trajectory& estimate, const std::vector<Relation>& relations,
                            const RelationOptions& options) {
  std::vector<Relation> by_end = relations;
  std::stable_sort(by_end.begin(), by_end.end(), [](const auto& a, const auto& b) { return a.to < b.to; });
  RelationError result;
  std::size_t within = 0;
  for (const auto& relation : by_end) {
    const auto from = nearestPose(estimate, relation.from, options.tolerance);
    const auto to = nearestPose(estimate, relation.to, options.tolerance);
    if (!from || !to) {
      ++result.missed;
      continue;
    }
    const geometry::Se3 world_from_from = estimate[*from].world_from_body * options.base_from_sensor;
    const geometry::Se3 world_from_to = estimate[*to].world_from_body * options.base_from_sensor;
    const geometry::Vector6d error = minus(inverse(world_from_from) * world_from_to, relation.from_from_to);
    const double translation = error.head<3>().norm(), rotation = error.tail<3>().norm();
    result.stamps.push_back(relation.to);
    result.translation_errors.push_back(translation);
    result.rotation_errors.push_back(rotation);
    if (translation <= options.translation_threshold && rotation <= options.rotation_threshold) ++within;
  }
  if (result.stamps.empty()) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "the estimate has no pose at the stamps of any of the " + std::to_string(relations.size()) +
                          " relations; are they of the same log, or is the tolerance too small?");
  }
  result.share_within = static_cast<double>(within) / static_cast<double>(result.stamps.size());
  result.translation = statisticsOf(result.translation_errors);
  result.rotation = statisticsOf(result.rotation_errors);
  result.squared_translation = statisticsOf(squared(result.translation_errors));
  result.squared_rotation = statisticsOf(squared(result.rotation_errors));
  return result;
}

}  // namespace omnimapper::eval
