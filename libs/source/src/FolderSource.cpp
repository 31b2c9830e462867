#include <omnimapper/base/Error.h>
#include <omnimapper/source/FolderSource.h>
#include <omnimapper/source/NamedTimes.h>
#include <omnimapper/source/describeInput.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <filesystem>

namespace omnimapper::source {

namespace fs = std::filesystem;

FolderSource::FolderSource(const std::string& folder, bool (*takes)(const std::string& file), const std::string& what,
                           const std::string& label, double rate)
    : label_(label), rate_(rate) {
  std::error_code error;
  if (fs::is_regular_file(folder, error)) refuse(folder, "is no folder: it " + describeInput(folder));
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (takes(entry->path())) files_.push_back(entry->path());
  if (error) refuse(folder, error.message() + "; is the path right?");
  if (files_.empty()) refuse(folder, "holds no " + what + ": it " + describeInput(folder));
  std::sort(files_.begin(), files_.end());
  times_ = timesOfNames(files_);
}

mrpt::obs::CObservation::Ptr FolderSource::next() {
  constexpr double kFirst = 1e9;  // [s] stamp of the first file, if the names are no times
  while (next_ < files_.size()) {
    const std::string& file = files_[next_];
    const double stamp = times_.empty() ? kFirst + static_cast<double>(next_) / rate_ : times_[next_];
    ++next_;
    try {
      auto observation = read(file);
      observation->timestamp = base::stampFromUnix(stamp);
      observation->sensorLabel = label_;
      ++report_.objects;
      report_.count(label_, observation->GetRuntimeClass()->className, observation->timestamp);
      return observation;
    } catch (const base::Error& error) {
      if (report_.missing_images++ == 0) report_.first_missing_image = error.what();
    }
  }
  if (report_.ending == SourceReport::Ending::open) {
    report_.ending = SourceReport::Ending::complete;
    report_.notes.emplace_back(areNamesTimes()
                                   ? "stamps: from the names of the files"
                                   : "stamps: assigned by rate_hz, because the files' names are no Unix times");
    noteAtEnd(report_);
  }
  return nullptr;
}

double FolderSource::progress() const {
  return static_cast<double>(next_) / static_cast<double>(files_.size());
}

}  // namespace omnimapper::source
