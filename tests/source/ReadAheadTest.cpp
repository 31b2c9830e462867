#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/ReadAhead.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

#include <atomic>
#include <condition_variable>
#include <stdexcept>

namespace omnimapper::source::read_ahead_test {
namespace {

using namespace logs;
using Ending = SourceReport::Ending;

std::vector<double> seconds(int count) {
  std::vector<double> list;
  for (int i = 1; i <= count; ++i) list.push_back(i);
  return list;
}

// Counts how far it was read, from any thread; throws at the observation number fails_at.
class Counted : public ListSource {
 public:
  using ListSource::ListSource;
  CObservation::Ptr next() override {
    if (++asked == fails_at) throw std::runtime_error("the disk is gone");
    report_.bytes += bytes_each;
    return ListSource::next();
  }
  std::atomic<int> asked{0};
  int fails_at = 0;
  std::uint64_t bytes_each = 0;
};

// Like a live sensor: after two observations it waits until somebody interrupts it.
class Blocking : public ListSource {
 public:
  Blocking() : ListSource("live", {1, 2}) { report_.ending = Ending::open; }
  CObservation::Ptr next() override {
    if (auto observation = ListSource::next()) return observation;
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return interrupted_; });
    return nullptr;
  }
  void interrupt() override {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    wake_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool interrupted_ = false;
};

void settle(const std::atomic<int>& asked, int expected) {
  while (asked < expected) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // for a thread that would read too far
}

std::string everythingIn(const SourceReport& report, double progress) {
  return report.text() + std::to_string(progress);
}

TEST(ReadAhead, givesTheSequenceReportAndProgressOfItsSourceStepByStep) {
  const testing::ScratchFolder folder;
  Bytes bytes;
  for (int i = 0; i < 100; ++i) bytes.action(1, 0, 0.1).frame({scan(2 * i + 1), scan(2 * i + 1.5, "rear")});
  for (const auto& path : {writeGzip(folder / "a.rawlog", bytes.string()),
                           writePlain(folder / "cut.rawlog", bytes.string().substr(0, bytes.string().size() / 2))}) {
    for (const std::size_t room : {1, 10, 1000}) {
      RawlogSource plain(path);
      ReadAhead ahead(std::make_unique<RawlogSource>(path), {}, {room, std::size_t{1} << 30});
      const auto samePlace = [&] {
        return everythingIn(ahead.report(), ahead.progress()) == everythingIn(plain.report(), plain.progress());
      };
      EXPECT_TRUE(samePlace());
      while (const auto expected = plain.next()) {
        const auto got = ahead.next();
        ASSERT_NE(got, nullptr);
        EXPECT_EQ(listing({got}), listing({expected}));
        EXPECT_TRUE(samePlace()) << ahead.report().text() << plain.report().text();
      }
      EXPECT_EQ(ahead.next(), nullptr);
      EXPECT_TRUE(samePlace()) << ahead.report().text() << plain.report().text();
      EXPECT_EQ(ahead.next(), nullptr) << "the end stays the end";
    }
  }
}

TEST(ReadAhead, readsNoFurtherThanItsLimitAndOneMore) {
  auto counted = std::make_unique<Counted>("wheels", seconds(40));
  const auto& asked = counted->asked;
  ReadAhead ahead(std::move(counted), {}, {5, std::size_t{1} << 30});
  for (int taken = 0; taken < 33; taken += 3) {
    settle(asked, taken + 6);
    EXPECT_EQ(asked, taken + 6) << "five wait, one is in the reader's hand";
    for (int i = 0; i < 3; ++i) EXPECT_NE(ahead.next(), nullptr);
  }
}

TEST(ReadAhead, imagesCountWithTheirPixels) {
  Observations images;
  for (int i = 1; i <= 20; ++i) {
    auto image = mrpt::obs::CObservationImage::Create();
    image->timestamp = at(i);
    image->image.resize(100, 50, mrpt::img::CH_RGB);
    images.push_back(image);
  }
  auto counted = std::make_unique<Counted>(images);
  const auto& asked = counted->asked;
  ReadAhead ahead(std::move(counted), {}, {1000, 4 * 100 * 50 * 3});
  for (int taken = 0; taken < 14; taken += 2) {
    settle(asked, taken + 5);
    EXPECT_EQ(asked, taken + 5) << "four wait, one is in the reader's hand";
    for (int i = 0; i < 2; ++i) EXPECT_NE(ahead.next(), nullptr);
  }
}

TEST(ReadAhead, observationsCountWithTheirBytesInTheLog) {
  auto counted = std::make_unique<Counted>("wheels", seconds(20));
  counted->bytes_each = 700;
  const auto& asked = counted->asked;
  ReadAhead ahead(std::move(counted), {}, {1000, 3 * 700});
  for (int taken = 0; taken < 14; taken += 2) {
    settle(asked, taken + 4);
    EXPECT_EQ(asked, taken + 4) << "three wait, one is in the reader's hand";
    for (int i = 0; i < 2; ++i) EXPECT_NE(ahead.next(), nullptr);
  }
}

TEST(ReadAhead, aSlowSourceLosesNothing) {
  class Slow : public ListSource {
   public:
    using ListSource::ListSource;
    CObservation::Ptr next() override {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      return ListSource::next();
    }
  };
  ReadAhead ahead(std::make_unique<Slow>("wheels", seconds(20)));
  EXPECT_EQ(listing(readAll(ahead)).back(), "wheels 20");
  EXPECT_EQ(ahead.report().observations(), 20U);
  EXPECT_EQ(ahead.report().ending, Ending::complete);
}

TEST(ReadAhead, anErrorComesOutInItsPlaceAndIsTheEnd) {
  auto counted = std::make_unique<Counted>("wheels", seconds(9));
  counted->fails_at = 5;
  ReadAhead ahead(std::move(counted));
  for (int i = 1; i <= 4; ++i) EXPECT_NE(ahead.next(), nullptr);
  EXPECT_THROW(ahead.next(), std::runtime_error);
  EXPECT_EQ(ahead.report().observations(), 4U);
  EXPECT_EQ(ahead.next(), nullptr);
}

TEST(ReadAhead, canBeLeftAtAnyTimeAndReadsNoFurther) {
  for (int taken = 0; taken < 30; ++taken) {
    auto counted = std::make_unique<Counted>("wheels", seconds(100000));
    ReadAhead ahead(std::move(counted), {}, {10, std::size_t{1} << 30});
    for (int i = 0; i < taken; ++i) EXPECT_NE(ahead.next(), nullptr);
  }
  ReadAhead untouched(std::make_unique<ListSource>("wheels", std::vector<double>{}));
}

TEST(ReadAhead, aSourceThatBlocksIsStoppedByTheCallerAndInterruptedAtTheEnd) {
  ReadAhead ahead(std::make_unique<Blocking>(), [] { return true; });
  Observations got;
  while (got.size() < 2)
    if (auto observation = ahead.next()) got.push_back(observation);
  EXPECT_EQ(listing(got), (std::vector<std::string>{"live 1", "live 2"}));
  EXPECT_EQ(ahead.next(), nullptr);
  EXPECT_EQ(ahead.report().ending, Ending::open) << "so the caller knows that it was the stop";
}

TEST(ReadAhead, anInterruptEndsTheWaitOfAnotherThread) {
  ReadAhead ahead(std::make_unique<Blocking>());
  EXPECT_NE(ahead.next(), nullptr);
  EXPECT_NE(ahead.next(), nullptr);
  std::thread other([&] { ahead.interrupt(); });
  EXPECT_EQ(ahead.next(), nullptr);
  other.join();
}

TEST(ReadAhead, anEmptySourceIsAtItsEndAtOnce) {
  ReadAhead ahead(std::make_unique<ListSource>("wheels", std::vector<double>{}));
  EXPECT_EQ(ahead.next(), nullptr);
  EXPECT_EQ(ahead.report().ending, Ending::complete);
  EXPECT_EQ(ahead.progress(), 1.0);
}

TEST(ReadAhead, reportAndProgressMayBeAskedFromAnotherThread) {
  ReadAhead ahead(std::make_unique<ListSource>("wheels", seconds(500)));
  std::atomic<bool> done{false};
  std::thread watcher([&] {
    std::uint64_t before = 0;
    while (!done) {
      const auto now = ahead.report().observations();
      EXPECT_GE(now, before);
      EXPECT_LE(ahead.progress(), 1.0);
      before = now;
    }
  });
  EXPECT_EQ(readAll(ahead).size(), 500U);
  done = true;
  watcher.join();
}

}  // namespace
}  // namespace omnimapper::source::read_ahead_test
