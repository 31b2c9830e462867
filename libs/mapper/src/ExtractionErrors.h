#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Error.h>

#include <cstddef>
#include <optional>
#include <string>

namespace omnimapper::mapper {

/// How often extractors could not take an observation, and why the first time. One bad scan ends no run.
class ExtractionErrors {
 public:
  void add(const base::Error& error, const mrpt::obs::CObservation& raw);
  /// Adds what came later.
  void add(const ExtractionErrors& later);

  std::size_t count() const { return count_; }
  /// Of an extractor, as it was thrown.
  const std::optional<base::Error>& first() const { return first_; }
  /// A warning that names label and stamp of the first. Empty if there was none.
  std::string sentence() const;
  /// missing_images if the first lacks them, else damaged_input; ok if there was none.
  base::ExitCode code() const;

 private:
  std::size_t count_ = 0;
  std::optional<base::Error> first_;
  std::string first_of_;
};

}  // namespace omnimapper::mapper
