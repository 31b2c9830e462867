// live-record INI FOLDER SECONDS [COUNT [WORDS]]: reads the sensors of an INI for so long, or until COUNT observations
// have come, or until a sentence with these words is reported. Records them in FOLDER/log.rawlog and prints the
// sentences that are reported about them, one a line.
#include <omnimapper/base/Config.h>
#include <omnimapper/live/LiveSource.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

using namespace omnimapper;

int main(int argc, char** argv) try {
  if (argc < 4) return 2;
  const auto config = base::Config::fromFile(argv[1]);
  const auto options = config.section("live").read<live::LiveOptions>();
  std::filesystem::create_directories(argv[2]);
  live::LiveSource source(live::readSensors(options, config), options,
                          std::make_unique<live::Recorder>(argv[2], "log", live::RecorderOptions()));
  source.open({});
  std::cout << "open" << std::endl;
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(static_cast<int>(1000 * std::stod(argv[3])));
  const std::uint64_t most = argc > 4 ? std::stoull(argv[4]) : UINT64_MAX;
  bool is_reported = false;
  while (Clock::now() < end && source.counts().arrived < most && !is_reported) {
    while (source.next(std::chrono::milliseconds(10))) continue;
    for (const auto& sentence : source.takeNews()) {
      std::cout << sentence << std::endl;
      is_reported = is_reported || (argc > 5 && sentence.find(argv[5]) != std::string::npos);
    }
  }
  source.close();
  for (const auto& sensor : source.sensors())
    std::cout << sensor.name << " " << sensor.observations << " observations, reopened " << sensor.reopened << "\n";
  std::cout << std::flush;
  if (source.hasLeftBehind()) std::_Exit(3);
  return 0;
} catch (const base::Error& error) {
  std::cerr << error.what() << "\n";
  return static_cast<int>(error.code());
}
