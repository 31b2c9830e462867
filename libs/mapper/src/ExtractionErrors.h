#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Error.h>

#include <cstddef>
#include <optional>
#include <string>

namespace omnimapper::mapper {

/// Counts the errors of extractors and keeps the first. A run goes on after such an error.
class ExtractionErrors {
 public:
  void add(const base::Error& error, const mrpt::obs::CObservation& raw);
  /// Adds the errors of `later`, which occurred after those counted here.
  void add(const ExtractionErrors& later);

  std::size_t count() const { return count_; }
  /// The first error as the extractor threw it.
  const std::optional<base::Error>& first() const { return first_; }
  /// A warning that names the label and stamp of the first failed observation. Empty if there was no error.
  std::string sentence() const;
  /// missing_images if the first error is of that code, else damaged_input; ok if there was no error.
  base::ExitCode code() const;

 private:
  std::size_t count_ = 0;
  std::optional<base::Error> first_;
  std::string first_of_;
};

}  // namespace omnimapper::mapper
