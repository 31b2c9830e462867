// How well door signs are found and read in photographs of data/signs or a similar folder.
//
//   bench-sign_photos ../shared/data/signs/photos ../shared/data/signs/closeups -o out/sign_photos
//
// A folder has images NAME.jpg, the true region of the sign as NAME.mask.png for some of them, and labels.csv with the
// columns image, number and other_text. Without that file the number is the name of the image up to the first dot.

#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/signs/DoorSignExtractor.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

namespace fs = std::filesystem;
using omnimapper::obs::ObservedDoorSign;

namespace {

constexpr double kSure = 0.9;

struct Photo {
  fs::path path;
  std::string number, others;
  cv::Mat picture, mask;
};

std::vector<Photo> readPhotos(const fs::path& folder) {
  std::map<std::string, std::string> numbers, others;
  std::ifstream labels(folder / "labels.csv");
  for (std::string line; std::getline(labels, line);) {
    const auto comma = line.find(',');
    if (comma != std::string::npos) {
      const auto second = std::min(line.find(',', comma + 1), line.size());
      numbers[line.substr(0, comma)] = line.substr(comma + 1, second - comma - 1);
      others[line.substr(0, comma)] = second < line.size() ? line.substr(second + 1) : "";
    }
  }
  std::vector<Photo> photos;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".jpg") continue;
    Photo photo{entry.path(), "", "", cv::imread(entry.path().string()), {}};
    const auto name = entry.path().filename().string();
    photo.number = numbers.empty() ? name.substr(0, name.find('.')) : numbers[name];
    photo.others = others[name];
    const auto mask = fs::path(entry.path()).replace_extension("mask.png");
    if (fs::exists(mask)) {
      cv::resize(cv::imread(mask.string(), cv::IMREAD_GRAYSCALE), photo.mask, photo.picture.size(), 0, 0,
                 cv::INTER_NEAREST);
      photo.mask = photo.mask > 127;
    }
    photos.push_back(photo);
  }
  std::sort(photos.begin(), photos.end(), [](const Photo& a, const Photo& b) { return a.path < b.path; });
  return photos;
}

std::vector<ObservedDoorSign> signsIn(const omnimapper::signs::DoorSignExtractor& extractor, const cv::Mat& picture) {
  mrpt::obs::CObservationImage image;
  image.sensorLabel = "photograph";
  image.cameraParams.ncols = static_cast<std::uint32_t>(picture.cols);
  image.cameraParams.nrows = static_cast<std::uint32_t>(picture.rows);
  image.cameraParams.setIntrinsicParamsFromValues(picture.cols, picture.cols, 0.5 * picture.cols, 0.5 * picture.rows);
  image.image = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
  return extractor.signsIn(image)->signs;
}

std::vector<cv::Point> outlineOf(const ObservedDoorSign& sign) {
  std::vector<cv::Point> outline;
  for (const auto& corner : sign.corners_px) outline.emplace_back(cvRound(corner.x()), cvRound(corner.y()));
  return outline;
}

double overlapOf(const ObservedDoorSign& sign, const cv::Mat& mask) {
  cv::Mat region = cv::Mat::zeros(mask.size(), CV_8U);
  cv::fillConvexPoly(region, outlineOf(sign), 255);
  return static_cast<double>(cv::countNonZero(region & mask)) / std::max(1, cv::countNonZero(region | mask));
}

bool isOn(const ObservedDoorSign& sign, const cv::Mat& mask) {
  cv::Point2f middle(0, 0);
  for (const auto& corner : sign.corners_px) middle += 0.25f * cv::Point2f(corner.x(), corner.y());
  const cv::Point at(cvRound(middle.x), cvRound(middle.y));
  return cv::Rect({0, 0}, mask.size()).contains(at) && mask.at<std::uint8_t>(at) != 0;
}

// Keeps only letters, digits and hyphens, in capitals. Blanks are ignored because the reader places them freely, and
// "_" because it stands for a blank in a file's name.
std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-') result += static_cast<char>(std::toupper(c));
  return result;
}

