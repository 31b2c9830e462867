#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/Prior.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/Batch.h>

#include <functional>
#include <limits>
#include <sstream>

namespace omnimapper::mapper::batch_test {
namespace {

using graph::FactorRecord;
using graph::Graph;
using graph::SquareRootInformation;

FactorRecord between(base::VariableId a, base::VariableId b) {
  return {
      {a, b}, std::make_shared<graph::BetweenSe2>(geometry::Se2{1, 0, 0}), SquareRootInformation::identity(3), {}, 1,
      {}};
}

// Noise of two rows for a residual of three.
FactorRecord invalid(base::VariableId a) {
  return {{a}, std::make_shared<graph::PriorSe2>(geometry::Se2{}), SquareRootInformation::identity(2), {}, 1, {}};
}

struct TwoPoses {
  map::Map map;
  Graph graph;
  base::VariableId a = graph.addVariable(graph::se2(), Eigen::Vector3d(0, 0, 0), true);
  base::VariableId b = graph.addVariable(graph::se2(), Eigen::Vector3d(1, 0, 0));
  base::FactorId link = graph.addFactor(between(a, b));
};

// The whole content of a graph, as text.
std::string content(const Graph& graph) {
  std::ostringstream text;
  for (const auto& [id, record] : graph.variables()) {
    text << id << ' ' << record.kind->kind() << ' ' << record.value.transpose() << ' ' << record.fixed;
    for (const auto factor : record.factors) text << ' ' << factor;
    text << '\n';
  }
  for (const auto& [id, record] : graph.factors()) {
    text << id << ' ' << record.factor->kind() << ' ' << record.weight;
    for (const auto variable : record.variables) text << ' ' << variable;
    text << '\n';
  }
  return text.str();
}

TEST(Batch, AHypothesisThatDoesNotSayWhereAWrongOneMayLieIsAnError) {
  TwoPoses two;
  const FactorRecord prior{
      {two.b}, std::make_shared<graph::PriorSe2>(geometry::Se2{}), SquareRootInformation::identity(3)};
  Batch batch;
  EXPECT_THROW(batch.addHypothesis(prior, {}), base::Error);
  EXPECT_TRUE(batch.empty());
  batch.addGatedHypothesis(prior, {});
  batch.addHypothesis(between(two.a, two.b), {});
  ASSERT_EQ(batch.addedFactors().size(), 2U);
  for (const auto& record : batch.addedFactors()) EXPECT_TRUE(record.tags.hypothesis);
  for (const auto& decision : batch.decisions()) EXPECT_TRUE(decision.hypothesis);
}

TEST(Batch, ProvisionalIdsBecomeFinalOnesInTheOrderTheyWereAdded) {
  TwoPoses two;
  Batch batch;
  EXPECT_TRUE(batch.empty());
  const auto c = batch.addVariable(graph::se2(), Eigen::Vector3d(2, 0, 0));
  const auto d = batch.addVariable(graph::se2(), Eigen::Vector3d(3, 0, 0), true);
  EXPECT_TRUE(Batch::isProvisional(c));
  EXPECT_FALSE(Batch::isProvisional(two.a));
  EXPECT_NE(c, d);
  batch.addFactor(between(two.b, d));
  batch.addFactor(between(two.b, c));
  EXPECT_FALSE(batch.empty());

  const auto applied = apply(batch, {}, two.graph, two.map);
  ASSERT_EQ(applied.variables.size(), 2U);
  ASSERT_EQ(applied.factors.size(), 2U);
  for (const auto id : applied.variables) EXPECT_FALSE(Batch::isProvisional(id));
  EXPECT_EQ(two.graph.value(applied.variables[0]).x(), 2);
  EXPECT_EQ(two.graph.value(applied.variables[1]).x(), 3);
  EXPECT_FALSE(two.graph.variable(applied.variables[0]).fixed);
  EXPECT_TRUE(two.graph.variable(applied.variables[1]).fixed);
  EXPECT_EQ(two.graph.factor(applied.factors[0]).variables, (std::vector{two.b, applied.variables[1]}));
  EXPECT_EQ(two.graph.factor(applied.factors[1]).variables, (std::vector{two.b, applied.variables[0]}));
}

// A layer that refers to a variable.
struct Anchor {
  static constexpr char kLayer[] = "anchor";
  static constexpr std::uint32_t kLayerVersion = 1;
  base::VariableId at;
  std::string toBytes() const { return toString(at); }
  map::LayerReferences references() const { return {{}, {}, {at}}; }
};

TEST(Batch, SetsReplacesAndRemovesLayers) {
  TwoPoses two;
  Batch batch;
  batch.setLayer(Anchor{two.a});
  EXPECT_FALSE(batch.empty());
  EXPECT_FALSE(batch.changesGraph());
  apply(batch, {}, two.graph, two.map);
  EXPECT_EQ(two.map.layers.find<Anchor>()->at, two.a);
  Batch again;
  again.setLayer(Anchor{two.b});
  apply(again, {}, two.graph, two.map);
  EXPECT_EQ(two.map.layers.find<Anchor>()->at, two.b);
  Batch last;
  last.removeLayer(Anchor::kLayer);
  apply(last, {}, two.graph, two.map);
  EXPECT_TRUE(two.map.layers.empty());
}

TEST(Batch, KeepsWhatLayersReferTo) {
  TwoPoses two;
  Batch lost;
  lost.setLayer(Anchor{{7, 7}});
  EXPECT_NE(whyUnfit(lost, two.graph, two.map).find("anchor"), std::string::npos);
  Batch named;
  named.setLayer(Anchor{two.a}, "frames");
  EXPECT_NE(whyUnfit(named, two.graph, two.map), "") << "the name of another section of a map file";
  EXPECT_TRUE(two.map.layers.empty());
  two.map.layers.set(Anchor{two.b});
  Batch removing;
  removing.removeFactor(two.link);
  removing.removeVariable(two.b);
  EXPECT_NE(whyUnfit(removing, two.graph, two.map).find("anchor"), std::string::npos);
  Batch both = removing;
  both.setLayer(Anchor{two.b});
  EXPECT_NE(whyUnfit(both, two.graph, two.map), "") << "it is removed and referred to in the same batch";
  removing.setLayer(Anchor{two.a});
  EXPECT_EQ(whyUnfit(removing, two.graph, two.map), "");
  map::Landmark a, b;
  a.variables = {two.a};
  b.variables = {two.b};
  const auto kept = two.map.landmarks.add(0, a), gone = two.map.landmarks.add(0, b);
  Batch merging;
  merging.mergeLandmarks(gone, kept);
  EXPECT_NE(whyUnfit(merging, two.graph, two.map).find("anchor"), std::string::npos) << "a merge removes variables";
}

TEST(Batch, RemovesFactorsAndSetsWeights) {
  TwoPoses two;
  const auto second = two.graph.addFactor(between(two.a, two.b));
  Batch batch;
  batch.removeFactor(two.link);
  batch.setWeight(second, 0.25);
  apply(batch, {}, two.graph, two.map);
  EXPECT_FALSE(two.graph.contains(two.link));
  EXPECT_EQ(two.graph.factor(second).weight, 0.25);
}

// Each edit alone does not fit; good edits before and after it must not be left in the graph.
TEST(Batch, WhereOneEditDoesNotFitTheGraphIsLeftAsItWas) {
  const base::FactorId unknown{0, 77};
  const std::vector<std::pair<std::string, std::function<void(const TwoPoses&, Batch&)>>> bad_edits{
      {"factor with noise of another size", [](const TwoPoses& two, Batch& b) { b.addFactor(invalid(two.b)); }},
      {"factor on an unknown variable",
       [](const TwoPoses& two, Batch& b) {
         b.addFactor(between(two.a, {0, 99}));
       }},
      {"factor on a provisional variable of nobody",
       [](const TwoPoses& two, Batch& b) {
         b.addFactor(between(two.a, {Batch::kProvisionalSession, 5}));
       }},
      {"variable that is not finite",
       [](const TwoPoses&, Batch& b) {
         b.addVariable(graph::se2(), Eigen::Vector3d(0, std::numeric_limits<double>::quiet_NaN(), 0));
       }},
      {"removal of what is not there", [&](const TwoPoses&, Batch& b) { b.removeFactor(unknown); }},
      {"removal of one thing twice",
       [](const TwoPoses& two, Batch& b) {
         b.removeFactor(two.link);
         b.removeFactor(two.link);
       }},
      {"weight of what is not there", [&](const TwoPoses&, Batch& b) { b.setWeight(unknown, 1); }},
      {"negative weight", [](const TwoPoses& two, Batch& b) { b.setWeight(two.link, -1); }},
      {"infinite weight",
       [](const TwoPoses& two, Batch& b) { b.setWeight(two.link, std::numeric_limits<double>::infinity()); }},
      {"weight that is no number",
       [](const TwoPoses& two, Batch& b) { b.setWeight(two.link, std::numeric_limits<double>::quiet_NaN()); }},
  };
  for (const auto& [what, edit] : bad_edits) {
    TwoPoses two;
    const auto removable = two.graph.addFactor(between(two.a, two.b));
    const std::string before = content(two.graph);
    Batch batch;
    const auto c = batch.addVariable(graph::se2(), Eigen::Vector3d(2, 0, 0));
    batch.addFactor(between(two.b, c));
    batch.removeFactor(removable);
    batch.setWeight(two.link, 0.5);
    edit(two, batch);
    batch.addFactor(between(two.a, c));
    try {
      apply(batch, {}, two.graph, two.map);
      FAIL() << what << " was applied";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::internal) << what;
    }
    EXPECT_EQ(content(two.graph), before) << what;
  }
}

}  // namespace
}  // namespace omnimapper::mapper::batch_test
