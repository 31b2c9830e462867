#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/LogLook.h>
#include <omnimapper/source/ObservationSource.h>
#include <omnimapper/source/TextFileLines.h>

#include <string>

namespace csv_log {

/// What a user can set in [source_csv_log]; the table declares each key once.
struct CsvOptions {
  double x = 0, z = 0;  ///< position of the laser on the base, which looks forward [m]
  static const omnimapper::base::OptionTable<CsvOptions>& table();
};

/// A log of a made-up format: text, compressed or not, whose first line is "csv_log 1". Each further line is an
/// odometry or a scan:
///   odom,STAMP,X,Y,YAW           pose of the base in the frame of the wheels: Unix time [s], [m], [m], [rad]
///   scan,STAMP,APERTURE,R,R,...  angle [rad] from the first to the last beam, which turn to the left, and their ranges
///                                [m]; 0 is no echo
class CsvLog : public omnimapper::source::ObservationSource {
 public:
  static constexpr const char* kName = "csv_log";
  static constexpr const char* kSummary = "a log as CSV text";
  static bool recognizes(const omnimapper::source::LogLook& look);

  /// Throws Error(unreadable_input) if the file cannot be opened, or is no such log.
  CsvLog(const std::string& path, const CsvOptions& options);

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override { return lines_.file().fraction(); }
  omnimapper::source::SourceReport report() const override { return report_; }

 private:
  void end();

  CsvOptions options_;
  omnimapper::source::TextFileLines lines_;
  omnimapper::source::SourceReport report_;
  std::uint64_t bad_lines_ = 0, first_bad_line_ = 0;
};

}  // namespace csv_log
