#pragma once

#include <gtest/gtest.h>
#include <omnimapper/plugin/View.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

// Properties of map and graph that must hold after any edit.
namespace omnimapper::testing {

/// Between neighbours in time of a session, and nowhere else, each source of `sources` has at most one factor and all
/// together at least one: no time span is left out, and none is counted twice.
inline void expectOneChain(const mapper::View& view, const std::set<std::string>& sources) {
  const auto& frames = view.map.key_frames;
  std::map<base::VariableId, std::size_t> position;
  for (std::size_t i = 0; i < frames.size(); ++i) position[frames[i].pose] = i;
  std::map<std::size_t, std::multiset<std::string>> links;  // by the earlier key frame
  for (const auto& [id, record] : view.graph.factors()) {
    if (sources.count(record.tags.owner) == 0) continue;
    ASSERT_EQ(record.variables.size(), 2U);
    const std::size_t begin = position.at(record.variables[0]), end = position.at(record.variables[1]);
    EXPECT_EQ(begin + 1, end) << "factor " << id << " of " << record.tags.owner << " leaps over a key frame";
    links[begin].insert(record.tags.owner);
  }
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    if (frames[i].id.session != frames[i + 1].id.session) continue;
    EXPECT_LT(frames[i].stamp, frames[i + 1].stamp);
    EXPECT_FALSE(links[i].empty()) << "nothing links key frame " << frames[i].id << " to the next";
    for (const auto& source : links[i]) EXPECT_EQ(links[i].count(source), 1U) << source << " is counted twice";
  }
}

/// Every id that is used anywhere exists.
inline void expectNothingDangles(const mapper::State& state) {
  std::map<base::VariableId, std::set<base::FactorId>> bound;
  for (const auto& [id, record] : state.graph.factors()) {
    for (const auto variable : record.variables) {
      EXPECT_TRUE(state.graph.contains(variable)) << "factor " << id << " binds " << variable;
      bound[variable].insert(id);
    }
    if (!record.tags.landmark) continue;
    const auto* landmark = state.map.landmarks.find(*record.tags.landmark);
    ASSERT_NE(landmark, nullptr) << "factor " << id << " speaks of a landmark that is not there";
    EXPECT_NE(landmark->state, map::Landmark::State::merged) << "factor " << id << " speaks of a merged landmark";
  }
  for (const auto& [id, record] : state.graph.variables()) {
    EXPECT_TRUE(record.value.allFinite());
    EXPECT_EQ(std::set<base::FactorId>(record.factors.begin(), record.factors.end()), bound[id]);
    EXPECT_EQ(record.factors.size(), bound[id].size());
  }
  for (const auto& frame : state.map.key_frames) EXPECT_TRUE(state.graph.contains(frame.pose));
  for (const auto& [id, landmark] : state.map.landmarks) {
    if (landmark.state == map::Landmark::State::merged) {
      EXPECT_TRUE(landmark.variables.empty());
      EXPECT_EQ(state.map.landmark(id).state == map::Landmark::State::merged, false);
    }
    for (const auto variable : landmark.variables) EXPECT_TRUE(state.graph.contains(variable));
  }
}

}  // namespace omnimapper::testing
