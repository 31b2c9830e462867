// MRPT's logs of points that are measured by range and bearing, mapped by our engine and by MRPT's extended Kalman
// filters with the settings that come with them, in the same run: errors of trajectory and landmarks, and time for a
// part of the log and for all of it. Prints a Markdown table.
//
// Example: OPENBLAS_NUM_THREADS=1 bench-kf_slam --runs 3
#include <mrpt/config/CConfigFile.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/slam/CRangeBearingKFSLAM.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/MapperRun.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>

namespace {

using namespace omnimapper;
using Eigen::Vector3d;

const std::string kMrpt = "/usr/share/mrpt/";

struct Log {
  std::string name, filter_ini;
  bool planar;
};
const std::vector<Log> kLogs = {{"kf-slam_demo", "EKF-SLAM_test_2d.ini", true},
                                {"kf-slam_6D_demo", "EKF-SLAM_6D_test.ini", false},
                                {"kf-slam_6D_demo_noncentered", "EKF-SLAM_6D_noncentered_test.ini", false},
                                {"kf-slam_6D_demo_DA", "EKF-SLAM_6D_test_datassoc.ini", false}};

/// Rows of numbers of a text file, without lines that begin with %.
std::vector<std::vector<double>> rowsOf(const std::string& path) {
  std::vector<std::vector<double>> rows;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::vector<double> row((std::istream_iterator<double>(words)), {});
    if (!row.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

/// Positions of trajectory and landmarks by one mapper.
struct Outcome {
  std::map<std::size_t, Vector3d> trajectory;  ///< by number of the observation
  std::vector<Vector3d> landmarks;
  double seconds = 0;
};

struct Errors {
  double trajectory = 0, landmarks = 0;  ///< root mean square errors [m]
};

// Each landmark is compared with the nearest true one. Their numbers are not used, since one of the logs has none.
Errors errorsOf(const Outcome& outcome, const Log& log) {
  const auto true_trajectory = rowsOf(kMrpt + "datasets/" + log.name + "_ground_truth_robot_path.txt");
  const auto landmarks = rowsOf(kMrpt + "datasets/" + log.name + "_ground_truth.txt");
  Errors errors;
  for (const auto& [frame, place] : outcome.trajectory) {
    const auto& row = true_trajectory.at(frame);
    errors.trajectory += (place - Vector3d(row[0], row[1], row[2])).squaredNorm();
  }
  for (const Vector3d& landmark : outcome.landmarks) {
    double nearest = 1e9;
    for (const auto& row : landmarks)
      nearest = std::min(nearest, (landmark - Vector3d(row[0], row[1], row[2])).squaredNorm());
    errors.landmarks += nearest;
  }
  errors.trajectory =
      std::sqrt(errors.trajectory / static_cast<double>(std::max<std::size_t>(1, outcome.trajectory.size())));
  errors.landmarks =
      std::sqrt(errors.landmarks / static_cast<double>(std::max<std::size_t>(1, outcome.landmarks.size())));
  return errors;
}

double since(const std::chrono::steady_clock::time_point& start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Vector3d placeOf(const mrpt::poses::CPosePDFGaussian& pose) {
  return {pose.mean.x(), pose.mean.y(), 0};
}
Vector3d placeOf(const mrpt::poses::CPose3DQuatPDFGaussian& pose) {
  return {pose.mean.x(), pose.mean.y(), pose.mean.z()};
}
Vector3d pointOf(const mrpt::math::TPoint2D& point) {
  return {point.x, point.y, 0};
}
Vector3d pointOf(const mrpt::math::TPoint3D& point) {
  return {point.x, point.y, point.z};
}

// Several steps of the logs share a stamp, because the logs were made faster than their clock ticks. Each step gets a
// new stamp, a tenth of a second after the one before.
void stampAnew(mrpt::obs::CRawlog& rawlog) {
  for (std::size_t i = 0; i < rawlog.size(); ++i) {
    if (rawlog.getType(i) != mrpt::obs::CRawlog::etSensoryFrame) continue;
    for (const auto& observation : *rawlog.getAsObservations(i))
      observation->timestamp = base::stampFromUnix(1e9 + 0.1 * static_cast<double>(i / 2));
  }
}

/// Runs MRPT's filter on the first `share` of the steps of the log.
template <class Filter, class Pose, class Point>
Outcome filtered(mrpt::obs::CRawlog& rawlog, const Log& log, double share) {
  Filter filter;
  filter.loadOptions(mrpt::config::CConfigFile(kMrpt + "config_files/kf-slam/" + log.filter_ini));
  filter.KF_options.verbosity_level = mrpt::system::LVL_ERROR;
  filter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
  Outcome outcome;
  const auto steps = static_cast<std::size_t>(share * static_cast<double>(rawlog.size() / 2));
  const auto start = std::chrono::steady_clock::now();
  std::size_t entry = 0;
  for (std::size_t step = 0; step < steps; ++step) {
    mrpt::obs::CActionCollection::Ptr action;
    mrpt::obs::CSensoryFrame::Ptr frame;
    if (entry + 1 >= rawlog.size() || !rawlog.getActionObservationPair(action, frame, entry)) break;
    filter.processActionObservation(action, frame);
    Pose pose;
    filter.getCurrentRobotPose(pose);
    outcome.trajectory[step + 1] = placeOf(pose);  // the filter skips the first frame, which has no action before it
  }
  outcome.seconds = since(start);
  Pose pose;
  std::vector<Point> points;
  std::map<unsigned int, mrpt::maps::CLandmark::TLandmarkID> ids;
  mrpt::math::CVectorDouble state;
  mrpt::math::CMatrixDouble covariance;
  filter.getCurrentState(pose, points, ids, state, covariance);
  for (const auto& point : points) outcome.landmarks.push_back(pointOf(point));
  return outcome;
}

Outcome mapped(const std::vector<mrpt::obs::CObservation::Ptr>& observations, const std::string& ini, const Log& log,
               double share) {
  const auto engine =
      omnimapper::testing::makeEngine(ini, {std::string("mapper.motion=") + (log.planar ? "planar" : "spatial")});
  std::size_t steps = 0, step = 0;
  const auto isMeasurement = [](const auto& observation) {
    return IS_CLASS(*observation, mrpt::obs::CObservationBearingRange);
  };
  for (const auto& observation : observations) steps += isMeasurement(observation);
  const auto most = static_cast<std::size_t>(share * static_cast<double>(steps));
  Outcome outcome;
  const auto start = std::chrono::steady_clock::now();
  for (const auto& observation : observations) {
    step += isMeasurement(observation);
    if (step > most) break;
    engine->add(observation);
  }
  engine->finish();
  outcome.seconds = since(start);
  const auto view = engine->view();
  std::map<base::Stamp, std::size_t> numbers;
  for (const auto& observation : observations)
    if (isMeasurement(observation)) numbers.emplace(observation->timestamp, numbers.size());
  for (const auto& frame : view.map.key_frames)
    outcome.trajectory[numbers.at(frame.stamp)] = {frame.map_from_base.x(), frame.map_from_base.y(),
                                                   frame.map_from_base.z()};
  for (const auto& [id, landmark] : view.map.landmarks) {
    if (landmark.state != map::Landmark::State::active) continue;
    const auto& value = view.graph.value(landmark.variables.front());
    outcome.landmarks.emplace_back(value[0], value[1], value.size() > 2 ? value[2] : 0);
  }
  return outcome;
}

Outcome best(const std::function<Outcome()>& work, int runs) {
  Outcome outcome = work();
  for (int run = 1; run < runs; ++run) outcome.seconds = std::min(outcome.seconds, work().seconds);
  return outcome;
}

void print(const Log& log, const std::string& who, double share, const Outcome& outcome) {
  const Errors errors = errorsOf(outcome, log);
  std::printf("| %s | %.0f %% | %s | %zu | %zu | %.4f | %.4f | %.3f |\n", log.name.c_str(), 100 * share, who.c_str(),
              outcome.trajectory.size(), outcome.landmarks.size(), errors.trajectory, errors.landmarks,
              outcome.seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Maps MRPT's demonstration logs of range and bearing by our engine and MRPT's filters.");
  std::string ini_path = omnimapper::testing::sourceFile("ini/landmarks.ini");
  std::string only;
  int runs = 3;
  app.add_option("--ini", ini_path, "INI of the mapper")->capture_default_str();
  app.add_option("--log", only, "only this log, such as kf-slam_demo");
  app.add_option("--runs", runs, "number of runs, of which the shortest time counts")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::ifstream file(ini_path);
  const std::string ini((std::istreambuf_iterator<char>(file)), {});
  std::printf(
      "| log | part | mapper | poses | landmarks | trajectory [m] | landmarks [m] | time [s] |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const Log& log : kLogs) {
    if (!only.empty() && log.name != only) continue;
    const std::string path = kMrpt + "datasets/" + log.name + ".rawlog";
    mrpt::obs::CRawlog rawlog;
    if (!rawlog.loadFromRawLogFile(path)) continue;
    stampAnew(rawlog);
    const omnimapper::testing::ScratchFolder scratch;
    if (!rawlog.saveToRawLogFile(scratch / "log.rawlog")) continue;
    std::vector<mrpt::obs::CObservation::Ptr> observations;
    source::RawlogSource source(scratch / "log.rawlog");
    while (auto observation = source.next()) observations.push_back(observation);
    for (const double share : {0.25, 1.0}) {
      print(log, "ours", share, best([&] { return mapped(observations, ini, log, share); }, runs));
      print(log, "MRPT kf-slam", share,
            best(
                [&] {
                  return log.planar ? filtered<mrpt::slam::CRangeBearingKFSLAM2D, mrpt::poses::CPosePDFGaussian,
                                               mrpt::math::TPoint2D>(rawlog, log, share)
                                    : filtered<mrpt::slam::CRangeBearingKFSLAM, mrpt::poses::CPose3DQuatPDFGaussian,
                                               mrpt::math::TPoint3D>(rawlog, log, share);
                },
                runs));
    }
  }
}
