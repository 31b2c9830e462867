#include "ObjectReader.h"

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CRawlog.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace omnimapper::source {

using mrpt::serialization::CSerializable;

namespace {

// Whether this can be the name of a C++ class; bytes of damaged data hardly ever are.
bool isClassName(const std::string& name) {
  if (name.size() < 3 || !(std::isalpha(static_cast<unsigned char>(name[0])) || name[0] == '_')) return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == ':' || c == '<' || c == '>' || c == ',' || c == ' ';
  });
}

// The class that MRPT's exception names for an object inside another one; empty if it is about something else.
std::string unregisteredClassIn(const std::string& exception) {
  const auto not_registered = exception.find("which is not registered");
  if (not_registered == std::string::npos) return "";
  const auto close = exception.rfind('\'', not_registered);
  if (close == std::string::npos || close == 0) return "";
  const auto open = exception.rfind('\'', close - 1);
  if (open == std::string::npos) return "";
  const auto name = exception.substr(open + 1, close - open - 1);
  return isClassName(name) ? name : "";
}

constexpr std::uint8_t kEndFlag = 0x88;  // after each object since MRPT 0.5.5

}  // namespace

std::size_t ObjectReader::Archive::read(void* buffer, std::size_t size) {
  if (file_.read(buffer, size) < size) throw std::runtime_error("not enough bytes left");
  return size;
}

std::size_t ObjectReader::Archive::write(const void*, std::size_t) {
  throw std::logic_error("opened for reading");
}

ObjectReader::Header ObjectReader::Archive::readHeader() {
  Header header;
  internal_ReadObjectHeader(header.class_name, header.old_format, header.version);
  return header;
}

void ObjectReader::Archive::readBody(CSerializable* object, const Header& header) {
  internal_ReadObject(object, header.class_name, header.old_format, header.version);
}

CSerializable::Ptr ObjectReader::next() {
  while (ending_ == Ending::open) {
    const auto may_read = may_read_after_ ? may_read_after_(objects_) : SandboxedReader::Answer::yes;
    if (may_read == SandboxedReader::Answer::not_known) break;
    if (may_read == SandboxedReader::Answer::no) {
      end(Ending::corrupt, "is corrupt: an object cannot be read; copy or download the log again");
      break;
    }
    if (in_rawlog_ && rawlog_left_ == 0) {
      leaveRawlog();
      continue;
    }
    Header header;
    if (!readHeader(header)) break;
    try {
      if (enterRawlog(header)) continue;
      const auto object = readObject(header);
      if (!object) continue;  // a null pointer was saved, or the stream has ended
      if (in_rawlog_) --rawlog_left_;
      ++objects_;
      bytes_ = file_.position();
      return object;
    } catch (const std::exception& error) {
      endAtException(error.what());
    }
  }
  return nullptr;
}

bool ObjectReader::readHeader(Header& header) {
  const auto start = file_.position();
  try {
    header = archive_.readHeader();
  } catch (const std::exception&) {
    if (file_.ending() == CompressedFile::Ending::end && file_.position() == start && !in_rawlog_) {
      ending_ = Ending::complete;
    } else if (file_.ending() != CompressedFile::Ending::open) {
      endAtMissingBytes();
    } else {
      end(Ending::corrupt, "is corrupt: no object begins where one should; copy or download the log again");
    }
    return false;
  }
  if (header.class_name != "nullptr" && !isClassName(header.class_name)) {
    end(Ending::corrupt, "is corrupt: no object begins where one should; copy or download the log again");
    return false;
  }
  saw_header_ = true;
  return true;
}

CSerializable::Ptr ObjectReader::readObject(const Header& header) {
  if (header.class_name == "nullptr") {
    archive_.readBody(nullptr, header);
    if (in_rawlog_) --rawlog_left_;
    return nullptr;
  }
  const auto* id = mrpt::rtti::findRegisteredClass(header.class_name);
  if (!id) {
    unregistered_class_ = header.class_name;
    end(Ending::unregistered_class,
        "has an object of class " + header.class_name +
            ", which is not registered; load the library that defines it, else the log cannot be read beyond it");
    return nullptr;
  }
  const auto object = std::dynamic_pointer_cast<CSerializable>(id->createObject());
  if (!object) {
    end(Ending::corrupt, "is corrupt: it has an object of the abstract class " + header.class_name);
    return nullptr;
  }
  archive_.readBody(object.get(), header);
  return object;
}

bool ObjectReader::enterRawlog(const Header& header) {
  if (in_rawlog_ || mrpt::rtti::findRegisteredClass(header.class_name) != CLASS_ID(mrpt::obs::CRawlog)) return false;
  archive_ >> rawlog_left_;
  in_rawlog_ = true;
  rawlog_old_format_ = header.old_format;
  return true;
}

void ObjectReader::leaveRawlog() {
  try {
    mrpt::obs::CObservationComment comment;
    archive_ >> comment;
    if (!rawlog_old_format_ && archive_.ReadAs<std::uint8_t>() != kEndFlag) throw std::runtime_error("no end flag");
    in_rawlog_ = false;
    bytes_ = file_.position();
  } catch (const std::exception& error) {
    endAtException(error.what());
  }
}

void ObjectReader::endAtMissingBytes() {
  const std::string why = file_.problem().empty() ? "" : " (" + file_.problem() + ")";
  if (file_.ending() == CompressedFile::Ending::corrupt) {
    end(Ending::corrupt, "is corrupt" + why + "; copy or download the log again");
  } else {
    end(Ending::truncated,
        "is truncated: it ends in the middle of an object" + why + "; copy or download the log again");
  }
}

void ObjectReader::endAtException(const std::string& what) {
  if (file_.ending() != CompressedFile::Ending::open) {
    endAtMissingBytes();
    return;
  }
  unregistered_class_ = unregisteredClassIn(what);
  if (unregistered_class_.empty()) {
    end(Ending::corrupt, "is corrupt: an object cannot be read; copy or download the log again");
  } else {
    end(Ending::unregistered_class, "has an object of class " + unregistered_class_ +
                                        " inside another one, which is not registered; load the library that defines "
                                        "it, else the log cannot be read beyond it");
  }
}

void ObjectReader::end(Ending ending, const std::string& what) {
  ending_ = ending;
  message_ = file_.path() + ": " + what + ". What was read before: " + std::to_string(objects_) + " objects, " +
             std::to_string(bytes_) + " bytes (uncompressed).";
}

}  // namespace omnimapper::source
