#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <string>
#include <vector>

namespace omnimapper::source {

/// Streams the files of a folder, each of which is one observation, in the order of their names. Where all names are
/// Unix times, in seconds or nanoseconds, they are the stamps.
class FolderSource : public ObservationSource {
 public:
  /// Files that read() refuses are left out and counted as missing images.
  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override { return report_; }
  bool areNamesTimes() const { return !times_.empty(); }

 protected:
  /// `what`: the kind of files, for the error. `rate`: of files whose names are no Unix times [1/s]. Throws
  /// Error(unreadable_input) for a folder without files that `takes` is true for.
  FolderSource(const std::string& folder, bool (*takes)(const std::string& file), const std::string& what,
               const std::string& label, double rate);
  /// Without stamp and label. Throws base::Error for a file that cannot be read.
  virtual mrpt::obs::CObservation::Ptr read(const std::string& file) = 0;

 private:
  std::string label_;
  double rate_;
  std::vector<std::string> files_;
  std::vector<double> times_;  // Unix times of the files, where their names are such
  std::size_t next_ = 0;
  SourceReport report_;
};

}  // namespace omnimapper::source
