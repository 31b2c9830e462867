#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/signs/SignDetector.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace omnimapper::signs {

/// Histograms of oriented gradients of a region (thesis 3.5.3.1; Dalal and Triggs: Histograms of oriented gradients for
/// human detection, 2005), by OpenCV's HOGDescriptor. As in the thesis there are 4 x 4 cells, one block over all of
/// them and 9 orientations. The thesis's window of 16 x 26 pixels cannot be divided into 4 x 4 cells of whole pixels,
/// so the window here has 32 x 32 pixels. Every region is warped to this window, whatever its aspect ratio.
struct HogOptions {
  int columns = 4, rows = 4;  ///< number of cells in the window
  int cell = 8;               ///< side of a cell [px]
  int block = 4;              ///< side of a block, over which contrast is normalized [cells]
  int orientations = 9;       ///< number of orientations over half a turn: dark on bright equals bright on dark
  double margin = 0.0625;     ///< share of the window on each side that shows the region's surroundings

  static const base::OptionTable<HogOptions>& table();
  /// Length of a feature vector.
  int length() const { return (columns - block + 1) * (rows - block + 1) * block * block * orientations; }
};

/// The feature vector of a region: the histograms of the region after it was warped to the window, with 8 bits for each
/// number.
using SignFeatures = std::vector<std::uint8_t>;

/// The features of each region. Throws as SignDetector::detect().
std::vector<SignFeatures> describe(const camera::ColourImage& picture, const std::vector<Corners>& regions,
                                   const HogOptions& options);

/// A support vector machine with a radial basis function as kernel (thesis, equation 2), and the function that maps the
/// machine's decision value y to a probability.
struct SignModel {
  HogOptions hog;
  double gamma = 0;                   ///< of the kernel exp(-gamma |a - b|^2), with features a and b in [0, 0.5]
  double bias = 0;                    ///< b of equation 2
  double slope = -1, offset = 0;      ///< the probability is 1 / (1 + exp(slope y + offset))
  std::vector<double> weights;        ///< weight of each support vector
  std::vector<SignFeatures> vectors;  ///< support vectors of hog.length() numbers each
};

/// Distinguishes door signs from other regions of a picture (thesis 3.5.3.2). Immutable, thread-safe.
///
/// The probabilities assume that half of the regions are signs; for another ratio of signs to others, add the logarithm
/// of this ratio to the logit. Of the regions that SaliencyProposer finds, one in fifty to a hundred is a sign.
class SignClassifier {
 public:
  /// Throws std::invalid_argument for a model whose parts do not fit one another or are not finite.
  explicit SignClassifier(SignModel model);
  /// The shipped classifier, which was trained on pictures of the simulator's buildings (doc/results/signs.md).
  static const SignClassifier& known();
  /// Throws Error(unreadable_input), which names the file and a remedy, if the file is missing, is no model, is damaged
  /// or is of another version.
  static SignClassifier read(const std::string& path);
  static SignClassifier fromBytes(std::string_view bytes, const std::string& name_for_messages);
  /// The same model always gives the same bytes.
  std::string toBytes() const;
  /// Throws as base::writeFile().
  void write(const std::string& path) const;

  const SignModel& model() const { return model_; }
  /// The decision value y(x) of equation 2; above 0 the machine classifies the region as a sign.
  double decision(const SignFeatures& features) const;
  /// Probability that the region is a sign, 0 to 1.
  double probability(const SignFeatures& features) const;
  /// The probability of each region. Throws as SignDetector::detect().
  std::vector<double> probabilities(const camera::ColourImage& picture, const std::vector<Corners>& regions) const;

 private:
  SignModel model_;
};

}  // namespace omnimapper::signs
