#include <gtest/gtest.h>
#include <omnimapper/perception/Blackboard.h>

#include <stdexcept>
#include <string>

namespace omnimapper::perception::blackboard_test {
namespace {

struct Length {
  std::size_t value;
};

TEST(Blackboard, GivesWhatWasPutByTypeAndTheFirstThatFits) {
  Blackboard board;
  EXPECT_EQ(board.find<Length>(), nullptr);
  board.put(std::make_shared<const Length>(Length{3}));
  board.put(std::make_shared<const std::string>("three"));
  board.put(std::make_shared<const Length>(Length{5}));
  EXPECT_EQ(board.find<Length>()->value, 3U);
  EXPECT_EQ(board.find<Length>([](const Length& one) { return one.value > 3; })->value, 5U);
  EXPECT_EQ(board.find<Length>([](const Length& one) { return one.value > 5; }), nullptr);
  EXPECT_EQ(*board.find<std::string>(), "three");
}

TEST(Blackboard, MakesWhatIsMissingOnceAndNothingIfThatFails) {
  Blackboard board;
  int made = 0;
  const auto make = [&] { return std::make_shared<const Length>(Length{static_cast<std::size_t>(++made)}); };
  const auto fail = []() -> std::shared_ptr<const Length> { throw std::runtime_error("unreadable"); };
  EXPECT_THROW(board.get<Length>(fail), std::runtime_error);
  EXPECT_EQ(board.find<Length>(), nullptr);
  EXPECT_EQ(board.get<Length>(make).value, 1U);
  EXPECT_EQ(board.get<Length>(make).value, 1U);
  EXPECT_EQ(board.get<Length>(fail).value, 1U);
}

TEST(Blackboard, ACopySharesTheObjectsButNotWhatIsPutLater) {
  Blackboard board;
  board.put(std::make_shared<const Length>(Length{3}));
  Blackboard copy = board;
  EXPECT_EQ(copy.find<Length>(), board.find<Length>());
  copy.put(std::make_shared<const std::string>("three"));
  EXPECT_EQ(board.find<std::string>(), nullptr);
}

TEST(Blackboard, ObjectsLiveAsLongAsAnyoneHoldsThem) {
  std::weak_ptr<const Length> watched;
  std::shared_ptr<const Length> held;
  {
    Blackboard board;
    board.put(std::make_shared<const Length>(Length{3}));
    watched = held = board.find<Length>();
  }
  EXPECT_FALSE(watched.expired());
  held.reset();
  EXPECT_TRUE(watched.expired());
}

}  // namespace
}  // namespace omnimapper::perception::blackboard_test
