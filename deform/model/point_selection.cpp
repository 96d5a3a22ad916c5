#include "deform/model/point_selection.h"

#include <algorithm>

#include "lattice/core/error.h"
#include "lattice/core/file.h"
#include "lattice/core/text_scanner.h"

namespace espalier {
namespace {

/// Calls read(word, scanner) for the one word on every line that has any.
template <class Read>
void for_each_line(const std::string& path, const Read& read) {
  const std::string text = read_file(path);
  TextScanner scanner(path, text, {.comment = '#'});
  while (scanner.next_line()) {
    const std::string_view word = scanner.next_word();
    if (!word.empty()) {
      read(word, scanner);
      scanner.expect_end_of_line("the number");
    }
  }
}

std::string some_names(const Model& model) {
  constexpr std::size_t kNamesShown = 8;
  if (model.groups().empty()) {
    return "it has none";
  }
  std::string names;
  for (std::size_t i = 0; i < std::min(model.groups().size(), kNamesShown); ++i) {
    names += (names.empty() ? "" : ", ") + model.groups()[i].name;
  }
  const bool is_all = model.groups().size() <= kNamesShown;
  return "it has " + names + (is_all ? "" : ", …");
}

void select_group(const Model& model, const std::string& name, std::vector<double>& weights) {
  const auto groups = model.groups();
  const auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const FaceGroup& each) { return each.name == name; });
  if (group == groups.end()) {
    throw ParameterError(model.path() + " has no group or object named " + quoted(name) + ": " +
                         some_names(model));
  }
  for (const FaceRange& range : group->ranges) {
    for (std::int32_t face = range.begin; face < range.end; ++face) {
      for (const std::int32_t point : model.faces()[static_cast<std::size_t>(face)]) {
        weights[static_cast<std::size_t>(point)] = 1;
      }
    }
  }
}

void select_indices(const std::string& path, std::vector<double>& weights) {
  const auto n = static_cast<std::int64_t>(weights.size());
  for_each_line(path, [&](std::string_view word, const TextScanner& scanner) {
    std::int64_t index = -1;
    if (!parse_integer(word, index) || index < 0 || index >= n) {
      scanner.fail(quoted(word) + " is no index of a point: must be 0 to " + std::to_string(n - 1));
    }
    weights[static_cast<std::size_t>(index)] = 1;
  });
}

/// Multiplies the weights by those in a file.
void multiply_by_file(const std::string& path, std::vector<double>& weights) {
  std::size_t n = 0;
  for_each_line(path, [&](std::string_view word, const TextScanner& scanner) {
    double weight = -1;
    if (!parse_number(word, weight) || !(weight >= 0 && weight <= 1)) {
      scanner.fail(quoted(word) + " is no weight: must be a number from 0 to 1");
    }
    if (n == weights.size()) {
      scanner.fail("more weights than the model has points, " + std::to_string(n));
    }
    weights[n++] *= weight;
  });
  if (n < weights.size()) {
    throw FileError(path, "has " + std::to_string(n) + " weights, the model has " +
                              std::to_string(weights.size()) + " points");
  }
}

}  // namespace

std::vector<double> point_weights(const Model& model, std::span<const std::string> only,
                                  const std::string& weights_file) {
  if (only.empty() && weights_file.empty()) {
    return {};
  }
  std::vector<double> weights(model.points().size(), only.empty() ? 1.0 : 0.0);
  for (const std::string& part : only) {
    if (part.starts_with('@')) {
      select_indices(part.substr(1), weights);
    } else {
      select_group(model, part, weights);
    }
  }
  if (!weights_file.empty()) {
    multiply_by_file(weights_file, weights);
  }
  return weights;
}

std::vector<glm::dvec3> selected_points(const Model& model, std::span<const std::string> only) {
  const std::vector<double> weights = point_weights(model, only, "");
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < model.points().size(); ++i) {
    if (weights.empty() || weights[i] > 0) {
      points.push_back(model.points()[i]);
    }
  }
  return points;
}

}  // namespace espalier
