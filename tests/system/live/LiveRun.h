#pragma once

#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/live/Socket.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "../Runs.h"

/// Runs omnimapper-graphslam --live with sensors that omnimapper-play stands in for: a Hokuyo on Ethernet, and a robot
/// that sends its odometry.
namespace runs {

inline std::vector<std::string> filesIn(const std::string& folder, const std::string& extension) {
  std::vector<std::string> found;
  if (!fs::exists(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == extension) found.push_back(entry.path().string());
  std::sort(found.begin(), found.end());
  return found;
}

/// Root mean square distance [m] from the truth after the best rigid alignment.
inline double errorOf(const std::string& trajectory, const std::string& truth) {
  omnimapper::eval::PairingOptions pairing;
  pairing.longest_gap = omnimapper::base::durationFromSeconds(0.5);
  pairing.alignment = omnimapper::eval::Alignment::se3;
  return omnimapper::eval::absoluteTrajectoryError(omnimapper::eval::readTum(trajectory),
                                                   omnimapper::eval::readTum(truth), pairing)
      .translation.rmse;
}

class LiveRun {
 public:
  /// `faults` are those of the played laser, `odometry_faults` those of the played odometry. No program runs yet.
  explicit LiveRun(double pace, Texts faults = {}, Texts odometry_faults = {})
      : pace_(pace), faults_(std::move(faults)), odometry_faults_(std::move(odometry_faults)) {
    using omnimapper::live::boundPort;
    using omnimapper::live::listenTcp;
    laser_port_ = boundPort(listenTcp({}));
    odometry_port_ = boundPort(listenTcp({}));
    std::ofstream(folder / "live.ini") << "[live]\nsensors = laser, wheels\ncheckpoint_s = 2\n"
                                       << "[laser]\ndriver = CHokuyoURG\nsensorLabel = laser\nIP_DIR = 127.0.0.1\n"
                                       << "pose_x = 0.15\npose_z = 0.35\nPORT_DIR = " << laser_port_
                                       << "\n[wheels]\ndriver = COdometryLines\n"
                                       << "sensorLabel = odometry\nport = " << odometry_port_ << "\n";
  }

  /// Starts the player and waits until its laser listens.
  void play(const std::string& log, const std::string& truth = "") {
    Texts words{omnimapper::testing::ownProgram("omnimapper-play"),
                log,
                "--hokuyo",
                "127.0.0.1:" + std::to_string(laser_port_),
                "--odometry",
                "127.0.0.1:" + std::to_string(odometry_port_),
                "--pace",
                std::to_string(pace_)};
    if (!truth.empty()) words.insert(words.end(), {"--truth", truth, "--shifted-truth", folder / "truth.tum"});
    for (const auto& fault : faults_) words.insert(words.end(), {"--fault", fault});
    for (const auto& fault : odometry_faults_) words.insert(words.end(), {"--odometry-fault", fault});
    player.emplace(words);
    for (int i = 0; i < 200 && player->isRunning() && !isListenedAt(laser_port_); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
  }

  Texts command(const Texts& task) const {
    Texts words{omnimapper::testing::ownProgram("omnimapper-graphslam"), "-i",
                omnimapper::testing::sourceFile("ini/laser2d.ini"), "-i", folder / "live.ini"};
    words.insert(words.end(), task.begin(), task.end());
    return words;
  }
  Texts live(const Texts& more = {}) const {
    Texts task{"--live", "-o", out()};
    task.insert(task.end(), more.begin(), more.end());
    return command(task);
  }

  std::string out() const { return folder / "out"; }
  std::string recorded(const std::string& extension) const {
    const auto files = filesIn(out() + "/recording", extension);
    return files.empty() ? "" : files.front();
  }
  nlohmann::json summary() const { return nlohmann::json::parse(std::ifstream(out() + "/summary.json")); }

  omnimapper::testing::ScratchFolder folder;
  std::optional<omnimapper::testing::Program> player;

 private:
  // This does not connect to the port, because a Hokuyo accepts only one host.
  static bool isListenedAt(std::uint16_t port) {
    char entry[32];
    std::snprintf(entry, sizeof entry, "0100007F:%04X 00000000:0000 0A", port);
    return readFile("/proc/net/tcp").find(entry) != std::string::npos;
  }

  double pace_;
  Texts faults_, odometry_faults_;
  std::uint16_t laser_port_ = 0, odometry_port_ = 0;
};

}  // namespace runs
