#pragma once

#include <bzlib.h>
#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/source/ObservationSource.h>
#include <zlib.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

/// Small logs made by hand for the tests of source.
namespace omnimapper::source::logs {

using mrpt::obs::CObservation;
using Observations = std::vector<CObservation::Ptr>;

/// The stamp `seconds` after a day in 2020; 0 is "no stamp".
inline base::Stamp at(double seconds) {
  return seconds == 0 ? base::Stamp() : base::stampFromUnix(1.6e9) + base::durationFromSeconds(seconds);
}

inline CObservation::Ptr scan(double seconds, const std::string& label = "laser") {
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->timestamp = at(seconds);
  scan->sensorLabel = label;
  scan->resizeScan(5);
  for (std::size_t i = 0; i < 5; ++i) {
    scan->setScanRange(i, static_cast<float>(seconds) + 0.1f * static_cast<float>(i));
    scan->setScanRangeValidity(i, true);
  }
  return scan;
}

inline CObservation::Ptr odometry(double seconds, double x = 0, const std::string& label = "wheels") {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->timestamp = at(seconds);
  odometry->sensorLabel = label;
  odometry->odometry = mrpt::poses::CPose2D(x, 0, 0);
  return odometry;
}

/// An action with MRPT's Gaussian motion model.
inline mrpt::obs::CActionRobotMovement2D movement(double x, double y, double yaw, double seconds = 0) {
  mrpt::obs::CActionRobotMovement2D movement;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  movement.computeFromOdometry(mrpt::poses::CPose2D(x, y, yaw), model);
  movement.timestamp = at(seconds);
  return movement;
}

/// Objects one after another, as in a file.
class Bytes {
 public:
  Bytes& operator<<(const mrpt::serialization::CSerializable& object) {
    mrpt::serialization::archiveFrom(stream_) << object;
    return *this;
  }
  Bytes& operator<<(const CObservation::Ptr& object) { return *this << *object; }
  Bytes& action(double x, double y, double yaw, double seconds = 0) {
    mrpt::obs::CActionCollection actions;
    actions.insert(movement(x, y, yaw, seconds));
    return *this << actions;
  }
  Bytes& frame(const Observations& observations) {
    mrpt::obs::CSensoryFrame frame;
    for (const auto& observation : observations) frame.insert(observation);
    return *this << frame;
  }
  std::string string() {
    return {static_cast<const char*>(stream_.getRawBufferData()),
            static_cast<std::size_t>(stream_.getTotalBytesCount())};
  }

 private:
  mrpt::io::CMemoryStream stream_;
};

inline std::string writePlain(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

inline std::string writeGzip(const std::string& path, const std::string& bytes) {
  gzFile file = gzopen(path.c_str(), "wb");
  EXPECT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())), static_cast<int>(bytes.size()));
  EXPECT_EQ(gzclose(file), Z_OK);
  return path;
}

/// In blocks of 100 kB.
inline std::string writeBzip2(const std::string& path, const std::string& bytes) {
  BZFILE* file = BZ2_bzopen(path.c_str(), "wb1");
  EXPECT_EQ(BZ2_bzwrite(file, const_cast<char*>(bytes.data()), static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  BZ2_bzclose(file);
  return path;
}

inline std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Observations from memory: those given, or odometry at those times.
class ListSource : public ObservationSource {
 public:
  explicit ListSource(Observations list) : list_(std::move(list)) { report_.ending = SourceReport::Ending::complete; }
  ListSource(const std::string& label, const std::vector<double>& seconds) {
    for (const double s : seconds) list_.push_back(odometry(s, 0, label));
    report_.ending = SourceReport::Ending::complete;
  }
  CObservation::Ptr next() override {
    if (next_ == list_.size()) return nullptr;
    const auto& observation = list_[next_++];
    report_.count(observation->sensorLabel, "odometry", observation->timestamp);
    return observation;
  }
  double progress() const override {
    return list_.empty() ? 1.0 : static_cast<double>(next_) / static_cast<double>(list_.size());
  }
  SourceReport report() const override { return report_; }
  SourceReport report_;

 private:
  Observations list_;
  std::size_t next_ = 0;
};

inline Observations readAll(ObservationSource& source) {
  Observations observations;
  double progress = 0;
  while (auto observation = source.next()) {
    observations.push_back(observation);
    EXPECT_GE(source.progress(), progress);
    progress = source.progress();
    EXPECT_LE(progress, 1.0);
  }
  EXPECT_EQ(source.next(), nullptr) << "the end stays the end";
  return observations;
}

/// "laser 1.5" for each: label and seconds as at() takes them.
inline std::vector<std::string> listing(const Observations& observations) {
  std::vector<std::string> list;
  for (const auto& observation : observations) {
    const double seconds = base::isValid(observation->timestamp)
                               ? base::secondsBetween(base::stampFromUnix(1.6e9), observation->timestamp)
                               : 0.0;
    char text[80];
    std::snprintf(text, sizeof text, "%s %g", observation->sensorLabel.c_str(), seconds);
    list.emplace_back(text);
  }
  return list;
}

inline std::vector<obs::CObservationRelativeMotion::Ptr> motionsOf(const Observations& observations) {
  std::vector<obs::CObservationRelativeMotion::Ptr> motions;
  for (const auto& observation : observations)
    if (auto motion = std::dynamic_pointer_cast<obs::CObservationRelativeMotion>(observation))
      motions.push_back(motion);
  return motions;
}

}  // namespace omnimapper::source::logs
