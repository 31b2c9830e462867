#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/Visualizable.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/testing/Fixtures.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "FilledObjects.h"

namespace omnimapper::obs::serialization_test {
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

TEST(Serialization, everyClassIsRegisteredUnderItsQualifiedName) {
  registerClasses();
  registerClasses();
  ASSERT_FALSE(allClasses().empty());
  for (const auto* id : allClasses()) EXPECT_EQ(mrpt::rtti::findRegisteredClass(id->className), id);
}

TEST(Serialization, everyClassComesBackAsTheSameBytes) {
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

std::vector<char> contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// tests/obs/version_0 keeps filledObjects() as the first versions wrote them, and their text export. These files are
// never replaced; a later version of a class adds its own files.
TEST(Serialization, bytesOfVersion0AreReadAsWhatTheyWere) {
  registerClasses();
  for (const auto* id : allClasses()) {
    SCOPED_TRACE(id->className);
    const std::string name = id->className;
    const std::string stem = testing::sourceFile("tests/obs/version_0/" + name.substr(name.rfind(':') + 1));
    const auto bytes = contentOf(stem + ".bin"), text = contentOf(stem + ".txt");
    ASSERT_GT(bytes.size(), name.size() + 2);
    EXPECT_EQ(bytes[1 + name.size()], 0) << "the version, behind the name";
    const auto object = objectFrom(bytes);
    ASSERT_TRUE(object);
    EXPECT_EQ(object->GetRuntimeClass(), id);
    const auto& observation = dynamic_cast<const mrpt::obs::CObservation&>(*object);
    EXPECT_EQ(observation.exportTxtDataRow() + "\n", std::string(text.begin(), text.end()));
    EXPECT_FALSE(observation.sensorLabel.empty());
    EXPECT_EQ(base::formatUnix(observation.timestamp), "1137834225.9737601");
    const auto written = bytesOf(*object);
    if (written[1 + name.size()] == 0) {
      EXPECT_EQ(written, bytes);
    }
  }
}

// Planes of version 1 have a roughness.
TEST(Serialization, bytesOfPlanesOfVersion1AreReadAsWhatTheyWere) {
  const auto bytes = contentOf(testing::sourceFile("tests/obs/version_1/CObservationPlanes.bin"));
  const auto object = objectFrom(bytes);
  ASSERT_TRUE(object);
  const auto& planes = dynamic_cast<const CObservationPlanes&>(*object).planes;
  ASSERT_EQ(planes.size(), 2U);
  EXPECT_EQ(planes[0].roughness, 1.25);
  EXPECT_EQ(planes[1].roughness, 0);
  EXPECT_EQ(bytesOf(*object), bytes);
}

// Signs of version 1 state whether the edge of the image cuts them.
TEST(Serialization, bytesOfSignsOfVersion1AreReadAsWhatTheyWere) {
  const auto bytes = contentOf(testing::sourceFile("tests/obs/version_1/CObservationDoorSigns.bin"));
  const auto object = objectFrom(bytes);
  ASSERT_TRUE(object);
  const auto& signs = dynamic_cast<const CObservationDoorSigns&>(*object).signs;
  ASSERT_EQ(signs.size(), 2U);
  EXPECT_FALSE(signs[0].is_cut);
  EXPECT_TRUE(signs[1].is_cut);
  EXPECT_EQ(signs[0].texts.front().text, "Room 241");
  EXPECT_EQ(bytesOf(*object), bytes);
}

// A ray so long or so short that no picture can lie square to it.
TEST(Serialization, signsOfHopelessRaysAreDrawnWithoutTheirPatches) {
  const auto signs = filledSigns();
  for (const double scale : {1e300, 1e-300, 1e38, 1e-5, std::numeric_limits<double>::infinity()}) {
    for (auto& sign : signs->signs) sign.ray = Eigen::Vector3d(0.3, 0.1, 1) * scale;
    mrpt::opengl::CSetOfObjects scene;
    EXPECT_NO_THROW(signs->getVisualizationInto(scene)) << scale;
  }
}

TEST(Serialization, everyClassThrowsOnEveryTruncation) {
  for (const auto& [name, make] : filledObjects()) {
    const auto bytes = bytesOf(*make());
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_ANY_THROW(objectFrom({bytes.begin(), bytes.begin() + static_cast<long>(length)})) << name << " " << length;
  }
}

TEST(Serialization, everyClassRefusesAVersionFromTheFuture) {
  for (const auto& [name, make] : filledObjects()) {
    auto bytes = bytesOf(*make());
    // MRPT's header: length of the name with its top bit set, the name, the version.
    bytes[1 + name.size()] = 100;
    EXPECT_ANY_THROW(objectFrom(bytes)) << name;
  }
}

// Describes, exports and draws it, as a stock tool would.
void useAsStockToolsDo(const CSerializable& object) {
  const auto& observation = dynamic_cast<const mrpt::obs::CObservation&>(object);
  EXPECT_FALSE(observation.asString().empty());
  EXPECT_FALSE(observation.exportTxtDataRow().empty());
  EXPECT_TRUE(dynamic_cast<const mrpt::opengl::Visualizable&>(object).getVisualization());
}

TEST(Serialization, damagedBytesAreRefusedOrReadAndNeverTakeMoreMemoryThanThereIsData) {
  std::mt19937_64 engine(11);
  for (const auto& [name, make] : filledObjects()) {
    const auto bytes = bytesOf(*make());
    const std::size_t begin = name.size() + 2;
    int refused = 0;
    const auto tryBytes = [&](const std::vector<char>& damaged) {
      CSerializable::Ptr object;
      try {
        object = objectFrom(damaged);
      } catch (const std::exception&) {
        ++refused;
        return;
      }
      useAsStockToolsDo(*object);
    };
    for (std::size_t i = begin; i + 4 <= bytes.size(); i += 3) {
      auto damaged = bytes;
      std::memset(damaged.data() + i, 0xff,
                  4);  // one of these bytes belongs to a count, which becomes four thousand million
      tryBytes(damaged);
    }
    for (int i = 0; i < 500; ++i) {
      auto damaged = bytes;
      for (int k = 0; k < 4; ++k) damaged[begin + engine() % (bytes.size() - begin)] = static_cast<char>(engine());
      tryBytes(damaged);
    }
    EXPECT_GT(refused, 0) << name;
  }
}

TEST(Serialization, whatIsReadCanBeUsedAsWhatWasWritten) {
  for (const auto& [name, make] : filledObjects()) {
    const auto object = make();
    const auto copy = objectFrom(bytesOf(*object));
    const auto& was = dynamic_cast<const mrpt::obs::CObservation&>(*object);
    const auto& is = dynamic_cast<const mrpt::obs::CObservation&>(*copy);
    EXPECT_EQ(is.asString(), was.asString()) << name;
    EXPECT_EQ(is.exportTxtDataRow(), was.exportTxtDataRow()) << name;
    useAsStockToolsDo(is);
  }
}

TEST(Serialization, relativeMotionKeepsEveryNumber) {
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
}  // namespace omnimapper::obs::serialization_test
