#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <limits>
#include <sstream>

#include "object_landmarks/ObjectPayload.h"

namespace omnimapper::plugins::object_payload_test {
namespace {

std::string bytesOf(const ObjectPayload& payload) {
  std::ostringstream out;
  payload.write(out);
  return out.str();
}

std::shared_ptr<const map::LandmarkPayload> readAgain(const std::string& bytes) {
  map::PayloadRegistry registry;
  ObjectPayload::addTo(registry);
  return registry.read("object", bytes);
}

ObjectPayload full() {
  ObjectPayload payload;
  ObjectView view;
  view.frame = {0, 0};
  view.distance = 1.5;
  view.foot = Eigen::Vector3d(1, 0, 0.7);
  view.points = {{1, 0, 0.75F}, {1, 0.1F, 0.8F}, {1.1F, 0, 0.9F}};
  view.colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  ObjectView plain = view;
  plain.foot.reset();
  plain.colours.clear();
  payload.model = std::make_shared<const ObjectModel>(std::vector<ObjectView>{view, plain});
  payload.evidence.add(Sight::seen, base::stampFromUnix(1'000'000'000));
  payload.measured_in = 4;
  payload.is_confirmed = true;
  payload.classes["mug"] = 0.5;
  payload.seen_by["kinect"] = 4;
  map::Photograph photograph{2, 1, {1, 2, 3, 4, 5, 6}};
  payload.picture = ObjectPicture{120, std::make_shared<const map::Photograph>(photograph)};
  payload.on = base::LandmarkId{0, 3};
  return payload;
}

TEST(ObjectPayload, IsReadAsItWasWritten) {
  for (const auto& payload : {ObjectPayload(), full()}) {
    const std::string bytes = bytesOf(payload);
    const auto read = std::dynamic_pointer_cast<const ObjectPayload>(readAgain(bytes));
    ASSERT_TRUE(read);
    EXPECT_EQ(bytesOf(*read), bytes);
  }
}

TEST(ObjectPayload, DamageIsRefused) {
  const std::string bytes = bytesOf(full());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(readAgain(bytes.substr(0, size)), base::Error) << size;
  EXPECT_THROW(readAgain(bytes + "x"), base::Error);
  std::string later = bytes;
  later[0] = 9;
  EXPECT_THROW(readAgain(later), base::Error) << "of a later version";
  // No byte of it, changed to any of some values, leads to a crash or to a number that is not finite.
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const char value : {'\0', '\x7F', '\xFF'}) {
      std::string changed = bytes;
      changed[i] = value;
      try {
        const auto read = std::dynamic_pointer_cast<const ObjectPayload>(readAgain(changed));
        for (const auto& view : read->model->views())
          for (const auto& point : view.points) EXPECT_TRUE(point.allFinite());
      } catch (const base::Error&) {
      }
    }
  }
}

TEST(ObjectPayload, AClassWhoseScoreIsNoNumberIsRefused) {
  ObjectPayload payload = full();
  payload.classes["cup"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(readAgain(bytesOf(payload)), base::Error);
}

TEST(ObjectPayload, ShowsABoxAPictureAndTheEvidence) {
  testing::HandMadeRun run;
  run.addFrame({});
  const auto payload = full();
  const auto shape = payload.shape({Eigen::Vector3d(1, 0, 0.8)}, run.map.key_frames);
  EXPECT_EQ(shape.label, "mug");
  EXPECT_FALSE(shape.is_candidate);
  ASSERT_TRUE(shape.box);
  EXPECT_NEAR(shape.box->middle.z() - 0.5 * shape.box->size.z(), 0.7, 1e-4) << "on its surface";
  EXPECT_TRUE(shape.photograph);
  EXPECT_EQ(shape.seen_by.at("kinect"), 4U);
  std::map<std::string, std::string> texts;
  for (const auto& property : shape.properties) texts[map::keyOf(property)] = map::textOf(property);
  EXPECT_EQ(texts.at("seen_in"), "1");
  EXPECT_EQ(texts.at("on"), "0:3");
  ObjectPayload unnamed = payload;
  unnamed.classes.clear();
  unnamed.is_confirmed = false;
  EXPECT_EQ(unnamed.shape({}, run.map.key_frames).label, "object");
  EXPECT_TRUE(unnamed.shape({}, run.map.key_frames).is_candidate);
}

TEST(ObjectPayload, OfTwoThatAreOneHasTheMeasurementsOfBoth) {
  testing::HandMadeRun run;
  run.addFrame({});
  const auto one = full();
  auto other = full();
  other.picture->pixels = 500;
  other.seen_by = {{"xtion", 2}};
  const auto both = one.with(other, run.map.key_frames, {});
  EXPECT_EQ(both->measured_in, 8U);
  EXPECT_EQ(both->evidence.seen_in, 2U);
  EXPECT_EQ(both->picture->pixels, 500) << "the larger picture";
  EXPECT_EQ(both->seen_by.size(), 2U);
  EXPECT_EQ(both->model->size(), 3U) << "the points are at the same places";
}

}  // namespace
}  // namespace omnimapper::plugins::object_payload_test
