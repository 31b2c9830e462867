#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <string>
#include <vector>

namespace omnimapper::source {

/// Streams the files of a folder in the order of their names; each file is one observation. If all names are Unix
/// times, in seconds or nanoseconds, these times are the stamps.
class FolderSource : public ObservationSource {
 public:
  /// Files that read() refuses are left out and counted as missing images.
  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override { return report_; }
  bool areNamesTimes() const { return !times_.empty(); }

 protected:
  /// `takes` selects the files, and `what` names their kind in the error. If the names are no Unix times, `rate` [1/s]
  /// determines the stamps. Throws Error(unreadable_input) if the folder has no such files.
  FolderSource(const std::string& folder, bool (*takes)(const std::string& file), const std::string& what,
               const std::string& label, double rate);
  /// Reads one file; the caller sets stamp and label. Throws base::Error if the file cannot be read.
  virtual mrpt::obs::CObservation::Ptr read(const std::string& file) = 0;
  /// Adds notes to the report when all files have been read.
  virtual void noteAtEnd(SourceReport& /*report*/) const {}

 private:
  std::string label_;
  double rate_;
  std::vector<std::string> files_;
  std::vector<double> times_;  // Unix times of the files; empty if their names are no times
  std::size_t next_ = 0;
  SourceReport report_;
};

}  // namespace omnimapper::source
