#include "ExtractionErrors.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/base/Stamp.h>

namespace omnimapper::mapper {

void ExtractionErrors::add(const base::Error& error, const mrpt::obs::CObservation& raw) {
  if (count_++ > 0) return;
  first_ = error;
  first_of_ = "'" + raw.sensorLabel + "' at " + base::formatUnix(raw.timestamp, 6) + " s";
}

void ExtractionErrors::add(const ExtractionErrors& later) {
  if (count_ == 0) {
    first_ = later.first_;
    first_of_ = later.first_of_;
  }
  count_ += later.count_;
}

std::string ExtractionErrors::sentence() const {
  if (count_ == 0) return "";
  return "an extractor could not process " + base::counted(count_, "observation") + "; the first is of " + first_of_ +
         ": " + first_->what();
}

base::ExitCode ExtractionErrors::code() const {
  if (count_ == 0) return base::ExitCode::ok;
  const bool lacks_images = first_->code() == base::ExitCode::missing_images;
  return lacks_images ? base::ExitCode::missing_images : base::ExitCode::damaged_input;
}

}  // namespace omnimapper::mapper
