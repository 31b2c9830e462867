#include "TesseractReader.h"

#include <omnimapper/base/Error.h>
#include <tesseract/baseapi.h>
#include <tesseract/resultiterator.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace omnimapper::tesseract_reader {

namespace {

constexpr int kRows = 64, kMargin = 12;  // [px] height of the patch that Tesseract gets, and the margin around it

// The patch as dark text on light background with a margin of the background's colour, as in the documents that
// Tesseract was trained on.
cv::Mat documentOf(const camera::ColourImage& patch) {
  const cv::Mat colours(patch.height, patch.width, CV_8UC3, const_cast<std::uint8_t*>(patch.pixels),
                        static_cast<std::size_t>(patch.stride));
  cv::Mat grey;
  cv::cvtColor(colours, grey, cv::COLOR_BGR2GRAY);
  const double scale = 1.0 * kRows / grey.rows;
  cv::resize(grey, grey, {std::max(1, cvRound(scale * grey.cols)), kRows}, 0, 0,
             scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  cv::normalize(grey, grey, 0, 255, cv::NORM_MINMAX);
  cv::Mat rim;
  cv::vconcat(grey.row(0), grey.row(grey.rows - 1), rim);
  if (cv::mean(rim)[0] < cv::mean(grey)[0]) {
    grey = 255 - grey;
    rim = 255 - rim;
  }
  cv::Mat document;
  cv::copyMakeBorder(grey, document, kMargin, kMargin, kMargin, kMargin, cv::BORDER_CONSTANT, cv::mean(rim));
  return document;
}

}  // namespace

TesseractReader::TesseractReader(const signs::Alphabet& alphabet) : alphabet_(alphabet) {
  for (const auto& letter : alphabet.letters())
    if (letter != " ") letters_ += letter;
  idle_.push_back(take());
}

TesseractReader::~TesseractReader() = default;

std::unique_ptr<tesseract::TessBaseAPI> TesseractReader::take() const {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      auto engine = std::move(idle_.back());
      idle_.pop_back();
      return engine;
    }
  }
  auto engine = std::make_unique<tesseract::TessBaseAPI>();
  if (engine->Init(nullptr, "eng", tesseract::OEM_LSTM_ONLY) != 0)
    throw base::Error(
        base::ExitCode::plugin_library,
        "Tesseract finds no English letters; install tesseract-ocr-eng, and unset TESSDATA_PREFIX if it names "
        "another folder, or leave reader = tesseract out");
  engine->SetPageSegMode(tesseract::PSM_SINGLE_LINE);
  engine->SetVariable("tessedit_char_whitelist", letters_.c_str());
  engine->SetVariable("debug_file", "/dev/null");
  return engine;
}

signs::Reading TesseractReader::read(const camera::ColourImage& patch) const {
  if (patch.width < 1 || patch.height < 1) return {};
  const cv::Mat document = documentOf(patch);
  auto engine = take();
  engine->SetImage(document.data, document.cols, document.rows, 1, static_cast<int>(document.step));
  engine->SetSourceResolution(300);
  signs::Reading reading;
  if (engine->Recognize(nullptr) == 0) {
    const std::unique_ptr<tesseract::ResultIterator> symbols(engine->GetIterator());
    if (symbols) do {
        const std::unique_ptr<char[]> text(symbols->GetUTF8Text(tesseract::RIL_SYMBOL));
        if (!text) continue;
        const bool is_first_of_word = symbols->IsAtBeginningOf(tesseract::RIL_WORD);
        if (is_first_of_word && !reading.text.empty()) {
          reading.text += " ";
          reading.probabilities.push_back(reading.probabilities.back());
        }
        for (const auto& letter : signs::lettersOf(text.get())) {
          const auto counts = alphabet_.letterFor(letter);
          if (counts.empty()) {
            reading.of_left_out = 0;
            continue;
          }
          reading.text += counts;
          reading.probabilities.push_back(
              std::clamp(static_cast<double>(symbols->Confidence(tesseract::RIL_SYMBOL)) / 100, 0.0, 1.0));
        }
      } while (symbols->Next(tesseract::RIL_SYMBOL));
  }
  engine->Clear();
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(engine));
  return reading;
}

}  // namespace omnimapper::tesseract_reader

extern "C" omnimapper::signs::TextReader* omnimapperTesseractReader(const omnimapper::signs::Alphabet& alphabet) {
  return new omnimapper::tesseract_reader::TesseractReader(alphabet);
}
