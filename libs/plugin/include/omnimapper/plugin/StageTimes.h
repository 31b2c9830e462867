#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Wall time spent in each stage of the flow, in total and per key frame. The engine measures, algorithms do not.
/// Stages: "source", "perception wait", "job wait", "plugin <section>", "solve", "output <section>", "engine" (all the
/// rest).
class StageTimes {
 public:
  struct Total {
    double seconds = 0;
    std::size_t calls = 0;
  };
  struct PerKeyFrame {
    double matching_ms = 0;  ///< measurement plugins
    double solve_ms = 0;
    double engine_ms = 0;  ///< everything else in the engine's thread
  };

  void add(const std::string& stage, double seconds);
  const std::map<std::string, Total>& totals() const { return totals_; }
  std::vector<PerKeyFrame>& keyFrames() { return key_frames_; }
  const std::vector<PerKeyFrame>& keyFrames() const { return key_frames_; }

 private:
  std::map<std::string, Total> totals_;
  std::vector<PerKeyFrame> key_frames_;
};

/// Seconds since it was made.
class StopWatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Adds the seconds of its life to a sum.
class Timed {
 public:
  explicit Timed(double& sum) : sum_(sum) {}
  ~Timed() { sum_ += watch_.seconds(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& sum_;
  StopWatch watch_;
};

}  // namespace omnimapper::mapper
