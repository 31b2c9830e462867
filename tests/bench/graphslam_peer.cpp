// Accuracy and time of MRPT's own graph-SLAM engine and of omnimapper-graphslam on simulated logs with ground truth.
// Each runs as a separate process and is timed from start to end.

// clang-format off
#include <mrpt/opengl/CSphere.h>  // first: headers of MRPT's graph-SLAM need it and do not include it
// clang-format on
#include <fcntl.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/CGraphSlamEngine.h>
#include <mrpt/graphslam/ERD/CICPCriteriaERD.h>
#include <mrpt/graphslam/GSO/CLevMarqGSO.h>
#include <mrpt/graphslam/NRD/CFixedIntervalsNRD.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>

#include "omnimapper/geometry/Conversions.h"

namespace {

using namespace omnimapper;
namespace fs = std::filesystem;

constexpr const char* kStockIni = "/usr/share/mrpt/config_files/graphslam-engine/odometry_2DRangeScans.ini";

// ---- The peer -------------------------------------------------------------------------------------------------------

std::optional<base::Stamp> stampOfScan(const mrpt::obs::CSensoryFrame::Ptr& frame,
                                       const mrpt::obs::CObservation::Ptr& observation) {
  if (observation && IS_CLASS(*observation, mrpt::obs::CObservation2DRangeScan)) return observation->timestamp;
  if (!frame) return std::nullopt;
  const auto scan = frame->getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
  return scan ? std::optional(scan->timestamp) : std::nullopt;
}

// Runs the engine on the log and writes each node of its final graph with the stamp of its scan. The root has the stamp
// of the first scan.
void runPeer(const std::string& ini, const std::string& log, const std::string& tum) {
  using Network = mrpt::graphs::CNetworkOfPoses2DInf;
  mrpt::graphslam::deciders::CFixedIntervalsNRD<Network> nodes;
  mrpt::graphslam::deciders::CICPCriteriaERD<Network> edges;
  mrpt::graphslam::optimizers::CLevMarqGSO<Network> optimizer;
  mrpt::graphslam::CGraphSlamEngine<Network> engine(ini, log, "", nullptr, &nodes, &edges, &optimizer);

  std::vector<base::Stamp> stamp_of_node;
  mrpt::io::CFileGZInputStream file(log);
  auto archive = mrpt::serialization::archiveFrom(file);
  mrpt::obs::CActionCollection::Ptr action;
  mrpt::obs::CSensoryFrame::Ptr frame;
  mrpt::obs::CObservation::Ptr observation;
  std::optional<base::Stamp> first, latest;
  for (std::size_t entry = 0;
       mrpt::obs::CRawlog::getActionObservationPairOrObservation(archive, action, frame, observation, entry);) {
    if (const auto stamp = stampOfScan(frame, observation)) latest = stamp;
    if (!first) first = latest;
    engine._execGraphSlamStep(action, frame, observation, entry);
    const std::size_t count = engine.getGraph().nodeCount();
    while (latest && stamp_of_node.size() < count) stamp_of_node.push_back(stamp_of_node.empty() ? *first : *latest);
  }

  eval::Trajectory trajectory;
  for (const auto& [id, pose] : engine.getRobotEstimatedTrajectory()) {
    trajectory.push_back({stamp_of_node.at(id), geometry::lift(geometry::fromMrpt(mrpt::poses::CPose2D(pose)))});
  }
  eval::writeTum(tum, trajectory);
}

// Copies MRPT's default settings, but prints only errors. Nothing is drawn, because the engine gets no window manager.
void writeQuietIni(const std::string& stock, const std::string& quiet) {
  std::ifstream in(stock);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.empty()) throw base::Error(base::ExitCode::unreadable_input, stock + ": MRPT's settings cannot be read");
  text = std::regex_replace(text, std::regex("class_verbosity *= *[0-9]+"), "class_verbosity = 3");
  base::writeFile(quiet, [&](std::ostream& out) { out << text; });
}

// ---- Timing and judging ---------------------------------------------------------------------------------------------

struct Run {
  double wall = 0;  // [s]
  double cpu = 0;   // [s], user and system
  eval::Trajectory trajectory;
};

