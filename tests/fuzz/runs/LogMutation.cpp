#include "LogMutation.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "Values.h"

namespace omnimapper::fuzz {

namespace {

using mrpt::obs::CObservation;

// A log that is being changed. An observation is copied before it is changed.
class Draft {
 public:
  Draft(const Observations& log, Dice& dice) : log_(log), is_copy_(log.size(), false), dice_(dice) {}

  void makeSomethingWrong() {
    if (log_.empty()) return;
    switch (below(dice_, 10)) {
      case 0:
        return changeStamps();
      case 1:
        return changeLabels();
      case 2:
        return changeOrder();
      case 3:
        return dropOrRepeat();
      default:
        return changeValue();
    }
  }

  const Observations& log() const { return log_; }

 private:
  CObservation& changed(std::size_t i) {
    if (!is_copy_[i]) {
      log_[i] = std::dynamic_pointer_cast<CObservation>(log_[i]->duplicateGetSmartPtr());
      is_copy_[i] = true;
    }
    return *log_[i];
  }

  // Chooses observations of one sensor: a single one, all, all from one on, or every n-th.
  std::vector<std::size_t> someOfASensor() {
    const std::size_t first = anyOfASensor();
    const std::string label = log_[first]->sensorLabel;
    const std::size_t scope = below(dice_, 4), step = scope == 3 ? 2 + below(dice_, 9) : 1;
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < log_.size(); ++i) {
      if (log_[i]->sensorLabel == label) all.push_back(i);
    }
    if (scope == 0) return {first};
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < all.size(); k += step) {
      if (scope == 1 || all[k] >= first) chosen.push_back(all[k]);
    }
    return chosen;
  }
  // A random observation. All sensors are equally likely, however many observations they have.
  std::size_t anyOfASensor() {
    std::vector<std::string> labels;
    for (const auto& observation : log_) labels.push_back(observation->sensorLabel);
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    const auto& label = labels[below(dice_, labels.size())];
    std::size_t i = below(dice_, log_.size());
    while (log_[i]->sensorLabel != label) i = (i + 1) % log_.size();
    return i;
  }

  void changeValue() {
    const auto chosen = someOfASensor();
    if (chosen.empty()) return;
    const auto values = valuesOf(changed(chosen.front()));
    if (values.empty()) return;
    // The first values are parameters of the sensor. Half of the time one of these is chosen.
    const std::size_t value =
        onceIn(dice_, 2) ? below(dice_, std::min<std::size_t>(20, values.size())) : below(dice_, values.size());
    const double odd = oddInstead(values[value].get(), dice_);
    const bool is_same = onceIn(dice_, 2);
    for (const std::size_t i : chosen) {
      const auto each = valuesOf(changed(i));
      if (value < each.size()) each[value].set(is_same ? odd : oddInstead(each[value].get(), dice_));
    }
  }

  void changeStamps() {
    const auto chosen = someOfASensor();
    const std::size_t kind = below(dice_, 7);
    const double by = std::pow(10, dice_.uniform(-4, 10)) * (onceIn(dice_, 2) ? 1 : -1);
    for (const std::size_t i : chosen) {
      auto& stamp = changed(i).timestamp;
      const auto before = stamp;
      const auto moved = [&](double seconds) { stamp = before + base::durationFromSeconds(seconds); };
      switch (kind) {
        case 0:
          stamp = mrpt::Clock::time_point();
          break;
        case 1:
          stamp = log_.front()->timestamp;
          break;
        case 2:
          moved(by);
          break;
        case 3:
          moved(dice_.normal(std::min(std::abs(by), 100.0)));
          break;
        case 4:
          moved(static_cast<double>(i) * std::min(std::abs(by), 1e6));
          break;
        case 5:
          stamp = mrpt::Clock::time_point(mrpt::Clock::duration(std::numeric_limits<std::int64_t>::max()));
          break;
        default:
          stamp = mrpt::Clock::time_point(mrpt::Clock::duration(-1));
          break;
      }
    }
  }

  void changeLabels() {
    const std::string labels[] = {"",
                                  "odometry",
                                  "laser",
                                  "kinect",
                                  "laser\nplugin_libraries = ./a.so",
                                  "\x1b[2J",
                                  "../../a",
                                  "<script>",
                                  "a, b",
                                  "; [mapper]",
                                  "\xff\xfe",
                                  "%s%n",
                                  std::string(100000, 'a'),
                                  std::string("a\0b", 3),
                                  log_[below(dice_, log_.size())]->sensorLabel};
    const auto& label = labels[below(dice_, std::size(labels))];
    for (const std::size_t i : someOfASensor()) changed(i).sensorLabel = label;
  }

  void changeOrder() {
    const std::size_t begin = below(dice_, log_.size()), end = begin + below(dice_, log_.size() - begin + 1);
    const auto at = [&](std::size_t i) { return log_.begin() + static_cast<std::ptrdiff_t>(i); };
    is_copy_.assign(log_.size(), false);
    switch (below(dice_, 3)) {
      case 0:
        std::reverse(at(begin), at(end));
        break;
      case 1:
        std::rotate(at(begin), at(begin + (end - begin) / 2), at(end));
        break;
      default: {
        for (std::size_t i = begin; i < end; ++i) std::swap(log_[i], log_[begin + below(dice_, end - begin)]);
      }
    }
  }

  void dropOrRepeat() {
    const std::size_t begin = below(dice_, log_.size());
    const std::size_t end = onceIn(dice_, 3) ? log_.size() : begin + below(dice_, log_.size() - begin + 1);
    const auto at = [&](std::size_t i) { return log_.begin() + static_cast<std::ptrdiff_t>(i); };
    if (onceIn(dice_, 2)) {
      const Observations again(at(begin), at(end));
      log_.insert(at(onceIn(dice_, 2) ? end : below(dice_, log_.size())), again.begin(), again.end());
    } else {
      log_.erase(at(begin), at(end));
    }
    is_copy_.assign(log_.size(), false);
  }

  Observations log_;
  std::vector<bool> is_copy_;
  Dice& dice_;
};

}  // namespace

std::string bytesOf(const Observations& log) {
  std::string bytes;
  for (const auto& observation : log) {
    mrpt::io::CMemoryStream stream;
    try {
      mrpt::serialization::archiveFrom(stream) << *observation;
    } catch (const std::exception&) {
      continue;
    }
    bytes.append(static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
  }
  return bytes;
}

std::string mutatedLog(const Observations& log, Dice& dice) {
  Draft draft(log, dice);
  const std::size_t count = 1 + below(dice, 4);
  for (std::size_t i = 0; i < count; ++i) draft.makeSomethingWrong();
  auto bytes = bytesOf(draft.log());
  if (onceIn(dice, 10)) damageBytes(bytes, dice);
  if (onceIn(dice, 10)) changeNumber(bytes, dice);
  if (onceIn(dice, 30)) bytes.resize(below(dice, bytes.size() + 1));
  return bytes;
}

}  // namespace omnimapper::fuzz
