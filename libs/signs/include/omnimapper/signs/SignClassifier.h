#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/signs/SignDetector.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace omnimapper::signs {

/// Histograms of oriented gradients of a region (thesis 3.5.3.1; Dalal and Triggs: Histograms of oriented gradients for
/// human detection, 2005), by OpenCV's HOGDescriptor. As in the
/// thesis there are 4 x 4 cells, one block over all of them and 9 orientations. The thesis's window of 16 x 26 pixels
/// is no multiple of 4 x 4 cells of whole pixels; 32 x 32 is, and what is warped to it has no aspect of its own.
struct HogOptions {
  int columns = 4, rows = 4;  ///< of cells in the window
  int cell = 8;               ///< side of a cell [px]
  int block = 4;              ///< side of a block, over which contrast is normalised [cells]
  int orientations = 9;       ///< over half a turn: what is dark on bright equals what is bright on dark
  double margin = 0.0625;     ///< of the window on each side that shows what is around the region

  static const base::OptionTable<HogOptions>& table();
  /// Numbers of a description.
  int length() const { return (columns - block + 1) * (rows - block + 1) * block * block * orientations; }
};

/// What a region looks like: the histograms of the region, warped to the window, 8 bits each.
using SignFeatures = std::vector<std::uint8_t>;

/// Throws as SignDetector::detect().
std::vector<SignFeatures> describe(const perception::ColourImage& picture, const std::vector<Corners>& regions,
                                   const HogOptions& options);

/// A support vector machine with a radial basis function (thesis, equation 2), and what makes its value a probability.
struct SignModel {
  HogOptions hog;
  double gamma = 0;                   ///< of the kernel: exp(-gamma |x - y|^2), features in [0, 0.5]
  double bias = 0;                    ///< b
  double slope = -1, offset = 0;      ///< probability 1 / (1 + exp(slope y + offset))
  std::vector<double> weights;        ///< of each support vector
  std::vector<SignFeatures> vectors;  ///< hog.length() numbers each
};

/// Tells door signs from other things (thesis 3.5.3.2). Immutable, thread-safe.
///
/// A probability is meant for regions of which half are signs: whoever knows better adds the logarithm of the ratio to
/// its logit. Of the regions that SaliencyProposer finds one in fifty to a hundred is a sign.
class SignClassifier {
 public:
  /// Throws std::invalid_argument for a model whose parts do not fit one another or are not finite.
  explicit SignClassifier(SignModel model);
  /// The one that is shipped: trained on pictures of the simulator's buildings, doc/results/signs.md.
  static const SignClassifier& known();
  /// Throws Error(unreadable_input), which names the file and what helps, for what is missing, no model, damaged, or of
  /// a later version.
  static SignClassifier read(const std::string& path);
  static SignClassifier fromBytes(std::string_view bytes, const std::string& name_for_messages);
  /// The same model, the same bytes.
  std::string toBytes() const;
  /// Throws as base::writeFile().
  void write(const std::string& path) const;

  const SignModel& model() const { return model_; }
  /// y(x) of equation 2; above 0 the machine takes it for a sign.
  double decision(const SignFeatures& features) const;
  /// 0 to 1.
  double probability(const SignFeatures& features) const;
  /// The same of each region. Throws as SignDetector::detect().
  std::vector<double> probabilities(const perception::ColourImage& picture, const std::vector<Corners>& regions) const;

 private:
  SignModel model_;
};

}  // namespace omnimapper::signs
