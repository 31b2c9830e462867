#include "omnimapper/graph/ChiSquare.h"

#include <boost/math/distributions/chi_squared.hpp>

namespace omnimapper::graph {

double chiSquareQuantile(double probability, int degrees_of_freedom) {
  return boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

}  // namespace omnimapper::graph
