#pragma once

#include <omnimapper/signs/TextReader.h>

#include <memory>
#include <mutex>
#include <vector>

namespace tesseract {
class TessBaseAPI;
}

namespace omnimapper::tesseract_reader {

/// Reads with Tesseract 5 (Smith: An overview of the Tesseract OCR engine, 2007; since version 4 a recurrent network)
/// and its data for English. Threads that read at the same time use separate engines.
class TesseractReader : public signs::TextReader {
 public:
  /// Throws Error(plugin_library) if Tesseract does not find its data for English.
  explicit TesseractReader(const signs::Alphabet& alphabet);
  ~TesseractReader() override;

  signs::Reading read(const camera::ColourImage& patch) const override;

 private:
  std::unique_ptr<tesseract::TessBaseAPI> take() const;

  signs::Alphabet alphabet_;
  std::string letters_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<tesseract::TessBaseAPI>> idle_;
};

}  // namespace omnimapper::tesseract_reader
