#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/obs/registerClasses.h>

#include <cstring>
#include <functional>
#include <map>

namespace omnimapper::obs {
namespace {

using mrpt::serialization::archiveFrom;
using mrpt::serialization::CSerializable;

std::vector<char> bytesOf(const CSerializable& object) {
  mrpt::io::CMemoryStream stream;
  archiveFrom(stream) << object;
  const char* data = static_cast<const char*>(stream.getRawBufferData());
  return std::vector<char>(data, data + stream.getTotalBytesCount());
}

CSerializable::Ptr objectFrom(const std::vector<char>& bytes) {
  mrpt::io::CMemoryStream stream(bytes.data(), bytes.size());
  return archiveFrom(stream).ReadObject();
}

// An object of each class with every field off its default.
std::map<std::string, std::function<CSerializable::Ptr()>> filledObjects() {
  return {{"omnimapper::obs::CObservationRelativeMotion", [] {
             auto& random = mrpt::random::getRandomGenerator();
             random.randomize(7);
             auto motion = CObservationRelativeMotion::Create();
             motion->timestamp = base::parseUnix("1137834225.9737601");
             motion->begin = base::parseUnix("1137834225.8737603");
             motion->sensorLabel = "visual odometry";
             motion->begin_from_end = mrpt::poses::CPose3D(0.1, -1.0 / 3.0, 1e-17, 3.0, -1.5, 0.7);
             for (int i = 0; i < 36; ++i) motion->covariance(i) = random.drawUniform(-1.0, 1.0);
             return motion;
           }}};
}

TEST(Serialisation, everyClassIsRegisteredUnderItsQualifiedName) {
  registerClasses();
  registerClasses();
  ASSERT_FALSE(allClasses().empty());
  for (const auto* id : allClasses()) EXPECT_EQ(mrpt::rtti::findRegisteredClass(id->className), id);
}

TEST(Serialisation, everyClassComesBackAsTheSameBytes) {
  const auto filled = filledObjects();
  for (const auto* id : allClasses()) {
    SCOPED_TRACE(id->className);
    ASSERT_TRUE(filled.count(id->className)) << "give this test an object of the new class";
    const auto object = filled.at(id->className)();
    const auto bytes = bytesOf(*object);
    const auto copy = objectFrom(bytes);
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->GetRuntimeClass(), id);
    EXPECT_EQ(bytesOf(*copy), bytes);
    const auto empty = std::dynamic_pointer_cast<CSerializable>(id->createObject());
    EXPECT_NE(bytesOf(*empty), bytes);
    EXPECT_EQ(bytesOf(*objectFrom(bytesOf(*empty))), bytesOf(*empty));
  }
}

TEST(Serialisation, everyClassThrowsOnEveryTruncation) {
  for (const auto& [name, make] : filledObjects()) {
    const auto bytes = bytesOf(*make());
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_ANY_THROW(objectFrom({bytes.begin(), bytes.begin() + static_cast<long>(length)})) << name << " " << length;
  }
}

TEST(Serialisation, everyClassRefusesAVersionFromTheFuture) {
  for (const auto& [name, make] : filledObjects()) {
    auto bytes = bytesOf(*make());
    // MRPT's header: length of the name with its top bit set, the name, the version.
    bytes[1 + name.size()] = 100;
    EXPECT_ANY_THROW(objectFrom(bytes)) << name;
  }
}

TEST(Serialisation, relativeMotionKeepsEveryNumber) {
  const auto object = std::dynamic_pointer_cast<CObservationRelativeMotion>(
      filledObjects().at("omnimapper::obs::CObservationRelativeMotion")());
  const auto copy = std::dynamic_pointer_cast<CObservationRelativeMotion>(objectFrom(bytesOf(*object)));
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->timestamp, object->timestamp);
  EXPECT_EQ(copy->begin, object->begin);
  EXPECT_EQ(copy->sensorLabel, object->sensorLabel);
  EXPECT_EQ(copy->begin_from_end.m_coords, object->begin_from_end.m_coords);
  EXPECT_EQ(copy->begin_from_end.getRotationMatrix(), object->begin_from_end.getRotationMatrix());
  EXPECT_EQ(copy->covariance, object->covariance);
}

}  // namespace
}  // namespace omnimapper::obs