bool hasDigit(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

// The number in a label: E25-125 for "E25-125_Women", and FLOOR1 for "E25_FLOOR_1", which is the sign of a storey.
std::string numberOf(const std::string& label) {
  const auto floor = label.find("FLOOR");
  return plain(floor != std::string::npos ? label.substr(floor) : label.substr(0, label.find('_')));
}

// Whether a line, or two lines of one sign joined by a hyphen, are the number. `confidence` is the largest among all
// such readings; that of two lines is the lower of both.
bool reads(const std::vector<ObservedDoorSign>& signs, const std::string& number, double& confidence) {
  const std::string wanted = numberOf(number);
  bool is_read = false;
  const auto take = [&](double sure) {
    confidence = std::max(is_read ? confidence : 0.0, sure);
    is_read = true;
  };
  for (const auto& sign : signs) {
    for (const auto& line : sign.texts) {
      if (plain(line.text) == wanted) take(line.confidence);
      for (const auto& next : sign.texts)
        if (plain(line.text) + "-" + plain(next.text) == wanted) take(std::min(line.confidence, next.confidence));
    }
  }
  return is_read;
}

struct Cut {
  std::string name;
  cv::Rect kept;
  bool is_cropped;  // the left-out part is cut off; else it is black
};

std::vector<Cut> cutsOf(const cv::Size& size) {
  const int w = size.width, h = size.height;
  std::vector<Cut> cuts;
  for (const bool is_cropped : {true, false}) {
    const std::string how = is_cropped ? "cropped " : "black ";
    cuts.push_back({how + "left", cv::Rect(w / 3, 0, w - w / 3, h), is_cropped});
    cuts.push_back({how + "right", cv::Rect(0, 0, w - w / 3, h), is_cropped});
    cuts.push_back({how + "top", cv::Rect(0, h / 3, w, h - h / 3), is_cropped});
    cuts.push_back({how + "bottom", cv::Rect(0, 0, w, h - h / 3), is_cropped});
  }
  return cuts;
}

cv::Mat cutBy(const Cut& cut, const cv::Mat& picture) {
  if (cut.is_cropped) return picture(cut.kept).clone();
  cv::Mat result = cv::Mat::zeros(picture.size(), picture.type());
  picture(cut.kept).copyTo(result(cut.kept));
  return result;
}

cv::Mat blackInTheMiddle(const cv::Mat& picture, bool is_row) {
  cv::Mat result = picture.clone();
  const int w = picture.cols, h = picture.rows;
  result(is_row ? cv::Rect(0, h / 3, w, h / 3) : cv::Rect(w / 3, 0, w / 3, h)) = cv::Scalar::all(0);
  return result;
}

// Texts with digits that were read with a high confidence but are not in the photograph as a whole.
std::string wrongAndSure(const std::vector<ObservedDoorSign>& signs, const Photo& photo) {
  std::string label = photo.number + " " + photo.others;
  std::replace(label.begin(), label.end(), '_', ' ');
  std::vector<std::string> words;
  std::istringstream in(label);
  for (std::string word; in >> word;) words.push_back(plain(word));
  // Parts of the number that may be on different lines: FLOOR 1, E25 and 125.
  if (photo.number.find('_') != std::string::npos) {
    words.push_back(numberOf(photo.number));
    const auto hyphen = words.front().find('-');
    if (hyphen != std::string::npos) words.push_back(words.front().substr(0, hyphen));
    if (hyphen != std::string::npos) words.push_back(words.front().substr(hyphen + 1));
  }
  std::string wrong;
  for (const auto& sign : signs) {
    for (const auto& text : sign.texts) {
      std::istringstream parts(text.confidence < kSure ? "" : text.text);
      for (std::string part; parts >> part;) {
        if (hasDigit(part) && std::find(words.begin(), words.end(), plain(part)) == words.end())
          wrong += (wrong.empty() ? "" : ", ") + part;
      }
    }
  }
  return wrong;
}

std::string linesOf(const std::vector<ObservedDoorSign>& signs) {
  std::ostringstream out;
  out.precision(2);
  for (const auto& sign : signs) {
    out << (out.str().empty() ? "" : "; ");
    for (const auto& text : sign.texts) out << text.text << " " << std::fixed << text.confidence << " ";
  }
  return out.str();
}

void draw(const Photo& photo, const std::vector<ObservedDoorSign>& signs, const fs::path& folder) {
  cv::Mat drawn = photo.picture.clone();
  for (const auto& sign : signs) {
    cv::polylines(drawn, outlineOf(sign), true, cv::Scalar(0, 255, 0), std::max(2, drawn.cols / 300));
  }
  cv::imwrite((folder / photo.path.filename()).string(), drawn);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Evaluates how well door signs are found and read in photographs.");
  std::vector<std::string> folders;
  std::string out = "out/sign_photos";
  bool with_cuts = false, by_tesseract = false, by_onnx_runtime = false;
  app.add_option("folders", folders, "folders of photographs")->required();
  app.add_option("-o", out, "folder for the photographs with the detections drawn in");
  app.add_flag("--cuts", with_cuts, "also read each photograph with a third of it left out, in ten variants");
  app.add_flag("--tesseract", by_tesseract, "read with Tesseract");
  app.add_flag("--onnxruntime", by_onnx_runtime, "run the networks with ONNX Runtime");
  CLI11_PARSE(app, argc, argv);
  using Options = omnimapper::signs::DoorSignOptions;
  Options options;
  if (by_tesseract) options.reader = Options::Reader::tesseract;
  if (by_onnx_runtime) options.backend = Options::Backend::onnx_runtime;
  fs::create_directories(out);
  const omnimapper::signs::DoorSignExtractor extractor(options);
  for (const auto& folder : folders) {
    int read = 0, with_number = 0, found = 0, overlapping = 0, with_mask = 0, elsewhere = 0, wrong = 0,
        sure_and_right = 0;
    double seconds = 0;
    const auto photos = readPhotos(folder);
    std::printf(
        "| photograph | number | read | sure | on the mask | overlap | elsewhere | lines "
        "|\n|---|---|---|---|---|---|---|---|\n");
    for (const auto& photo : photos) {
      const auto begin = std::chrono::steady_clock::now();
      const auto signs = signsIn(extractor, photo.picture);
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      double confidence = 0;
      const bool is_read = !photo.number.empty() && reads(signs, photo.number, confidence);
      with_number += !photo.number.empty();
      read += is_read;
      sure_and_right += is_read && confidence >= kSure;
      double overlap = 0;
      bool is_found = false;
      int others = 0;
      if (!photo.mask.empty()) {
        ++with_mask;
        for (const auto& sign : signs) {
          overlap = std::max(overlap, overlapOf(sign, photo.mask));
          isOn(sign, photo.mask) ? static_cast<void>(is_found = true) : static_cast<void>(++others);
        }
      }
      found += is_found;
      overlapping += overlap >= 0.5;
      elsewhere += others;
      const auto mistake = wrongAndSure(signs, photo);
      wrong += !mistake.empty();
      std::printf("| %s | %s | %s | %.2f | %s | %.2f | %d | %s%s |\n", photo.path.filename().c_str(),
                  photo.number.c_str(), is_read ? "yes" : "no", confidence, is_found ? "yes" : "no", overlap, others,
                  linesOf(signs).c_str(), mistake.empty() ? "" : (" WRONG AND SURE: " + mistake).c_str());
      draw(photo, signs, out);
      std::fflush(stdout);
      if (!with_cuts) continue;
      const auto tryCut = [&](const std::string& name, const cv::Mat& picture) {
        const auto cut_mistake = wrongAndSure(signsIn(extractor, picture), photo);
        wrong += !cut_mistake.empty();
        if (!cut_mistake.empty())
          std::printf("| %s, %s | | | | | | | WRONG AND SURE: %s |\n", photo.path.filename().c_str(), name.c_str(),
                      cut_mistake.c_str());
      };
      for (const auto& cut : cutsOf(photo.picture.size())) tryCut(cut.name, cutBy(cut, photo.picture));
      tryCut("black in the middle, upright", blackInTheMiddle(photo.picture, false));
      tryCut("black in the middle, level", blackInTheMiddle(photo.picture, true));
    }
    std::printf(
        "\n%s: read %d of %d, of these sure %d; found %d, overlap at least 0.5 %d of %d, elsewhere %d; wrong and sure "
        "%d; %.2f s an image\n\n",
        folder.c_str(), read, with_number, sure_and_right, found, overlapping, with_mask, elsewhere, wrong,
        seconds / std::max<double>(1, static_cast<double>(photos.size())));
  }
  return 0;
}
