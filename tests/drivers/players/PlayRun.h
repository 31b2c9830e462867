#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "CommonStart.h"
#include "HokuyoPlayer.h"
#include "OdometryPlayer.h"
#include "PlayedLog.h"

namespace omnimapper::players {

struct PlayOptions {
  /// "IP:PORT" or the path of a pseudo-terminal to be made, one for each laser that is played; "LABEL=" before it names
  /// the laser where the log has several.
  std::vector<std::string> hokuyos;
  std::optional<OdometryPlayerOptions> odometry;
  double pace = 1;                        ///< times as fast as it was recorded
  std::optional<base::Stamp> host_start;  ///< of the log's first stamp; none: when all hosts are there
  HokuyoPlayerOptions hokuyo;             ///< of each laser
  double linger = 0;                      ///< [s] that lasers answer on after their last scan
};

/// Plays the lasers and the odometry of a log at once, each in a thread of its own, by one clock.
class PlayRun {
 public:
  /// Opens the lasers' sides; their hosts may connect from then on. Throws Error(command_line) where a laser is not in
  /// the log or its name is missing, and as HokuyoPlayer and the links do.
  PlayRun(PlayedLog log, PlayOptions options);
  /// Stops and waits for the threads.
  ~PlayRun();
  PlayRun(const PlayRun&) = delete;
  PlayRun& operator=(const PlayRun&) = delete;

  /// Begins to wait for the hosts, and plays. `stop` is asked by several threads.
  void start(const Stop& stop = {});
  /// Waits until hosts are there and the start is known; empty if it was stopped before.
  std::optional<PlayClock> waitForStart();
  /// Waits for the end of the log. Throws what ended a player before, and with it the others: as the links do, where
  /// a laser that hung up cannot listen at its address again.
  void wait();
  void stop() { stopped_ = true; }

  /// Where the lasers are, in the order of PlayOptions::hokuyos.
  std::vector<std::string> addresses() const;
  /// After wait().
  const HokuyoPlayer& hokuyo(std::size_t index) const { return *hokuyos_.at(index); }
  std::uint64_t odometryLinesSent() const { return odometry_ ? odometry_->sent() : 0; }

 private:
  const PlayOptions options_;
  std::vector<std::unique_ptr<HokuyoPlayer>> hokuyos_;
  std::unique_ptr<OdometryPlayer> odometry_;
  std::unique_ptr<CommonStart> start_;
  std::atomic<bool> stopped_{false};
  Stop stop_;
  void startThread(const std::function<void()>& play);
  void join();

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::exception_ptr failure_;  // the first
};

/// "IP:PORT". Throws Error(command_line) for anything else.
live::SocketAddress parseSocketAddress(const std::string& text);

}  // namespace omnimapper::players
