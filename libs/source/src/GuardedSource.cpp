#include "GuardedSource.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/source/refuse.h>

#include <new>
#include <utility>

namespace omnimapper::source {

using mrpt::obs::CObservation;

namespace {

bool readLog(const std::string& path, const OpenLog& opener, const SandboxedReader::Took& took) {
  try {
    const auto log = opener(path);
    if (!took()) return false;
    while (log->next())
      if (!took()) return false;
  } catch (const std::bad_alloc&) {
    return false;
  } catch (const std::exception&) {  // the parent gets the same one
  }
  return true;
}

}  // namespace

std::unique_ptr<SandboxedReader> startReader(const std::string& path, const OpenLog& opener) {
  return std::make_unique<SandboxedReader>(
      [&](const SandboxedReader::Took& took) { return readLog(path, opener, took); });
}

GuardedSource::GuardedSource(const std::string& path, const OpenLog& opener, std::unique_ptr<SandboxedReader> reader,
                             const SourceOptions& options, double clock_offset, const StopOpening& stop)
    : path_(path), reader_(std::move(reader)), selection_(options, clock_offset) {
  bool stopped = false;
  const auto stop_waiting = [&] { return stopped = stopped || (stop && stop()); };
  const auto answer = stop_waiting() ? SandboxedReader::Answer::not_known : reader_->mayReadAfter(0, stop_waiting);
  if (answer == SandboxedReader::Answer::no)
    refuse(path, "cannot be opened: its reader crashes, or needs more than 1 GiB; copy or download the log again");
  if (answer == SandboxedReader::Answer::yes) {
    log_ = opener(path);
    ++steps_;
    first_ = read(stop_waiting);
  }
  if (stopped) throw base::Error(base::ExitCode::interrupted, path + ": interrupted while the log was being opened.");
}

CObservation::Ptr GuardedSource::next() {
  while (!selection_.isOver() && !interrupted_) {
    const auto observation = first_ ? std::exchange(first_, nullptr) : read([this] { return interrupted_.load(); });
    if (!observation) break;
    if (selection_.takes(*observation)) return observation;
  }
  return nullptr;
}

CObservation::Ptr GuardedSource::read(const std::function<bool()>& stop) {
  if (!problem_.empty()) return nullptr;
  const auto answer = reader_->mayReadAfter(steps_, stop);
  if (answer == SandboxedReader::Answer::not_known) return nullptr;
  const std::string after = " after " + std::to_string(steps_ - 1) + " observations";
  if (answer == SandboxedReader::Answer::no) {
    problem_ = path_ + ": is corrupt: its reader crashes, or needs more than 1 GiB," + after +
               "; copy or download the log again";
    return nullptr;
  }
  try {
    auto observation = log_->next();
    if (observation) ++steps_;
    return observation;
  } catch (const std::exception& error) {
    problem_ = path_ + ": cannot be read" + after + ": " + error.what();
    return nullptr;
  }
}

double GuardedSource::progress() const {
  return selection_.isOver() ? 1.0 : log_->progress();
}

SourceReport GuardedSource::report() const {
  auto report = log_->report();
  if (first_) report.ending = SourceReport::Ending::open;
  if (!problem_.empty()) {
    report.ending = SourceReport::Ending::corrupt;
    report.message = problem_;
  }
  return selection_.report(std::move(report));
}

void GuardedSource::interrupt() {
  interrupted_ = true;
  log_->interrupt();
}

std::optional<base::Stamp> GuardedSource::firstStamp() const {
  if (!first_ || !base::isValid(first_->timestamp)) return std::nullopt;
  return selection_.corrected(*first_);
}

}  // namespace omnimapper::source
