#pragma once

#include <mrpt/serialization/CArchive.h>
#include <omnimapper/source/CompressedFile.h>

#include <functional>
#include <string>
#include <utility>

#include "SandboxedReader.h"

namespace omnimapper::source {

/// Reads one serialized object after another from a file. Unlike MRPT's own reader it distinguishes the end of the file
/// from truncation, corruption, and a class that is not registered. A CRawlog saved as one object is split into its
/// objects, so that it is streamed too.
class ObjectReader {
 public:
  enum class Ending { open, complete, truncated, corrupt, unregistered_class };

  /// Throws as CompressedFile.
  explicit ObjectReader(const std::string& path) : file_(path), archive_(file_) {}

  /// Sets a function that is called before each object with the number of objects before it. If it answers no, the
  /// reading ends as corrupt; if the answer is not known, next() returns null once, and the ending stays open.
  void ask(std::function<SandboxedReader::Answer(std::uint64_t)> may_read_after) {
    may_read_after_ = std::move(may_read_after);
  }

  /// The next object; null at the end, of whatever kind.
  mrpt::serialization::CSerializable::Ptr next();

  Ending ending() const { return ending_; }
  /// For the user: file, place and remedy; empty if all is well.
  const std::string& message() const { return message_; }
  const std::string& unregisteredClass() const { return unregistered_class_; }
  /// Whether the first object had a valid header.
  bool sawHeader() const { return saw_header_; }
  std::uint64_t objects() const { return objects_; }
  /// Uncompressed bytes up to the end of the last whole object.
  std::uint64_t bytes() const { return bytes_; }
  const CompressedFile& file() const { return file_; }

 private:
  struct Header {
    std::string class_name;
    bool old_format = false;
    std::int8_t version = 0;
  };

  class Archive : public mrpt::serialization::CArchive {
   public:
    explicit Archive(CompressedFile& file) : file_(file) {}
    /// Throws whatever MRPT throws.
    Header readHeader();
    void readBody(mrpt::serialization::CSerializable* object, const Header& header);
    std::string getArchiveDescription() const override { return file_.path(); }

   protected:
    std::size_t read(void* buffer, std::size_t size) override;
    std::size_t write(const void*, std::size_t) override;

   private:
    CompressedFile& file_;
  };

  bool readHeader(Header& header);
  mrpt::serialization::CSerializable::Ptr readObject(const Header& header);
  bool enterRawlog(const Header& header);
  void leaveRawlog();
  void endAtMissingBytes();
  void endAtException(const std::string& what);
  void end(Ending ending, const std::string& what);

  CompressedFile file_;
  Archive archive_;
  Ending ending_ = Ending::open;
  std::string message_;
  std::string unregistered_class_;
  bool saw_header_ = false;
  bool in_rawlog_ = false;          // inside a CRawlog saved as one object
  bool rawlog_old_format_ = false;  // no end flag after it
  std::uint32_t rawlog_left_ = 0;   // objects left in it
  std::function<SandboxedReader::Answer(std::uint64_t)> may_read_after_;
  std::uint64_t objects_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace omnimapper::source
