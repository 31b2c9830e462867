// Plays the lasers and the odometry of a rawlog as the sensors themselves would, for tests of live mapping.
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Exceptions.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

#include "PlayRun.h"

namespace {

using namespace omnimapper;

std::atomic<bool> interrupted{false};

struct Arguments {
  std::string log, odometry, start, truth, shifted_truth, record;
  std::vector<std::string> faults, odometry_faults;
  bool udp = false;
  players::PlayOptions play;
};

void declare(CLI::App& app, Arguments& its) {
  app.add_option("log", its.log, "Rawlog whose lasers and odometry are played")->required();
  app.add_option(
      "--hokuyo", its.play.hokuyos,
      "Address of a laser: IP:PORT, or the path of a pseudo-terminal; LABEL= before it names one of several");
  app.add_option("--odometry", its.odometry, "IP:PORT to which odometry is sent as lines");
  app.add_flag("--udp", its.udp, "Send odometry by UDP, not by TCP");
  app.add_option("--pace", its.play.pace, "Factor on the speed of the recording")->check(CLI::PositiveNumber);
  app.add_option("--start", its.start,
                 "Unix time [s] of the log's first stamp; without it, when all hosts have connected");
  app.add_option("--fault", its.faults,
                 "KIND@SCAN:SECONDS, KIND one of garbage, half, checksum, slow, silence and hangup");
  app.add_option("--odometry-fault", its.odometry_faults,
                 "KIND@LINE:SECONDS, KIND one of garbage, half, silence and hangup");
  app.add_option("--answer-delay", its.play.hokuyo.answer_delay, "Delay of each answer of a laser [s]");
  app.add_option("--linger", its.play.linger, "Time for which lasers answer after their last scan [s]");
  app.add_option("--truth", its.truth, "Trajectory file of the log, which is written with the stamps of the host");
  app.add_option("--shifted-truth", its.shifted_truth, "File to which --truth is written, in the TUM format");
  app.add_option("--record", its.record, "File to which a line is written for each scan of the first laser");
}

void play(Arguments& its) {
  for (const auto& fault : its.faults) its.play.hokuyo.faults.push_back(players::parseFault(fault));
  if (!its.odometry.empty()) {
    its.play.odometry = players::OdometryPlayerOptions{players::parseSocketAddress(its.odometry), its.udp, {}};
    for (const auto& fault : its.odometry_faults)
      its.play.odometry->faults.push_back(players::parseOdometryFault(fault));
  }
  if (!its.start.empty()) its.play.host_start = base::parseUnix(its.start);
  auto log = players::PlayedLog::read(its.log);
  const auto log_start = log.start();
  players::PlayRun run(std::move(log), its.play);
  for (const auto& address : run.addresses()) std::cout << "A laser is at " << address << "." << std::endl;
  run.start([] { return interrupted.load(); });
  const auto clock = run.waitForStart();
  if (clock) {
    std::cout << "log_start " << base::formatUnix(log_start) << "\nhost_start " << base::formatUnix(clock->hostStart())
              << "\npace " << its.play.pace << std::endl;
    if (!its.truth.empty()) players::shiftTrajectory(its.truth, its.shifted_truth, *clock);
  }
  run.wait();
  if (!its.record.empty() && !its.play.hokuyos.empty()) run.hokuyo(0).writeRecord(its.record);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Plays the lasers and the odometry of a rawlog as the sensors themselves would.");
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGINT, [](int) { interrupted = true; });
  std::signal(SIGTERM, [](int) { interrupted = true; });
  try {
    play(arguments);
  } catch (const base::Error& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << base::sentenceOf(error) << "\n";
    return 1;
  }
  return interrupted ? 130 : 0;
}
