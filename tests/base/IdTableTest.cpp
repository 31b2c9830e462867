#include <gtest/gtest.h>
#include <omnimapper/base/IdTable.h>

#include <string>
#include <vector>

namespace omnimapper::base::id_table_test {
namespace {

using Table = IdTable<LandmarkId, std::string>;

std::vector<std::string> values(const Table& table) {
  std::vector<std::string> all;
  for (const auto& [id, value] : table) all.push_back(value);
  return all;
}

TEST(IdTable, IteratesInTheOrderOfIdsOverHolesAndSessions) {
  Table table;
  table.add(1, "later session");
  const auto first = table.add(0, "first");
  const auto second = table.add(0, "second");
  for (int i = 0; i < 200; ++i) table.erase(table.add(0, "gone"));
  table.add(0, "last");
  EXPECT_EQ(first, (LandmarkId{0, 0}));
  EXPECT_EQ(values(table), (std::vector<std::string>{"first", "second", "last", "later session"}));
  EXPECT_TRUE(table.erase(second));
  EXPECT_FALSE(table.erase(second));
  EXPECT_EQ(table.size(), 3U);
  EXPECT_EQ(table.nextId(0), (LandmarkId{0, 203})) << "an index is never given twice";
}

TEST(IdTable, ACopyDoesNotSeeWhatIsChangedAfterIt) {
  Table table;
  std::vector<LandmarkId> ids;
  for (int i = 0; i < 150; ++i) ids.push_back(table.add(0, std::to_string(i)));
  const Table copy = table;
  const auto before = values(copy);
  *table.edit(ids[3]) = "changed";
  table.erase(ids[100]);
  table.add(0, "new");
  table.add(2, "new session");
  EXPECT_EQ(values(copy), before);
  EXPECT_EQ(copy.size(), 150U);
  EXPECT_EQ(*table.find(ids[3]), "changed");
  EXPECT_EQ(table.find(ids[100]), nullptr);
  EXPECT_EQ(*copy.find(ids[100]), "100");
}

TEST(IdTable, ACopySharesWhatNeitherChanged) {
  Table table;
  for (int i = 0; i < 150; ++i) table.add(0, std::to_string(i));
  const Table copy = table;
  *table.edit({0, 10}) = "changed";
  EXPECT_NE(table.find({0, 10}), copy.find({0, 10}));
  EXPECT_EQ(table.find({0, 140}), copy.find({0, 140})) << "the very same object";
}

TEST(IdTable, OnlyChunksThatDifferAreVisited) {
  Table table;
  for (int i = 0; i < 200; ++i) table.add(0, std::to_string(i));
  table.add(1, "of session 1");
  const Table copy = table;
  const auto differences = [](const Table& now, const Table& then) {
    std::vector<std::string> found;
    std::size_t visited = 0;
    now.visitUnshared(then, [&](LandmarkId id, const std::string* mine, const std::string* other) {
      ++visited;
      if (mine && other && *mine == *other) return;
      found.push_back(toString(id) + ": " + (other ? *other : "none") + " -> " + (mine ? *mine : "none"));
    });
    return std::make_pair(found, visited);
  };
  EXPECT_EQ(differences(table, copy).second, 0U);
  *table.edit({0, 10}) = "changed";
  table.erase({0, 199});
  table.erase({1, 0});
  table.add(3, "new");
  const auto there = differences(table, copy);
  const std::vector<std::string> expected{
      toString(LandmarkId{0, 10}) + ": 10 -> changed", toString(LandmarkId{0, 199}) + ": 199 -> none",
      toString(LandmarkId{1, 0}) + ": of session 1 -> none", toString(LandmarkId{3, 0}) + ": none -> new"};
  EXPECT_EQ(there.first, expected);
  EXPECT_EQ(there.second, 64U + 8U + 1U + 1U) << "the chunks of 64 to 191 are shared";
  EXPECT_EQ(differences(copy, table).first.size(), 4U) << "the other way round";
}

TEST(IdTable, WhatIsNotThereIsNull) {
  Table table;
  EXPECT_EQ(table.find({0, 0}), nullptr);
  EXPECT_EQ(table.edit({0, 0}), nullptr);
  table.skip(0);
  EXPECT_EQ(table.find({0, 0}), nullptr);
  EXPECT_EQ(table.add(0, "after the hole"), (LandmarkId{0, 1}));
}

}  // namespace
}  // namespace omnimapper::base::id_table_test
