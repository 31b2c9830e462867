#include "CameraFile.h"

#include <omnimapper/base/InputFile.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace omnimapper::source {

namespace fs = std::filesystem;

namespace {

using Numbers = std::vector<double>;
constexpr const char* kSpace = " \t\r\n";

std::optional<double> numberAt(const std::string& text, std::size_t& at) {
  double value = 0;
  const auto result = std::from_chars(text.data() + std::min(at, text.size()), text.data() + text.size(), value);
  if (result.ec != std::errc()) return std::nullopt;
  at = static_cast<std::size_t>(result.ptr - text.data());
  return value;
}

// The numbers after the first bracket, also of rows in brackets of their own.
Numbers numbersInBrackets(const std::string& text, std::size_t at) {
  Numbers numbers;
  int depth = 0;
  while (at < text.size()) {
    if (text[at] == '[') ++depth;
    if (text[at] == ']' && --depth == 0) break;
    if (const auto number = numberAt(text, at))
      numbers.push_back(*number);
    else
      ++at;
  }
  return numbers;
}

// The numbers that begin at a place: one, a list in brackets, or a list of lines that begin with "- ".
Numbers numbersFrom(const std::string& text, std::size_t at) {
  at = text.find_first_not_of(kSpace, at);
  if (at == std::string::npos) return {};
  if (text[at] == '[') return numbersInBrackets(text, at);
  if (const auto number = numberAt(text, at)) return {*number};
  Numbers numbers;
  while (at < text.size() && text[at] == '-') {
    at = std::min(text.find_first_not_of(kSpace, at + 1), text.size());
    const auto number = numberAt(text, at);
    if (!number) break;
    numbers.push_back(*number);
    at = std::min(text.find_first_not_of(kSpace, at), text.size());
  }
  return numbers;
}

/// The text of a file that names numbers.
class NamedNumbers {
 public:
  NamedNumbers(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)) {}

  /// The numbers after "name:", "name =" or "\"name\":", or after the "data:" below it; empty if there are none. Throws
  /// Error(unreadable_input) if the name occurs with different numbers.
  Numbers of(const std::string& name) const {
    Numbers found;
    for (std::size_t at = placeOf(name, 0); at != std::string::npos; at = placeOf(name, at)) {
      Numbers numbers = numbersFrom(text_, at);
      if (const std::size_t data = placeOfData(at); numbers.empty() && data != std::string::npos)
        numbers = numbersFrom(text_, data);
      if (!found.empty() && !numbers.empty() && numbers != found)
        refuse(path_, "states several cameras: '" + name +
                          "' occurs with different numbers; copy that of the depth images into a file of its own");
      if (!numbers.empty()) found = numbers;
    }
    return found;
  }
  /// The one number of the first of these names that has one.
  std::optional<double> first(const std::vector<std::string>& names) const {
    for (const auto& name : names)
      if (const Numbers numbers = of(name); numbers.size() == 1) return numbers.front();
    return std::nullopt;
  }
  /// The first word after a name; empty if it does not occur.
  std::string word(const std::string& name) const {
    const std::size_t begin = std::min(text_.find_first_not_of(" \t\"'", placeOf(name, 0)), text_.size());
    return text_.substr(begin, text_.find_first_of(" \t\r\n\"',}", begin) - begin);
  }
  const std::string& text() const { return text_; }

 private:
  // The place behind the first "data:" after a place at which no list begins.
  std::size_t placeOfData(std::size_t at) const {
    const std::size_t next = text_.find_first_not_of(kSpace, at);
    return next == std::string::npos || text_[next] == '[' ? std::string::npos : placeOf("data", next);
  }
  // The place behind the sign after the first such name from a place on.
  std::size_t placeOf(const std::string& name, std::size_t from) const {
    const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = text_.find(name, from); at != std::string::npos; at = text_.find(name, at + 1)) {
      if (at > 0 && isWord(text_[at - 1])) continue;
      const std::size_t sign = text_.find_first_not_of("\"' \t", at + name.size());
      if (sign != std::string::npos && (text_[sign] == ':' || text_[sign] == '=')) return sign + 1;
    }
    return std::string::npos;
  }

  std::string path_, text_;
};

// The four values of a matrix K of nine numbers, row by row or column by column.
Numbers valuesOfMatrix(const std::string& path, const Numbers& k) {
  const bool has_rows = k.size() == 9 && k[1] == 0 && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1;
  const bool has_columns = k.size() == 9 && k[1] == 0 && k[3] == 0 && k[2] == 0 && k[5] == 0 && k[8] == 1;
  if (has_rows) return {k[0], k[4], k[2], k[5]};
  if (has_columns) return {k[0], k[4], k[6], k[7]};
  refuse(path, "has no matrix of a camera, which is fx 0 cx, 0 fy cy, 0 0 1");
}

