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
  double pace = 1;                        ///< factor on the speed of the recording
  std::optional<base::Stamp> host_start;  ///< host time of the log's first stamp; none: when all hosts have connected
  HokuyoPlayerOptions hokuyo;             ///< options of each laser
  double linger = 0;                      ///< [s] for which lasers answer after their last scan
};

/// Plays the lasers and the odometry of a log at the same time, each in a separate thread, by one clock.
class PlayRun {
 public:
  /// Opens the connections of the lasers, so that hosts can connect. Throws Error(command_line) if a laser is not in
  /// the log or its name is missing, and as HokuyoPlayer and the links do.
  PlayRun(PlayedLog log, PlayOptions options);
  /// Stops and waits for the threads.
  ~PlayRun();
  PlayRun(const PlayRun&) = delete;
  PlayRun& operator=(const PlayRun&) = delete;

  /// Begins to wait for the hosts, then plays. Several threads call `stop`.
  void start(const Stop& stop = {});
  /// Waits until the hosts have connected and the start is known; empty if it is stopped before.
  std::optional<PlayClock> waitForStart();
  /// Waits for the end of the log. Throws the error that ended a player, and with it the others, for example if a laser
  /// that closed its connection cannot listen at its address again.
  void wait();
  void stop() { stopped_ = true; }

  /// The addresses of the lasers, in the order of PlayOptions::hokuyos.
  std::vector<std::string> addresses() const;
  /// To be called after wait().
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
  std::exception_ptr failure_;  // the first error
};

/// "IP:PORT". Throws Error(command_line) for anything else.
live::SocketAddress parseSocketAddress(const std::string& text);

}  // namespace omnimapper::players
