// By how much the clocks of a robot's sensors differ.
#include <omnimapper/check/judge.h>

#include <algorithm>
#include <cmath>

#include "../Conclusions.h"
#include "../Format.h"
#include "SensorMounting.h"

namespace omnimapper::check {

namespace {

using State = Quantity::State;

// All clocks are compared with that of the laser of which most is known.
class ClockMounting {
 public:
  ClockMounting(const LogFacts& facts, const QuantityKeys& corrected, SensorMounting& mounting)
      : facts_(facts), corrected_(corrected), mounting_(mounting), offsets_(clockOffsets(facts, 0)) {}

  void measure() {
    const auto lasers = usableLasers(facts_);
    if (lasers.empty()) return;
    laser_ = lasers.front();
    for (const auto& motion : facts_.motions) {
      if (motion.laser == laser_ && !motion.odometry.empty()) add(motion.odometry, motion.clock, 0);
    }
    for (const auto& gyroscope : facts_.gyroscopes) {
      if (gyroscope.laser == laser_) add(gyroscope.gyroscope, gyroscope.clock, 0);
    }
    for (const auto& camera : facts_.cameras) {
      const auto& clock = camera.clock;
      add(camera.camera, clock ? std::optional(ClockFacts{clock->value, clock->sigma, 0, false}) : std::nullopt,
          kRollingShutter);
    }
    for (const auto& laser : lasers) {
      const auto found = offsets_.find(laser);
      if (found == offsets_.end()) continue;
      addNumber(laser, -found->second, sigma_, true, "all others agree with one another");
    }
  }

 private:
  // Offsets below `least` [s] have causes other than the clock.
  void add(const std::string& sensor, const std::optional<ClockFacts>& clock, double least) {
    if (!clock) {
      mounting_.quantities.push_back({sensor, "clock", State::not_determined,
                                      "no offset fits its turns to those of " + check::quoted(laser_) +
                                          " much better than all others: drive turns that begin and end"});
      return;
    }
    sigma_ = std::max(sigma_, clock->sigma);
    std::string by = "by turns, against " + check::quoted(laser_);
    if (least > 0) by += " (rows of an image are read one after another, which explains 0.03 s)";
    if (clock->drift != 0) by += "; it drifts by " + fixed(1e3 * clock->drift, 2) + " s in 1000 s";
    addNumber(sensor, clock->offset, clock->sigma, offsets_.count(sensor) > 0, by);
  }

  // `late` [s]: by how much the stamps are later than those of the others.
  void addNumber(const std::string& sensor, double late, double sigma, bool is_wrong, const std::string& by) {
    const bool is_corrected = is_wrong || corrected_.count({sensor, "clock"}) > 0;
    const double before = clockInIni(facts_, sensor), offset = before - late;
    mounting_.quantities.push_back(
        {sensor, "clock", is_corrected ? State::corrected : State::as_declared, by, "s", 3, before, {offset, sigma}});
    if (is_corrected) mounting_.sensors[sensor].clock_offset = offset;
  }

  const LogFacts& facts_;
  const QuantityKeys& corrected_;
  SensorMounting& mounting_;
  std::map<std::string, double> offsets_;
  std::string laser_;
  double sigma_ = 0;  // [s] the largest of those that were compared
};

}  // namespace

void addClocks(const LogFacts& facts, const QuantityKeys& corrected, SensorMounting& mounting) {
  ClockMounting(facts, corrected, mounting).measure();
}

bool SensorMounting::isAnythingCorrected() const {
  return std::any_of(quantities.begin(), quantities.end(),
                     [](const Quantity& one) { return one.state == State::corrected; });
}

SensorMounting sensorMounting(const LogFacts& facts, const QuantityKeys& corrected) {
  SensorMounting mounting;
  if (clockStands(facts)) return mounting;  // without stamps nothing can be compared
  addLasers(facts, corrected, mounting);
  addCameras(facts, corrected, mounting);
  addClocks(facts, corrected, mounting);
  return mounting;
}

}  // namespace omnimapper::check
