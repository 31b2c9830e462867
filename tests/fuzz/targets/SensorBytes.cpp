#include <hokuyo/ScipCheck.h>
#include <odometry/LineBuffer.h>
#include <omnimapper/drivers/OdometryLine.h>

#include <cmath>
#include <string_view>

#include "../Input.h"
#include "../Targets.h"

namespace omnimapper::fuzz {

namespace {

void readOdometry(std::string_view bytes, std::size_t piece) {
  drivers::LineBuffer buffer;
  const auto take = [](std::string_view text) {
    require(text.size() <= drivers::LineBuffer::kLongest, "a line that is too long");
    const auto line = drivers::parseOdometryLine(text);
    if (line.fault) return;
    const auto& pose = line.odometry.odometry;
    require(std::abs(pose.x()) <= 1e6 && std::abs(pose.y()) <= 1e6, "a position beyond all bounds");
    require(std::abs(pose.phi()) < 7000, "an angle beyond all bounds");
    require(!line.odometry.hasVelocities || std::abs(line.odometry.velocityLocal.vx) <= 100,
            "a speed beyond all bounds");
    require(!line.stamp || base::isValid(*line.stamp), "a stamp that is none");
  };
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece) buffer.add(bytes.substr(begin, piece), take, [] {});
}

void readHokuyo(std::string_view bytes, std::size_t piece) {
  // The first line is the command.
  const std::string_view command = bytes.substr(0, bytes.find('\n'));
  drivers::ScipCheck check;
  check.setCommand(command);
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece) check.add(bytes.substr(begin, piece));
  const std::string valid = check.take();
  require(valid.empty() || valid.compare(0, command.size(), command) == 0, "a message without its echo");
  require(valid.empty() || valid.substr(valid.size() - 2) == "\n\n", "a message without its end");
  drivers::ScipCheck again;
  again.setCommand(command);
  again.add(valid);
  require(again.take() == valid && again.damaged() == 0, "a valid message that is not");
}

}  // namespace

void sensorBytes(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const bool is_hokuyo = input.flag();
  const auto piece = static_cast<std::size_t>(1 + input.take<std::uint8_t>());
  const std::string_view bytes(reinterpret_cast<const char*>(input.rest()), input.left());
  is_hokuyo ? readHokuyo(bytes, piece) : readOdometry(bytes, piece);
}

}  // namespace omnimapper::fuzz
