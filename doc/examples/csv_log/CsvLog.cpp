#include "CsvLog.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/source/SourceFactory.h>
#include <omnimapper/source/refuse.h>

#include <charconv>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace csv_log {

using omnimapper::base::OptionTable;
using omnimapper::base::Range;
using omnimapper::source::CompressedFile;
using Ending = omnimapper::source::SourceReport::Ending;
using mrpt::obs::CObservation;

namespace {

constexpr const char* kFirstLine = "csv_log 1";

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

double number(const std::string& text) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) throw std::invalid_argument(text);
  return value;
}

CObservation::Ptr odometryOf(const std::vector<std::string>& fields) {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->sensorLabel = "wheels";
  odometry->odometry = mrpt::poses::CPose2D(number(fields.at(2)), number(fields.at(3)), number(fields.at(4)));
  return odometry;
}

CObservation::Ptr scanOf(const std::vector<std::string>& fields, const CsvOptions& options) {
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = "laser";
  scan->sensorPose = mrpt::poses::CPose3D(options.x, 0, options.z, 0, 0, 0);
  scan->aperture = static_cast<float>(number(fields.at(2)));
  scan->rightToLeft = true;
  scan->resizeScan(fields.size() - 3);
  for (std::size_t i = 3; i < fields.size(); ++i) {
    const auto range = static_cast<float>(number(fields[i]));
    scan->setScanRange(i - 3, range);
    scan->setScanRangeValidity(i - 3, range > 0);
  }
  return scan;
}

// Throws std::invalid_argument, std::out_of_range or omnimapper::base::Error for a line that cannot be read.
CObservation::Ptr observationOf(const std::string& line, const CsvOptions& options) {
  const auto fields = fieldsOf(line);
  CObservation::Ptr observation;
  if (fields.at(0) == "odom") observation = odometryOf(fields);
  if (fields.at(0) == "scan") observation = scanOf(fields, options);
  if (!observation) throw std::invalid_argument(fields[0]);
  observation->timestamp = omnimapper::base::parseUnix(fields.at(1));
  return observation;
}

}  // namespace

const OptionTable<CsvOptions>& CsvOptions::table() {
  static const auto table = OptionTable<CsvOptions>()
                                .number("laser_x_m", &CsvOptions::x, Range(), "x coordinate of the laser on the base.")
                                .number("laser_z_m", &CsvOptions::z, Range(), "Height of the laser on the base.");
  return table;
}

bool CsvLog::recognizes(const omnimapper::source::LogLook& look) {
  return look.headBeginsWith(kFirstLine);
}

CsvLog::CsvLog(const std::string& path, const CsvOptions& options) : options_(options), lines_(path) {
  std::string first;
  if (!lines_.next(first) || first != kFirstLine)
    omnimapper::source::refuse(path, std::string("is no such log: its first line is not ") + kFirstLine);
}

CObservation::Ptr CsvLog::next() {
  for (std::string line; report_.ending == Ending::open && lines_.next(line);) {
    try {
      auto observation = observationOf(line, options_);
      ++report_.objects;
      report_.bytes += line.size() + 1;
      report_.count(observation->sensorLabel, observation->GetRuntimeClass()->className, observation->timestamp);
      return observation;
    } catch (const std::exception&) {
      if (bad_lines_++ == 0) first_bad_line_ = lines_.number();
    }
  }
  if (report_.ending == Ending::open) end();
  return nullptr;
}

void CsvLog::end() {
  const auto& file = lines_.file();
  report_.ending = Ending::complete;
  if (file.ending() != CompressedFile::Ending::end) {
    report_.ending = Ending::truncated;
    report_.message = file.path() + ": ends too early (" + file.problem() + "); copy it again";
  } else if (bad_lines_ > 0) {
    report_.ending = Ending::corrupt;
    report_.message = file.path() + ":" + std::to_string(first_bad_line_) + ": cannot be read, with " +
                      std::to_string(bad_lines_ - 1) + " further lines; they were left out";
  }
}

namespace {

// Runs when the library is loaded.
const omnimapper::base::AtLoad kRegister([] { omnimapper::source::SourceOf<CsvLog, CsvOptions>::registerClass(); });

}  // namespace

}  // namespace csv_log
