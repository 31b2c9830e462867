#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/Prior.h>

#include <sstream>

#include "Worlds.h"
#include "omnimapper/graph/ByteIo.h"
#include "omnimapper/graph/GraphArchive.h"

namespace omnimapper::graph::graph_archive_test {
namespace {

using base::ExitCode;
using base::VariableId;

/// A graph with unused ids, two sessions, and every kind of variable and factor.
Graph richGraph() {
  World3 world = smallWorld(1);
  Graph& graph = world.graph;
  Noise noise(2);
  const VariableId planar = graph.addVariable(se2(), toValue(noise.se2()));
  const VariableId flat_point = graph.addVariable(point2(), Eigen::Vector2d(1.0 / 3, -0.0));
  graph.setSession(5);
  const VariableId point = graph.addVariable(point3(), noise.vector(1));
  const VariableId gone = graph.addVariable(point3(), noise.vector(1));
  graph.addVariable(point3(), noise.vector(1));
  const VariableId last = graph.addVariable(point3(), noise.vector(1));
  graph.removeVariable(gone);
  graph.removeVariable(last);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  covariance(0, 1) = covariance(1, 0) = 0.3;
  FactorRecord seen{{world.ids[2], point},
                    std::make_shared<PointFactor3>(noise.vector(2)),
                    SquareRootInformation::fromCovariance(covariance),
                    Loss::tukey(2.5),
                    0.1,
                    {"walls", base::LandmarkId{5, 77}, true, "gated at 7.2 > 5.99"}};
  const base::FactorId first = graph.addFactor(seen);
  graph.addFactor(seen);
  graph.removeFactor(first);
  graph.addFactor({{planar}, std::make_shared<PriorSe2>(noise.se2()), SquareRootInformation::identity(3)});
  graph.addFactor({{world.ids[1]}, std::make_shared<PriorSe3>(noise.se3()), SquareRootInformation::identity(6)});
  graph.addFactor({{planar, flat_point},
                   std::make_shared<PointFactor2>(Eigen::Vector2d(1, 2)),
                   SquareRootInformation::identity(2)});
  graph.addFactor(
      {{planar, world.ids[1]}, std::make_shared<BetweenSe3>(noise.se3()), SquareRootInformation::identity(6)});
  graph.removeFactor({0, 3});
  graph.setSession(6);
  return std::move(graph);
}

std::string bytesOf(const Graph& graph) {
  std::ostringstream out;
  writeGraph(graph, out);
  return out.str();
}

Graph fromBytes(const std::string& bytes, const FactorRegistry& registry = FactorRegistry::withBuiltIns()) {
  std::istringstream in(bytes);
  return readGraph(in, registry);
}

ExitCode codeOf(const std::string& bytes, std::string* message = nullptr,
                const FactorRegistry& registry = FactorRegistry::withBuiltIns()) {
  try {
    fromBytes(bytes, registry);
  } catch (const base::Error& error) {
    if (message) *message = error.what();
    return error.code();
  }
  return ExitCode::ok;
}

TEST(GraphArchive, SavedReadAndSavedAgainGivesTheSameBytes) {
  const std::string bytes = bytesOf(richGraph());
  EXPECT_EQ(bytesOf(fromBytes(bytes)), bytes);
}

TEST(GraphArchive, WhatIsReadIsTheSameGraph) {
  const Graph graph = richGraph();
  Graph back = fromBytes(bytesOf(graph));
  ASSERT_EQ(back.variables().size(), graph.variables().size());
  ASSERT_EQ(back.factors().size(), graph.factors().size());
  for (const auto& [id, record] : graph.variables()) {
    const VariableRecord& same = back.variable(id);
    EXPECT_EQ(same.kind, record.kind);
    EXPECT_EQ(same.value, record.value);
    EXPECT_EQ(same.fixed, record.fixed);
    EXPECT_EQ(same.factors, record.factors);
  }
  for (const auto& [id, record] : graph.factors()) {
    const FactorRecord& same = back.factor(id);
    EXPECT_EQ(same.variables, record.variables);
    EXPECT_EQ(same.noise.matrix(), record.noise.matrix());
    EXPECT_EQ(same.loss.kind(), record.loss.kind());
    EXPECT_EQ(same.loss.scale(), record.loss.scale());
    EXPECT_EQ(same.weight, record.weight);
    EXPECT_EQ(same.tags.owner, record.tags.owner);
    EXPECT_EQ(same.tags.landmark, record.tags.landmark);
    EXPECT_EQ(same.tags.hypothesis, record.tags.hypothesis);
    EXPECT_EQ(same.tags.note, record.tags.note);
  }
  EXPECT_EQ(back.cost(), graph.cost());
  EXPECT_EQ(back.session(), graph.session());
}

TEST(GraphArchive, RemovedIdsAreNotGivenAgain) {
  Graph graph = richGraph(), back = fromBytes(bytesOf(graph));
  graph.setSession(5);
  back.setSession(5);
  EXPECT_EQ(back.addVariable(point2(), Eigen::Vector2d(0, 0)), graph.addVariable(point2(), Eigen::Vector2d(0, 0)));
}

TEST(GraphArchive, LeavesTheStreamBehindTheGraph) {
  std::stringstream stream;
  writeGraph(richGraph(), stream);
  writeText(stream, "next");
  readGraph(stream, FactorRegistry::withBuiltIns());
  EXPECT_EQ(readText(stream), "next");
}

TEST(GraphArchive, AnEmptyGraphSurvives) {
  EXPECT_EQ(bytesOf(fromBytes(bytesOf(Graph(3)))), bytesOf(Graph(3)));
}

TEST(GraphArchive, EveryCutIsNoticed) {
  const std::string bytes = bytesOf(richGraph());
  for (std::size_t length = 0; length < bytes.size(); length += 7)
    EXPECT_EQ(codeOf(bytes.substr(0, length)), ExitCode::damaged_input) << length;
}

// Unused ids take memory, so their number is bounded, over all sessions together, whatever number of entries the file
// states.
TEST(GraphArchive, SessionsThatSayTheyGaveTooManyIdsAreRefused) {
  const auto graph = [](std::uint64_t sessions, std::uint64_t ids, std::uint64_t entries) {
    std::stringstream out;
    writeText(out, "omnimapper.graph");
    writeUint(out, 1, 4);
    writeUint(out, 0, 2);
    writeUint(out, sessions, 4);
    for (std::uint64_t session = 0; session < sessions; ++session) writeUint(out, session, 2), writeUint(out, ids, 4);
    writeUint(out, entries, 4);
    writeUint(out, 0, 2);
    writeUint(out, ids - 1, 4);
    return out.str();
  };
  EXPECT_EQ(codeOf(graph(65'535, 1'000'000, 0)), ExitCode::damaged_input);
  EXPECT_EQ(codeOf(graph(1, 4'000'000'000, 5'000'000)), ExitCode::damaged_input);
}

TEST(GraphArchive, FlippedBytesNeverDoWorseThanAnError) {
  const std::string bytes = bytesOf(richGraph());
  for (std::size_t place = 0; place < bytes.size(); place += 5) {
    std::string damaged = bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x55);
    const ExitCode code = codeOf(damaged);
    EXPECT_TRUE(code == ExitCode::ok || code == ExitCode::damaged_input || code == ExitCode::unreadable_input ||
                code == ExitCode::unregistered_class)
        << place;
  }
}

TEST(GraphArchive, AnUnknownKindIsNamed) {
  FactorRegistry registry;
  registry.add(se3());
  registry.add(se2());
  registry.add(point2());
  registry.add(point3());
  std::string message;
  EXPECT_EQ(codeOf(bytesOf(richGraph()), &message, registry), ExitCode::unregistered_class);
  EXPECT_NE(message.find("between_se3"), std::string::npos) << message;
  EXPECT_EQ(codeOf(bytesOf(richGraph()), &message, FactorRegistry()), ExitCode::unregistered_class);
  EXPECT_NE(message.find("se3"), std::string::npos) << message;
}

TEST(GraphArchive, AFutureVersionIsNamed) {
  std::string bytes = bytesOf(Graph());
  const std::size_t version = 4 + std::string("omnimapper.graph").size();
  bytes[version] = 9;
  std::string message;
  EXPECT_EQ(codeOf(bytes, &message), ExitCode::unreadable_input);
  EXPECT_NE(message.find('9'), std::string::npos);
}

TEST(FactorRegistry, RefusesAKindTwice) {
  FactorRegistry registry = FactorRegistry::withBuiltIns();
  EXPECT_THROW(registry.add(se2()), base::Error);
  EXPECT_THROW(registry.add("between_se2", [](std::istream&) { return nullptr; }), base::Error);
}

TEST(ByteIo, IsLittleEndianAndKeepsEveryBit) {
  std::stringstream stream;
  writeUint(stream, 0x0102, 2);
  EXPECT_EQ(stream.str(), std::string("\x02\x01", 2));
  const double numbers[] = {0.1, -0.0, 5e-324, 1.7976931348623157e308};
  for (const double number : numbers) writeDouble(stream, number);
  EXPECT_EQ(readUint(stream, 2), 0x0102u);
  for (const double number : numbers) {
    const double back = readDouble(stream);
    EXPECT_EQ(std::signbit(back), std::signbit(number));
    EXPECT_EQ(back, number);
  }
}

}  // namespace
}  // namespace omnimapper::graph::graph_archive_test