// A text that consists of numbers and of comments after '#' alone: fx, fy, cx, cy, a matrix K, or K with a fourth row
// and column. Empty if it is none.
Numbers valuesOfBareNumbers(const std::string& path, const std::string& text) {
  Numbers numbers;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    line.resize(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    for (double number = 0; words >> number;) numbers.push_back(number);
    if (!words.eof()) return {};
  }
  constexpr std::array kFourth{15, 14, 13, 12, 11, 7, 3};  // indices of the fourth row and column, 0 0 0 1
  const bool has_fourth = numbers.size() == 16 && std::all_of(kFourth.begin(), kFourth.end(), [&](int at) {
                            return numbers[static_cast<std::size_t>(at)] == (at == 15 ? 1 : 0);
                          });
  if (has_fourth)
    for (const int at : kFourth) numbers.erase(numbers.begin() + at);
  if (numbers.size() == 9) return valuesOfMatrix(path, numbers);
  return numbers.size() == 4 ? numbers : Numbers();
}

Numbers valuesIn(const std::string& path, const NamedNumbers& named) {
  const auto fx = named.first({"fx"}), fy = named.first({"fy"});
  const auto cx = named.first({"cx", "ppx"}), cy = named.first({"cy", "ppy"});
  if (fx && fy && cx && cy) return {*fx, *fy, *cx, *cy};
  for (const char* name : {"camera_matrix", "intrinsic_matrix", "K", "k"})
    if (const Numbers matrix = named.of(name); matrix.size() == 9) return valuesOfMatrix(path, matrix);
  return valuesOfBareNumbers(path, named.text());
}

void addLens(const std::string& path, const NamedNumbers& named, mrpt::img::TCamera& camera) {
  Numbers lens;
  for (const char* name : {"distortion_coefficients", "D", "d"})
    if (lens.empty()) lens = named.of(name);
  const char* names[] = {"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < std::size(names); ++i) {
    const auto value = named.first({names[i]});
    if (!value) continue;
    if (lens.size() <= i) lens.resize(i + 1);
    lens[i] = *value;
  }
  if (std::all_of(lens.begin(), lens.end(), [](double value) { return value == 0; })) return;
  if (!std::all_of(lens.begin(), lens.end(), [](double value) { return std::isfinite(value); }))
    refuse(path, "states a lens whose coefficients are not finite");
  const std::string model = named.word("distortion_model");
  if ((!model.empty() && model != "plumb_bob" && model != "rational_polynomial") || lens.size() > camera.dist.size())
    refuse(path, "states a lens '" + model + "' with " + std::to_string(lens.size()) +
                     " coefficients, which is not read; read are plumb_bob and rational_polynomial. Rectify the images "
                     "and state the intrinsics of those without coefficients");
  camera.distortion = mrpt::img::DistortionModel::plumb_bob;
  std::copy(lens.begin(), lens.end(), camera.dist.begin());
}

bool mayStateCamera(const fs::path& file) {
  std::string name = file.filename().string(), ending = file.extension().string();
  const bool has_k = file.stem() == "K" || file.stem().extension() == ".K";
  for (std::string* text : {&name, &ending})
    std::transform(text->begin(), text->end(), text->begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".json" || ending == ".yaml" || ending == ".yml") return true;
  const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
  return ending == ".txt" && (has_k || has("intrin") || has("calib") || has("camera"));
}

bool areEqual(const mrpt::img::TCamera& a, const mrpt::img::TCamera& b) {
  return a.fx() == b.fx() && a.fy() == b.fy() && a.cx() == b.cx() && a.cy() == b.cy() && a.dist == b.dist;
}

}  // namespace

std::optional<CameraFile> readCameraFile(const std::string& path) {
  const NamedNumbers named(path, base::readInput(path));
  const Numbers values = valuesIn(path, named);
  if (values.empty()) return std::nullopt;
  if (values[1] < 0)
    refuse(path,
           "states a negative fy, which is of images whose rows run upwards; those of image files run downwards: state "
           "it without its sign");
  if (!(values[0] > 0 && values[1] > 0) || !std::isfinite(values[0] + values[1] + values[2] + values[3]))
    refuse(path, "states no focal length");
  CameraFile file{path, {}, named.first({"DepthMapFactor"}).value_or(0)};
  file.camera.setIntrinsicParamsFromValues(values[0], values[1], values[2], values[3]);
  const auto sizeOf = [&](const std::vector<std::string>& names) {
    const double pixels = named.first(names).value_or(0);
    return pixels > 0 && pixels < 1e6 ? static_cast<std::uint32_t>(pixels) : 0U;
  };
  file.camera.ncols = sizeOf({"width", "image_width"});
  file.camera.nrows = sizeOf({"height", "image_height"});
  addLens(path, named, file.camera);
  return file;
}

std::optional<CameraFile> cameraFileIn(const std::vector<std::string>& folders) {
  constexpr std::uintmax_t kLargest = std::uintmax_t{1} << 18;  // [bytes] a file of a camera has some hundred
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& folder : folders)
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
      if (mayStateCamera(entry->path()) && entry->is_regular_file(error) && entry->file_size(error) <= kLargest)
        paths.push_back(entry->path().string());
  std::sort(paths.begin(), paths.end());
  std::optional<CameraFile> found;
  for (const auto& path : paths) {
    const auto file = readCameraFile(path);
    if (!file) continue;
    if (found && !areEqual(found->camera, file->camera))
      refuse(path, "states another camera than " + found->path +
                       "; name the file of the depth images as [source_rgbd_folder] intrinsics, or with --intrinsics "
                       "of omnimapper-import");
    if (!found) found = file;
  }
  return found;
}

}  // namespace omnimapper::source