// Runs a command with its output in a file, and returns wall and processor time. Throws base::Error if the command
// fails.
Run timeCommand(std::vector<std::string> command, const std::string& output) {
  std::vector<char*> arguments;
  for (auto& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    const int fd = ::open(output.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);  // MRPT's engine waits for a key if it has a terminal
    ::dup2(fd, STDOUT_FILENO);
    ::dup2(fd, STDERR_FILENO);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    std::ifstream printed(output);
    std::cerr << printed.rdbuf();
    throw base::Error(base::ExitCode::internal, command[0] + " failed; its output is above");
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {wall.count(), seconds(usage.ru_utime) + seconds(usage.ru_stime), {}};
}

// The run with the median wall time of several.
Run medianRun(int runs, const std::vector<std::string>& command, const std::string& output, const std::string& tum) {
  std::vector<Run> all;
  for (int i = 0; i < runs; ++i) {
    all.push_back(timeCommand(command, output));
    all.back().trajectory = eval::readTum(tum);
  }
  std::sort(all.begin(), all.end(), [](const Run& a, const Run& b) { return a.wall < b.wall; });
  return all[all.size() / 2];
}

// The truth at the stamps of the peer's nodes, so that both programs are evaluated at the same times.
eval::Trajectory truthAtNodes(const eval::Trajectory& truth, const eval::Trajectory& nodes) {
  eval::Trajectory at_nodes;
  for (const auto& pair : eval::associate(nodes, truth, base::durationFromSeconds(0.001))) {
    at_nodes.push_back({pair.stamp, pair.reference});
  }
  return at_nodes;
}

double ateRmse(const Run& run, const eval::Trajectory& truth, eval::Alignment alignment) {
  const eval::PairingOptions options{base::durationFromSeconds(0.001), {}, alignment};
  return eval::absoluteTrajectoryError(run.trajectory, truth, options).translation.rmse;
}

void printRow(const std::string& log, const std::string& program, const Run& run, const Run& peer,
              const eval::Trajectory& truth) {
  const auto judged = eval::associate(run.trajectory, truth, base::durationFromSeconds(0.001)).size();
  std::printf("| %s | %s | %.2f | %.2f | %.4f | %zu / %zu | %.4f | %.4f |\n", log.c_str(), program.c_str(), run.wall,
              run.cpu, run.wall / peer.wall, judged, truth.size(), ateRmse(run, truth, eval::Alignment::none),
              ateRmse(run, truth, eval::Alignment::se3));
  std::fflush(stdout);
}

struct Arguments {
  std::string peer_ini = kStockIni, ours, our_ini, output;
  std::vector<std::string> logs, our_options, run_peer;
  int runs = 1;
};

void compare(const Arguments& arguments, const std::string& log) {
  const std::string name = fs::path(log).stem().string(), folder = arguments.output + "/" + name;
  base::makeWritableFolder(folder);
  const std::string quiet_ini = folder + "/peer.ini", peer_tum = folder + "/peer.tum";
  writeQuietIni(arguments.peer_ini, quiet_ini);
  const std::string self = fs::read_symlink("/proc/self/exe").string();
  const Run peer =
      medianRun(arguments.runs, {self, "--run-peer", quiet_ini, log, peer_tum}, folder + "/peer.txt", peer_tum);
  const auto truth = truthAtNodes(eval::readMrptGroundTruth(log + ".GT.txt"), peer.trajectory);
  printRow(name, "MRPT graph-SLAM", peer, peer, truth);
  if (arguments.ours.empty()) return;
  std::vector<std::string> command = {arguments.ours, "-i", arguments.our_ini, "-r", log, "-o", folder + "/ours"};
  command.insert(command.end(), arguments.our_options.begin(), arguments.our_options.end());
  const Run ours = medianRun(arguments.runs, command, folder + "/ours.txt", folder + "/ours/trajectory.tum");
  printRow(name, "omnimapper-graphslam", ours, peer, truth);
}

int run(Arguments arguments) {
  if (!arguments.run_peer.empty()) {
    runPeer(arguments.run_peer[0], arguments.run_peer[1], arguments.run_peer[2]);
    return 0;
  }
  if (arguments.logs.empty()) {
    for (const char* name : {"simul", "range_030_bearing_015"}) {
      const auto log = omnimapper::testing::mrptDataset("graphslam-engine-demos/action_observations_map/" +
                                                        std::string(name) + ".rawlog");
      if (!log)
        throw base::Error(base::ExitCode::unreadable_input, "MRPT's demo logs are missing: install mrpt-common");
      arguments.logs.push_back(*log);
    }
  }
  const omnimapper::testing::ScratchFolder scratch;
  if (arguments.output.empty()) arguments.output = scratch.path();
  std::cout << "| log | program | wall s | CPU s | of peer's time | nodes judged | ATE rmse m, no alignment | SE(3) |\n"
            << "|---|---|---|---|---|---|---|---|\n";
  for (const auto& log : arguments.logs) compare(arguments, log);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Prints a Markdown table of time and absolute trajectory error at the stamps of the peer's nodes.");
  app.add_option("--ours", arguments.ours, "path of omnimapper-graphslam, which is run on the same logs");
  app.add_option("--ini", arguments.our_ini, "its INI file");
  app.add_option("--option", arguments.our_options,
                 "further argument of omnimapper-graphslam, such as --option=--set --option=a.b=c");
  app.add_option("--log", arguments.logs, "rawlog with a .GT.txt beside it; default: both of MRPT's demo logs");
  app.add_option("--peer-ini", arguments.peer_ini, "settings of the peer; default: MRPT's own");
  app.add_option("--runs", arguments.runs, "runs of each; the one with the median wall time counts")
      ->check(CLI::Range(1, 99));
  app.add_option("-o,--output", arguments.output, "folder in which trajectories and printed text are kept");
  app.add_option("--run-peer", arguments.run_peer, "INI LOG TUM: only run the peer, without timing")->expected(3);
  try {
    app.parse(argc, argv);
    return run(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(base::ExitCode::command_line);
  } catch (const std::exception& error) {
    std::cerr << "bench-graphslam_peer: " << error.what() << "\n";
    return 1;
  }
}
