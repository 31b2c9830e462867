#include <gtest/gtest.h>
#include <omnimapper/source/BoundedQueue.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace omnimapper::source::bounded_queue_test {
namespace {

constexpr std::size_t kManyBytes = 1 << 30;

// Waits until the other thread has done something that it is certain to do.
template <class Condition>
void waitUntil(Condition condition) {
  while (!condition()) std::this_thread::yield();
}

TEST(BoundedQueue, handsOutWhatWasPutInInOrderWhateverItsRoom) {
  for (const std::size_t room : {1, 2, 7, 1000}) {
    BoundedQueue<int> queue({room, kManyBytes});
    std::thread producer([&] {
      for (int i = 0; i < 500; ++i) EXPECT_TRUE(queue.push(i, 1));
    });
    for (int i = 0; i < 500; ++i) EXPECT_EQ(queue.pop(), i);
    producer.join();
    EXPECT_EQ(queue.size(), 0U);
  }
}

TEST(BoundedQueue, neverHoldsMoreThanItsCountAndIsFilledAgainWhenItIsHalfEmpty) {
  BoundedQueue<int> queue({4, kManyBytes});
  std::atomic<int> pushed{0};
  std::thread producer([&] {
    for (int i = 0; i < 50; ++i) {
      queue.push(i, 0);
      ++pushed;
    }
  });
  for (int taken = 0; taken < 50; ++taken) {
    if (taken % 2 == 0) waitUntil([&] { return pushed == std::min(50, taken + 4); });
    EXPECT_LE(pushed, taken + 4);
    EXPECT_LE(queue.size(), 4U);
    EXPECT_EQ(queue.pop(), taken);
  }
  producer.join();
}

TEST(BoundedQueue, neverHoldsMoreThanItsBytesExceptOneItemAlone) {
  BoundedQueue<int> queue({100, 10});
  std::atomic<int> pushed{0};
  std::thread producer([&] {
    for (const int bytes : {4, 6, 1, 50, 2, 8}) {
      queue.push(bytes, static_cast<std::size_t>(bytes));
      ++pushed;
    }
  });
  // 4 and 6 fill it; 50 waits for an empty queue, and the items after it until it has left.
  struct Step {
    int fewest_pushed, most_pushed, next;
  };
  for (const auto& step : {Step{2, 2, 4}, {2, 3, 6}, {3, 3, 1}, {4, 4, 50}, {6, 6, 2}, {6, 6, 8}}) {
    waitUntil([&] { return pushed >= step.fewest_pushed; });
    EXPECT_LE(pushed, step.most_pushed);
    EXPECT_EQ(queue.pop(), step.next);
  }
  producer.join();
}

TEST(BoundedQueue, closingLetsBothSidesGo) {
  BoundedQueue<int> full({1, kManyBytes}), empty({1, kManyBytes});
  ASSERT_TRUE(full.push(1, 1));
  std::thread producer([&] { EXPECT_FALSE(full.push(2, 1)); });
  std::thread consumer([&] { EXPECT_EQ(empty.pop(), std::nullopt); });
  full.close();
  empty.close();
  producer.join();
  consumer.join();
  EXPECT_EQ(full.pop(), std::nullopt) << "closed is closed";
  EXPECT_FALSE(empty.push(3, 1));
}

TEST(BoundedQueue, aStopEndsTheWaitAndLeavesTheQueueOpen) {
  BoundedQueue<int> queue({1, kManyBytes});
  int asked = 0;
  EXPECT_EQ(queue.pop([&] { return ++asked == 2; }), std::nullopt);
  EXPECT_EQ(asked, 2);
  ASSERT_TRUE(queue.push(5, 1));
  EXPECT_EQ(queue.pop([] { return true; }), 5) << "it is called only while pop() waits";
}

TEST(BoundedQueue, takesWhatCanOnlyBeMoved) {
  BoundedQueue<std::unique_ptr<int>> queue({2, kManyBytes});
  ASSERT_TRUE(queue.push(std::make_unique<int>(7), 1));
  EXPECT_EQ(**queue.pop(), 7);
}

}  // namespace
}  // namespace omnimapper::source::bounded_queue_test
