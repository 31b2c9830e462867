#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Bytes.h>
#include <omnimapper/base/InputFile.h>
#include <zlib.h>

#include <ostream>
#include <stdexcept>

#include "KnownModel.h"
#include "SignClassifier.h"

namespace omnimapper::signs {

namespace {

// The file has "omnimapper signs", the version (4 bytes), a checksum of everything after it (4), then what readBody()
// reads.
constexpr std::string_view kMagic = "omnimapper signs";
constexpr std::uint64_t kVersion = 1;
constexpr std::uint64_t kMostVectors = 100000;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw base::Error(base::ExitCode::unreadable_input, name + ": " + why);
}

std::uint64_t checksumOf(std::string_view bytes) {
  return crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
}

SignModel readBody(std::string_view bytes, const std::string& name) {
  base::ByteReader in(bytes, name);
  SignModel model;
  for (int* value : {&model.hog.columns, &model.hog.rows, &model.hog.cell, &model.hog.block, &model.hog.orientations})
    *value = static_cast<int>(in.uint(1));
  for (double* value : {&model.hog.margin, &model.gamma, &model.bias, &model.slope, &model.offset}) *value = in.real();
  const std::uint64_t count = in.uint(4), length = in.uint(4);
  if (count > kMostVectors || length != static_cast<std::uint64_t>(model.hog.length()))
    refuse(name, "its sizes do not fit one another. Train it again with omnimapper-train-doorsigns.");
  for (std::uint64_t i = 0; i < count; ++i) {
    model.weights.push_back(in.real());
    const std::string_view vector = in.raw(length);
    model.vectors.emplace_back(vector.begin(), vector.end());
  }
  if (!in.atEnd()) refuse(name, "has bytes after its end. Take another copy of the file.");
  return model;
}

}  // namespace

std::string SignClassifier::toBytes() const {
  base::ByteWriter body;
  const HogOptions& hog = model_.hog;
  for (const int value : {hog.columns, hog.rows, hog.cell, hog.block, hog.orientations})
    body.uint(static_cast<std::uint64_t>(value), 1);
  for (const double value : {hog.margin, model_.gamma, model_.bias, model_.slope, model_.offset}) body.real(value);
  body.uint(model_.vectors.size(), 4);
  body.uint(static_cast<std::uint64_t>(hog.length()), 4);
  for (std::size_t i = 0; i < model_.vectors.size(); ++i) {
    body.real(model_.weights[i]);
    body.raw({reinterpret_cast<const char*>(model_.vectors[i].data()), model_.vectors[i].size()});
  }
  base::ByteWriter file;
  file.raw(kMagic);
  file.uint(kVersion, 4);
  file.uint(checksumOf(body.bytes()), 4);
  file.raw(body.bytes());
  return file.take();
}

void SignClassifier::write(const std::string& path) const {
  const std::string bytes = toBytes();
  base::writeFile(path,
                  [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

SignClassifier SignClassifier::fromBytes(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, kMagic.size()) != kMagic)
    refuse(name, "is no model of door signs. Name a file that omnimapper-train-doorsigns wrote.");
  base::ByteReader in(bytes.substr(kMagic.size()), name);
  const std::uint64_t version = in.uint(4), checksum = in.uint(4);
  if (version != kVersion) {
    refuse(name, "is a model of door signs of version " + std::to_string(version) +
                     ", and this program reads version " + std::to_string(kVersion) +
                     ". Train it again with omnimapper-train-doorsigns, or take the program "
                     "that wrote it.");
  }
  const std::string_view body = bytes.substr(kMagic.size() + 8);
  if (checksumOf(body) != checksum)
    refuse(name, "is damaged: its checksum does not fit. Take another copy of the file, or train it again.");
  try {
    return SignClassifier(readBody(body, name));
  } catch (const std::invalid_argument& error) {
    refuse(name, std::string("holds ") + error.what() + ". Train it again with omnimapper-train-doorsigns.");
  }
}

SignClassifier SignClassifier::read(const std::string& path) {
  return fromBytes(base::readInput(path, "model of door signs"), path);
}

const SignClassifier& SignClassifier::known() {
  static const SignClassifier classifier = fromBytes(kKnownModel, "the model of door signs that is shipped");
  return classifier;
}

}  // namespace omnimapper::signs
