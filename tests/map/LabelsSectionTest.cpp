#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/Labels.h>

#include <limits>

namespace omnimapper::map::labels_section_test {
namespace {

Labels someLabels() {
  Labels labels;
  labels.labels = {{"K\xC3\xBC"
                    "chentisch",
                    base::LandmarkId{1, 7},
                    {0, 3},
                    {1, -2, 0.75},
                    "anna",
                    base::stampFromUnix(1.6e9),
                    0.97},
                   {"charger", {}, {0, 4}, {0, 0, 0}, "", base::stampFromUnix(1.6e9 + 1e-7), 1}};
  labels.question = LabelQuestion{
      "cup", "ben", base::stampFromUnix(1.7e9), {0, 5}, {{{0, 2}, {1, 1, 1}, 0.6}, {{0, 3}, {2, 1, 1}, 0.3}}};
  return labels;
}

std::string refusal(const Labels& labels) {
  try {
    Labels::fromSection({Labels::kLayer, Labels::kLayerVersion, labels.toBytes()});
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    return error.what();
  }
  return "taken";
}

TEST(LabelsSection, isReadAsItWasWritten) {
  const Labels labels = someLabels();
  const Labels read = Labels::fromSection({Labels::kLayer, Labels::kLayerVersion, labels.toBytes()});
  EXPECT_EQ(read.toBytes(), labels.toBytes());
  ASSERT_EQ(read.labels.size(), 2u);
  EXPECT_EQ(read.labels[0].landmark, (base::LandmarkId{1, 7}));
  EXPECT_FALSE(read.labels[1].landmark);
  EXPECT_EQ(read.labels[1].when, base::stampFromUnix(1.6e9 + 1e-7));
  ASSERT_TRUE(read.question);
  EXPECT_EQ(read.question->choices[1].probability, 0.3);
  EXPECT_EQ(Labels::fromSection({Labels::kLayer, 1, Labels().toBytes()}).labels.size(), 0u);
}

TEST(LabelsSection, refersToWhatItNames) {
  const auto references = someLabels().references();
  EXPECT_EQ(references.key_frames.size(), 3u);
  EXPECT_EQ(references.landmarks.size(), 3u);
}

TEST(LabelsSection, damageIsRefused) {
  Labels labels = someLabels();
  EXPECT_EQ(refusal(labels), "taken");
  labels.labels[0].in_frame.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(labels).find("not finite"), std::string::npos);
  labels = someLabels();
  labels.labels[1].probability = 1.5;
  EXPECT_NE(refusal(labels).find("probability"), std::string::npos);
  labels = someLabels();
  labels.labels[0].text.clear();
  EXPECT_NE(refusal(labels).find("without text"), std::string::npos);
  labels = someLabels();
  labels.question->choices.clear();
  EXPECT_NE(refusal(labels).find("without choices"), std::string::npos);
  const std::string bytes = someLabels().toBytes();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(Labels::fromSection({Labels::kLayer, 1, bytes.substr(0, length)}), base::Error) << length;
  EXPECT_THROW(Labels::fromSection({Labels::kLayer, 1, bytes + "x"}), base::Error);
  EXPECT_THROW(Labels::fromSection({Labels::kLayer, 2, bytes}), base::Error);
  EXPECT_THROW(Labels::fromSection({"level", 1, bytes}), base::Error);
}

}  // namespace
}  // namespace omnimapper::map::labels_section_test
