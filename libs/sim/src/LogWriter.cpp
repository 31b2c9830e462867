#include "LogWriter.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>

namespace omnimapper::sim {

namespace {

class ObservationWriter : public LogWriter {
 public:
  explicit ObservationWriter(source::RawlogWriter& rawlog) : rawlog_(rawlog) {}
  void add(const mrpt::obs::CObservation::Ptr& observation) override { rawlog_.add(*observation); }

 private:
  source::RawlogWriter& rawlog_;
};

class FrameWriter : public LogWriter {
 public:
  explicit FrameWriter(source::RawlogWriter& rawlog) : rawlog_(rawlog) {}

  void add(const mrpt::obs::CObservation::Ptr& observation) override {
    const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation);
    if (!odometry) {
      frame_.insert(observation);
      return;
    }
    if (!frame_.empty()) flush();
    newest_ = odometry;
  }

  void finish() override {
    if (!frame_.empty()) flush();
  }

 private:
  // Writes the motion since the last frame, then the observations that arrived meanwhile.
  void flush() {
    mrpt::obs::CActionCollection actions;
    if (newest_) {
      mrpt::obs::CActionRobotMovement2D movement;
      movement.computeFromOdometry(newest_->odometry - (written_ ? written_->odometry : newest_->odometry), {});
      movement.timestamp = newest_->timestamp;
      actions.insert(movement);
      written_ = newest_;
    }
    rawlog_.add(actions, frame_);
    frame_.clear();
  }

  source::RawlogWriter& rawlog_;
  mrpt::obs::CSensoryFrame frame_;
  mrpt::obs::CObservationOdometry::Ptr newest_, written_;
};

}  // namespace

std::unique_ptr<LogWriter> makeLogWriter(SimulationOptions::Format format, source::RawlogWriter& rawlog) {
  if (format == SimulationOptions::Format::frames) return std::make_unique<FrameWriter>(rawlog);
  return std::make_unique<ObservationWriter>(rawlog);
}

}  // namespace omnimapper::sim
