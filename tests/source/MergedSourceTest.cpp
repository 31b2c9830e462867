#include <omnimapper/source/MergedSource.h>
#include <omnimapper/testing/Logs.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>

namespace omnimapper::source::merged_source_test {
namespace {

using namespace logs;
using Strings = std::vector<std::string>;

MergedSource merged(const std::vector<std::pair<std::string, std::vector<double>>>& inputs) {
  std::vector<std::unique_ptr<ObservationSource>> sources;
  for (const auto& [label, seconds] : inputs) sources.push_back(std::make_unique<ListSource>(label, seconds));
  return MergedSource(std::move(sources));
}

Strings mergedListing(const std::vector<std::pair<std::string, std::vector<double>>>& inputs) {
  auto source = merged(inputs);
  return listing(readAll(source));
}

TEST(MergedSource, sortsByStamp) {
  EXPECT_EQ(mergedListing({{"a", {1, 4}}, {"b", {2, 3, 5}}}), (Strings{"a 1", "b 2", "b 3", "a 4", "b 5"}));
}

TEST(MergedSource, equalStampsGoInTheOrderOfTheSources) {
  EXPECT_EQ(mergedListing({{"a", {1, 2}}, {"b", {1, 2}}}), (Strings{"a 1", "b 1", "a 2", "b 2"}));
  EXPECT_EQ(mergedListing({{"b", {1, 2}}, {"a", {1, 2}}}), (Strings{"b 1", "a 1", "b 2", "a 2"}));
}

TEST(MergedSource, backwardStampsAndMissingOnesKeepTheirPlaceInTheirSource) {
  EXPECT_EQ(mergedListing({{"a", {1, 5, 2, 6}}, {"b", {3, 5.5}}}),
            (Strings{"a 1", "b 3", "a 5", "a 2", "b 5.5", "a 6"}));
  EXPECT_EQ(mergedListing({{"a", {1, 0, 3}}, {"b", {0, 2}}}), (Strings{"b 0", "a 1", "a 0", "b 2", "a 3"}));
}

TEST(MergedSource, keepsEachSourcesOrderAndLosesNothing) {
  testing::Dice dice(11);
  std::vector<std::pair<std::string, std::vector<double>>> inputs;
  for (const char* label : {"a", "b", "c"}) {
    std::vector<double> seconds;
    for (double t = 1; seconds.size() < 200; t += dice.uniform(-0.3, 1)) seconds.push_back(std::max(0.5, t));
    inputs.emplace_back(label, seconds);
  }
  auto source = merged(inputs);
  const auto all = readAll(source);
  EXPECT_EQ(all.size(), 600u);
  for (const auto& [label, seconds] : inputs) {
    Strings expected, got;
    for (const double s : seconds) expected.push_back(listing({odometry(s, 0, label)})[0]);
    for (const auto& observation : all)
      if (observation->sensorLabel == label) got.push_back(listing({observation})[0]);
    EXPECT_EQ(got, expected);
  }
  EXPECT_EQ(source.report().observations(), 600u);
}

TEST(MergedSource, reportIsTheSumAndTheWorstEnding) {
  auto good = std::make_unique<ListSource>("a", std::vector<double>{1, 2});
  auto bad = std::make_unique<ListSource>("b", std::vector<double>{3});
  bad->report_.ending = SourceReport::Ending::corrupt;
  bad->report_.message = "b is corrupt.";
  std::vector<std::unique_ptr<ObservationSource>> sources;
  sources.push_back(std::move(good));
  sources.push_back(std::move(bad));
  MergedSource source(std::move(sources));
  readAll(source);
  const auto report = source.report();
  EXPECT_EQ(report.ending, SourceReport::Ending::corrupt);
  EXPECT_EQ(report.message, "b is corrupt.");
  EXPECT_EQ(report.sensors.size(), 2u);
  EXPECT_EQ(report.observations(), 3u);
}

bool hasLogsApart(const std::vector<std::pair<std::string, std::vector<double>>>& inputs) {
  auto source = merged(inputs);
  readAll(source);
  return source.report().has_logs_apart;
}

TEST(MergedSource, reportsThatALogLiesFarFromAllOthersInTime) {
  EXPECT_FALSE(hasLogsApart({{"a", {1, 10}}, {"b", {5, 20}}}));
  EXPECT_FALSE(hasLogsApart({{"a", {1, 10}}, {"b", {12, 20}}})) << "the next part of one log";
  EXPECT_TRUE(hasLogsApart({{"a", {1, 10}}, {"b", {3600, 3610}}}));
  EXPECT_TRUE(hasLogsApart({{"a", {3600, 3610}}, {"b", {1, 10}}, {"c", {2, 12}}}));
  EXPECT_FALSE(hasLogsApart({{"a", {1, 1000}}, {"b", {500, 510}}})) << "one within the other";
  EXPECT_FALSE(hasLogsApart({{"a", {1, 10}}, {"b", {}}})) << "a log without stamps is not judged";
  EXPECT_FALSE(hasLogsApart({{"a", {1, 10}}}));
  std::vector<std::unique_ptr<ObservationSource>> sources;
  for (const double start : {1.0, 3600.0}) {
    auto source = std::make_unique<ListSource>("a", std::vector<double>{start, start + 9});
    source->report_.ending = SourceReport::Ending::open;
    sources.push_back(std::move(source));
  }
  EXPECT_FALSE(MergedSource(std::move(sources)).report().has_logs_apart) << "not read to its end, nothing is known";
}

TEST(MergedSource, readsNothingBeforeItIsAsked) {
  auto list = std::make_unique<ListSource>("a", std::vector<double>{1, 2});
  const auto& report = list->report_;
  std::vector<std::unique_ptr<ObservationSource>> sources;
  sources.push_back(std::move(list));
  MergedSource source(std::move(sources));
  EXPECT_EQ(report.observations(), 0u);
  EXPECT_NE(source.next(), nullptr);
}

TEST(MergedSource, noSourceIsAnEmptyStream) {
  MergedSource source({});
  EXPECT_EQ(source.next(), nullptr);
  EXPECT_EQ(source.report().ending, SourceReport::Ending::complete);
}

}  // namespace
}  // namespace omnimapper::source::merged_source_test
