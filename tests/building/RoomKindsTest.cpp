#include <gtest/gtest.h>
#include <omnimapper/building/RoomKinds.h>

#include <cmath>

namespace omnimapper::building::room_kinds_test {
namespace {

/// A room of 12 m2, 3 m wide.
Room plainRoom() {
  Room room;
  room.id = 1;
  room.outline = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  room.area = 12;
  room.clearance = 1.5;
  return room;
}

TEST(RoomKinds, BinsCountSurfacesAndMeasureTheShape) {
  const auto bins = kindBins(plainRoom(), 2, {{"bed", 1}, {"seat", 4}, {"wall", 7}});
  ASSERT_EQ(bins.size(), kindFeatures().size());
  EXPECT_EQ(bins[0], 1U) << "one bed";
  EXPECT_EQ(bins[1], 0U) << "no appliance";
  EXPECT_EQ(bins[2], 2U) << "many seats";
  EXPECT_EQ(bins[7], 2U) << "from 8 to 14 m2";
  EXPECT_EQ(bins[8], 0U) << "12 m2 are 1.33 squares of 3 m";
  EXPECT_EQ(bins[9], 1U) << "two doors";
  for (std::size_t i = 0; i < bins.size(); ++i) EXPECT_LT(bins[i], kindFeatures()[i].bins);
}

TEST(RoomKinds, ProbabilitiesFollowBayesRule) {
  KindModel model;
  model.tempering = 1;
  model.kinds = {"a", "b"};
  model.log_likelihood.resize(2);
  for (std::size_t kind = 0; kind < 2; ++kind)
    for (const auto& feature : kindFeatures())
      model.log_likelihood[kind].emplace_back(feature.bins, std::log(1.0 / static_cast<double>(feature.bins)));
  model.log_likelihood[1][0] = {std::log(0.1), std::log(0.8), std::log(0.1)};
  const auto bins = kindBins(plainRoom(), 2, {{"bed", 1}});
  const auto kinds = likelyKinds(model, bins, true);
  EXPECT_EQ(kinds[0].first, "b");
  EXPECT_NEAR(kinds[0].second, 0.8 / (0.8 + 1.0 / 3), 1e-9);
  EXPECT_NEAR(likelyKinds(model, bins, false)[0].second, 0.5, 1e-9) << "a laser sees no bed";
  EXPECT_TRUE(likelyKinds({}, bins, true).empty());
}

TEST(RoomKinds, TheLearnedModelIsADistribution) {
  const KindModel& model = learnedKinds();
  ASSERT_EQ(model.kinds.size(), model.log_likelihood.size());
  for (const auto& of_kind : model.log_likelihood) {
    ASSERT_EQ(of_kind.size(), kindFeatures().size());
    for (std::size_t i = 0; i < of_kind.size(); ++i) {
      double sum = 0;
      ASSERT_EQ(of_kind[i].size(), kindFeatures()[i].bins);
      for (const double logarithm : of_kind[i]) sum += std::exp(logarithm);
      EXPECT_NEAR(sum, 1, 0.03);
    }
  }
}

TEST(RoomKinds, ABedMakesABedroomAndTheEvidenceSaysSo) {
  Storey storey;
  storey.rooms = {plainRoom()};
  nameByContents(storey, {{1, {{"bed", 2}, {"cabinet", 3}}}}, true);
  EXPECT_EQ(storey.rooms[0].kind, "bedroom");
  ASSERT_EQ(storey.rooms[0].why.size(), 1U);
  EXPECT_EQ(storey.rooms[0].why[0].what, "bedroom by 2 bed, 3 cabinet, 12.0 m2, 0 doors");
  nameByContents(storey, {{1, {{"bed", 2}, {"cabinet", 3}}}}, true);
  EXPECT_EQ(storey.rooms[0].why.size(), 1U) << "the earlier evidence is replaced";
}

}  // namespace
}  // namespace omnimapper::building::room_kinds_test
