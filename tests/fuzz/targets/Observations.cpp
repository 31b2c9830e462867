#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/Visualizable.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/obs/registerClasses.h>

#include <new>
#include <vector>

#include "../Input.h"
#include "../Targets.h"

namespace omnimapper::fuzz {

namespace {

using mrpt::serialization::CSerializable;

constexpr std::uint8_t kEnd = 0x88;  // end mark of an object in MRPT's format

// The bytes of an object of that class in a log, whose fields are the fuzzer's bytes.
std::vector<std::uint8_t> asInLog(const std::string& class_name, std::uint8_t version, bool padded,
                                  const Input& fields) {
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(class_name.size() | 0x80)};
  bytes.insert(bytes.end(), class_name.begin(), class_name.end());
  bytes.push_back(version);
  bytes.insert(bytes.end(), fields.rest(), fields.rest() + fields.left());
  // With many end marks there is one wherever the last field ends.
  if (padded) bytes.insert(bytes.end(), 256, kEnd);
  return bytes;
}

std::vector<std::uint8_t> written(const CSerializable& object) {
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << object;
  const auto* data = static_cast<const std::uint8_t*>(stream.getRawBufferData());
  return {data, data + stream.getTotalBytesCount()};
}

CSerializable::Ptr read(const std::vector<std::uint8_t>& bytes) {
  mrpt::io::CMemoryStream stream(bytes.data(), bytes.size());
  return mrpt::serialization::archiveFrom(stream).ReadObject();
}

// Null if the bytes are refused. Running out of memory does not count as refusing them.
CSerializable::Ptr readOrNull(const std::vector<std::uint8_t>& bytes) {
  try {
    return read(bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::length_error&) {
    throw;
  } catch (const std::exception&) {
    return nullptr;
  }
}

}  // namespace

void observations(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const auto& classes = obs::allClasses();
  const auto* id = classes[input.take<std::uint8_t>() % classes.size()];
  const auto kind = input.take<std::uint8_t>();
  const auto version = static_cast<std::uint8_t>(kind / 2 < 120 ? 0 : kind);
  const auto object = readOrNull(asInLog(id->className, version, kind % 2 == 1, input));
  if (!object) return;
  require(object->GetRuntimeClass() == id, "an object of another class");
  // Calls the functions that MRPT's own tools call.
  const auto& observation = dynamic_cast<const mrpt::obs::CObservation&>(*object);
  require(!observation.asString().empty() && !observation.exportTxtDataRow().empty(), "no text");
  require(dynamic_cast<const mrpt::opengl::Visualizable&>(*object).getVisualization() != nullptr, "no picture");
  const auto bytes = written(*object);
  require(written(*read(bytes)) == bytes, "an object that is written and read again has other bytes");
}

}  // namespace omnimapper::fuzz
