#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Measures the seconds since its construction.
class StopWatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What the engine's thread spends its time on.
enum class Stage {
  source,           ///< reading the log
  perception_wait,  ///< until the workers have extracted what a key frame needs
  job_wait,         ///< until the workers have finished a job that is due
  plugin,           ///< in a pose or measurement plugin
  solve,
  output,  ///< in an output plugin
  engine,  ///< all the rest
};

/// Wall time of the engine's thread by stage, in total and for each key frame. Only the engine measures it; algorithms
/// do not.
class StageTimes {
 public:
  struct Total {
    double seconds = 0;
    std::size_t calls = 0;
  };
  struct PerKeyFrame {
    double plugins_ms = 0;
    double solve_ms = 0;
    double engine_ms = 0;  ///< everything else except waiting; includes releasing old data
  };

  /// Measures a stage until this timer is destroyed. The timer pauses while another timer that was started later
  /// measures, so each second counts once.
  class [[nodiscard]] Timer {
   public:
    Timer(StageTimes& times, Stage stage, const std::string& section);
    ~Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

   private:
    StageTimes& times_;
    Total& total_;
    double& of_stage_;
    Timer* outer_;
    double before_ = 0;  // [s] until a timer within this one took over
    StopWatch watch_;    // since this timer began or resumed
  };
  /// `section` is the INI section of a plugin or output, else empty. This object must outlive the timer and must not be
  /// moved.
  Timer measure(Stage stage, const std::string& section = {}) { return {*this, stage, section}; }

  /// Adds a time that was measured.
  void add(Stage stage, const std::string& section, double seconds);
  void addKeyFrame(const PerKeyFrame& times) { key_frames_.push_back(times); }

  /// The times spent until some point of the run.
  struct Mark {
    StopWatch watch;
    double plugin, solve, wait;
  };
  Mark mark() const;
  /// Adds the times since `begin` as those of one key frame.
  void addKeyFrameSince(const Mark& begin);

  /// By name: "source", "perception wait", "job wait", "plugin <section>", "solve", "output <section>", "engine".
  const std::map<std::string, Total>& totals() const { return totals_; }
  const std::vector<PerKeyFrame>& keyFrames() const { return key_frames_; }

  /// [s] of wall time from the start of the run until the map was finished, before the outputs; 0 until then.
  double mappingSeconds() const { return mapping_seconds_; }
  void setMappingSeconds(double seconds) { mapping_seconds_ = seconds; }

 private:
  double seconds(Stage stage) const { return seconds_[static_cast<std::size_t>(stage)]; }

  std::map<std::string, Total> totals_;
  std::array<double, static_cast<std::size_t>(Stage::engine) + 1> seconds_{};
  std::vector<PerKeyFrame> key_frames_;
  double mapping_seconds_ = 0;
  /// The innermost running timer. It is not copied: a copy of these times has no running timer.
  struct Running {
    Running() = default;
    Running(const Running&) {}
    Running& operator=(const Running&) { return *this; }
    Timer* timer = nullptr;
  } running_;
};

}  // namespace omnimapper::mapper
