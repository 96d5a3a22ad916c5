#include "lattice/build/checks.h"

#include <cmath>

#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {

void check_point(const std::string& name, const std::string& what, const glm::dvec3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(point[axis]) <= kLargestCoordinate)) {
      throw ParameterError(name + ": " + what + " must have finite coordinates");
    }
  }
}

void check_axis(const std::string& name, const glm::dvec3& from, const glm::dvec3& to) {
  check_point(name, "the axis", from);
  check_point(name, "the axis", to);
  if (from == to) {
    throw ParameterError(name + ": the ends of an axis must differ");
  }
}

void check_size(const std::string& name, const std::string& what, double size) {
  if (!(size > 0) || size > kLargestCoordinate) {
    throw ParameterError(name + ": " + what + " must be positive");
  }
}

void check_count(const std::string& name, const std::string& what, int count, int least, int most) {
  if (count < least || count > most) {
    throw ParameterError(name + ": " + what + " is " + std::to_string(count) + ", must be " +
                         std::to_string(least) + " to " + std::to_string(most));
  }
}

}  // namespace espalier
