#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/RelationError.h>
#include <omnimapper/source/openLogs.h>

#include <Eigen/Core>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::bench {

using mrpt::math::TPose2D;
constexpr double kDegree = 3.14159265358979323846 / 180;

struct RecordedScan {
  std::vector<float> ranges;            ///< [m] of 180 beams from -90 to +89 deg; 0 if there was no echo
  std::vector<Eigen::Vector2f> points;  ///< [m] end points of the valid beams, in the order of the beams
  TPose2D odometry;
};

/// Two scans and the pose of the second in the first: as predicted by odometry, and as checked by hand.
struct ScanPair {
  const RecordedScan* reference;
  const RecordedScan* scan;
  TPose2D guess, truth;
};

/// One match to be computed: a pair and the start pose.
struct Task {
  std::size_t pair;
  TPose2D start;
};

struct Outcome {
  TPose2D pose;
  double milliseconds = 0;
};

inline double distance(const TPose2D& a, const TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}
inline double turn(const TPose2D& a, const TPose2D& b) {
  return std::abs(std::remainder(a.phi - b.phi, 360 * kDegree));
}
inline bool right(const TPose2D& found, const TPose2D& truth) {
  return distance(found, truth) < 0.1 && turn(found, truth) < 2 * kDegree;
}

/// The scans of a log that have this label, by stamp.
inline std::map<base::Stamp, RecordedScan> readScans(const std::string& path, const std::string& label) {
  const auto log = source::openLogs({path}, {});
  std::map<base::Stamp, RecordedScan> scans;
  TPose2D odometry;
  while (const auto observation = log->next()) {
    if (const auto* o = dynamic_cast<const mrpt::obs::CObservationOdometry*>(observation.get())) {
      odometry = o->odometry.asTPose();
      continue;
    }
    const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(observation.get());
    if (!scan || scan->sensorLabel != label) continue;
    RecordedScan recorded;
    recorded.odometry = odometry;
    for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
      const bool valid = scan->getScanRangeValidity(i) && scan->getScanRange(i) < 50;
      const float range = valid ? scan->getScanRange(i) : 0;
      const double angle = (static_cast<double>(i) - 90) * kDegree;
      recorded.ranges.push_back(range);
      if (valid) recorded.points.emplace_back(range * std::cos(angle), range * std::sin(angle));
    }
    scans.emplace(scan->timestamp, std::move(recorded));
  }
  return scans;
}

/// The pairs of relations whose scans overlap well: less than 1 m and 34 degrees apart.
inline std::vector<ScanPair> pairsOf(const std::map<base::Stamp, RecordedScan>& scans,
                                     const std::vector<eval::Relation>& relations) {
  std::vector<ScanPair> pairs;
  for (const auto& relation : relations) {
    const auto from = scans.find(relation.from), to = scans.find(relation.to);
    if (from == scans.end() || to == scans.end()) continue;
    const auto& motion = relation.from_from_to;
    const Eigen::Matrix3d rotation = motion.rotation.toRotationMatrix();
    const TPose2D truth(motion.translation.x(), motion.translation.y(), std::atan2(rotation(1, 0), rotation(0, 0)));
    if (std::hypot(truth.x, truth.y) >= 1 || std::abs(truth.phi) >= 34 * kDegree) continue;
    pairs.push_back({&from->second, &to->second, to->second.odometry - from->second.odometry, truth});
  }
  return pairs;
}

/// Writes a file for external programs: "pairs N", then two lines with the ranges of reference and scan for each pair;
/// "tasks M", then a line "pair x y yaw" for each task. The program answers with a file that has a line "x y yaw ms"
/// for each task, in order.
inline void writeTasks(const std::string& path, const std::vector<ScanPair>& pairs, const std::vector<Task>& tasks) {
  std::ofstream out(path);
  out.precision(9);
  out << "pairs " << pairs.size() << "\n";
  for (const auto& pair : pairs) {
    for (const auto* scan : {pair.reference, pair.scan}) {
      for (const float range : scan->ranges) out << range << " ";
      out << "\n";
    }
  }
  out << "tasks " << tasks.size() << "\n";
  for (const auto& t : tasks) out << t.pair << " " << t.start.x << " " << t.start.y << " " << t.start.phi << "\n";
}

inline std::vector<Outcome> readOutcomes(const std::string& path, std::size_t count) {
  std::ifstream in(path);
  std::vector<Outcome> outcomes(count);
  for (auto& o : outcomes) in >> o.pose.x >> o.pose.y >> o.pose.phi >> o.milliseconds;
  if (!in)
    throw base::Error(base::ExitCode::unreadable_input, path + ": does not have a line 'x y yaw ms' for each task");
  return outcomes;
}

}  // namespace omnimapper::bench
