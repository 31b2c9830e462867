#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Bytes.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/map/MapFile.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <set>

namespace omnimapper::map {

using base::ByteWriter;

namespace {

// File: magic, format version (4), number of sections (4); then each section: checksum (4), its header, its bytes.
// Header: length of the name (4), name, version (4), length of the bytes (8). All little-endian.
const std::string kMagic = "OMNIMAP\n";
constexpr std::uint32_t kFormatVersion = 1;
constexpr std::uint64_t kLongestName = 256;

[[noreturn]] void refuseFile(const std::string& what, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, what + ": " + reason);
}

std::string headerOf(const MapSection& section) {
  ByteWriter out;
  out.uint(section.name.size(), 4);
  out.raw(section.name);
  out.uint(section.version, 4);
  out.uint(section.bytes.size(), 8);
  return out.take();
}

// zlib's crc32() takes 32-bit lengths, so longer data is passed in parts.
std::uint32_t checksumOf(const std::string& header, std::string_view bytes) {
  uLong crc = crc32(0, reinterpret_cast<const Bytef*>(header.data()), static_cast<uInt>(header.size()));
  while (!bytes.empty()) {
    const std::size_t part = std::min<std::size_t>(bytes.size(), std::numeric_limits<std::int32_t>::max());
    crc = crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(part));
    bytes.remove_prefix(part);
  }
  return static_cast<std::uint32_t>(crc);
}

// Reads a file part by part, so that no more than one section is in memory twice.
class FileBytes {
 public:
  explicit FileBytes(const std::string& path) : in_(base::openInput(path, "map file")), what_(path) {
    in_.seekg(0, std::ios::end);
    left_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, in_.tellg()));
    in_.seekg(0);
  }

  std::string raw(std::uint64_t count) {
    expectLeft(count);
    std::string bytes(count, '\0');
    in_.read(bytes.data(), static_cast<std::streamsize>(count));
    expectRead(count);
    return bytes;
  }
  void skip(std::uint64_t count) {
    expectLeft(count);
    in_.seekg(static_cast<std::streamoff>(count), std::ios::cur);
    expectRead(count);
  }
  std::uint64_t uint(int bytes) { return base::fromBytes(raw(static_cast<std::uint64_t>(bytes)).data(), bytes); }
  bool atEnd() const { return left_ == 0; }
  /// Sets the place that messages name from now on.
  void setWhat(const std::string& what) { what_ = what; }

 private:
  void expectLeft(std::uint64_t count) const {
    if (count <= left_) return;
    throw base::Error(base::ExitCode::unreadable_input, what_ + ": truncated: " + std::to_string(count) +
                                                            " bytes are expected where only " + std::to_string(left_) +
                                                            " are left. Take another copy of the file.");
  }
  void expectRead(std::uint64_t count) {
    if (!in_)
      throw base::Error(base::ExitCode::damaged_input, what_ + ": cannot be read to its end; is the disk whole?");
    left_ -= count;
  }

  std::ifstream in_;
  std::string what_;
  std::uint64_t left_;
};

using Wanted = std::function<bool(const MapFile::Entry& entry)>;

// The bytes of a section that is not wanted are skipped.
MapSection readSection(FileBytes& in, const std::string& path, std::uint32_t number, const Wanted& is_wanted,
                       bool& is_kept) {
  in.setWhat(path + ", section number " + std::to_string(number));
  const auto checksum = static_cast<std::uint32_t>(in.uint(4));
  MapSection section;
  const std::uint64_t length = in.uint(4);
  if (length > kLongestName)
    refuseFile(path, "has a section whose name is " + std::to_string(length) + " bytes long: the file is damaged.");
  section.name = in.raw(length);
  const std::string what = path + ", section \"" + base::printable(section.name) + "\"";
  in.setWhat(what);
  section.version = static_cast<std::uint32_t>(in.uint(4));
  const std::uint64_t size = in.uint(8);
  is_kept = is_wanted({section.name, section.version, size});
  if (!is_kept) {
    in.skip(size);
    return section;
  }
  section.bytes = in.raw(size);
  if (checksumOf(headerOf(section), section.bytes) != checksum) {
    refuseFile(what, "its checksum does not match: the file is damaged. Take another copy of it.");
  }
  return section;
}

// Sections that are not wanted are skipped, but their names are checked.
std::vector<MapSection> readSections(const std::string& path, const Wanted& is_wanted) {
  FileBytes in(path);
  std::string magic;
  try {
    magic = in.raw(kMagic.size());
  } catch (const base::Error&) {
  }
  if (magic != kMagic) refuseFile(path, "is no map file of OmniMapper: it does not begin with \"OMNIMAP\".");
  const std::uint64_t format = in.uint(4);
  if (format != kFormatVersion) {
    refuseFile(path, "was written in format " + std::to_string(format) + ", and this program reads format " +
                         std::to_string(kFormatVersion) + ". Use the OmniMapper that wrote it, or a later one.");
  }
  const std::uint64_t count = in.uint(4);
  std::vector<MapSection> sections;
  std::set<std::string> names;
  for (std::uint64_t i = 0; i < count; ++i) {
    bool is_kept = false;
    MapSection section = readSection(in, path, static_cast<std::uint32_t>(i + 1), is_wanted, is_kept);
    if (!names.insert(section.name).second)
      refuseFile(path, "has two sections \"" + section.name + "\": the file is damaged.");
    if (is_kept) sections.push_back(std::move(section));
  }
  if (!in.atEnd()) {
    refuseFile(path, "goes on after the last of its " + std::to_string(count) + " sections: the file is damaged.");
  }
  return sections;
}

}  // namespace

MapFile MapFile::read(const std::string& path) {
  MapFile file;
  file.sections_ = readSections(path, [](const Entry&) { return true; });
  return file;
}

MapFile MapFile::readOnly(const std::string& path, const std::vector<std::string>& names) {
  MapFile file;
  file.sections_ = readSections(
      path, [&](const Entry& entry) { return std::find(names.begin(), names.end(), entry.name) != names.end(); });
  return file;
}

std::vector<MapFile::Entry> MapFile::list(const std::string& path) {
  std::vector<Entry> entries;
  readSections(path, [&](const Entry& entry) {
    entries.push_back(entry);
    return false;
  });
  return entries;
}

void MapFile::write(const std::string& path) const {
  base::writeFile(path, [&](std::ostream& out) {
    ByteWriter head;
    head.raw(kMagic);
    head.uint(kFormatVersion, 4);
    head.uint(sections_.size(), 4);
    out << head.bytes();
    for (const MapSection& section : sections_) {
      ByteWriter start;
      const std::string header = headerOf(section);
      start.uint(checksumOf(header, section.bytes), 4);
      start.raw(header);
      out << start.bytes() << section.bytes;
    }
  });
}

void MapFile::set(MapSection section) {
  const auto place =
      std::find_if(sections_.begin(), sections_.end(), [&](const MapSection& s) { return s.name == section.name; });
  if (place == sections_.end()) {
    sections_.push_back(std::move(section));
  } else {
    *place = std::move(section);
  }
}

void MapFile::remove(const std::string& name) {
  const auto is_it = [&](const MapSection& section) { return section.name == name; };
  sections_.erase(std::remove_if(sections_.begin(), sections_.end(), is_it), sections_.end());
}

const MapSection* MapFile::find(const std::string& name) const {
  const auto place =
      std::find_if(sections_.begin(), sections_.end(), [&](const MapSection& section) { return section.name == name; });
  return place == sections_.end() ? nullptr : &*place;
}

}  // namespace omnimapper::map
