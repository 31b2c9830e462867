#include <omnimapper/source/ReadAhead.h>

#include <utility>

#include "PayloadSize.h"

namespace omnimapper::source {

ReadAhead::ReadAhead(std::unique_ptr<ObservationSource> inner, std::function<bool()> stop, QueueLimits limits)
    : inner_(std::move(inner)), stop_(std::move(stop)), queue_(limits), place_(innerPlace()) {
  thread_ = std::thread([this, bytes = place_.report.bytes] { read(bytes); });
}

ReadAhead::~ReadAhead() {
  interrupt();
  thread_.join();
}

mrpt::obs::CObservation::Ptr ReadAhead::next() {
  if (is_over_) return nullptr;
  auto item = queue_.pop(stop_);
  if (!item) return nullptr;
  is_over_ = !item->observation;
  if (item->error) std::rethrow_exception(item->error);
  const std::lock_guard lock(place_mutex_);
  place_ = std::move(item->place);
  return item->observation;
}

double ReadAhead::progress() const {
  const std::lock_guard lock(place_mutex_);
  return place_.progress;
}

SourceReport ReadAhead::report() const {
  const std::lock_guard lock(place_mutex_);
  return place_.report;
}

void ReadAhead::interrupt() {
  queue_.close();
  inner_->interrupt();
}

void ReadAhead::read(std::uint64_t bytes_before) {
  for (bool goes_on = true; goes_on;) {
    Item item;
    std::size_t bytes = 0;
    try {
      item.observation = inner_->next();
      item.place = innerPlace();
      bytes = static_cast<std::size_t>(item.place.report.bytes - bytes_before);
      bytes_before = item.place.report.bytes;
      if (item.observation) bytes += payloadBytes(*item.observation);
    } catch (...) {
      item = {nullptr, {}, std::current_exception()};
    }
    const bool is_last = !item.observation;
    goes_on = queue_.push(std::move(item), bytes) && !is_last;
  }
}

}  // namespace omnimapper::source
