#include "deform/scene/element_lists.h"

#include "deform/scene/index_list.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"

namespace espalier {

std::vector<std::int32_t> indices_of(const Arguments& arguments, const std::string& name) {
  if (!arguments.has(name)) {
    return {};
  }
  auto indices = parse_index_list(arguments.text(name));
  if (!indices) {
    throw ParameterError("'" + name + "' is " + quoted(arguments.text(name)) +
                         ", must be indices such as 0,3,7-9");
  }
  return *std::move(indices);
}

std::vector<std::array<std::int32_t, 2>> edges_of(const Arguments& arguments,
                                                  const std::string& name) {
  std::vector<std::array<std::int32_t, 2>> edges;
  if (!arguments.has(name)) {
    return edges;
  }
  for (const std::string& word : words_between(arguments.text(name), ',')) {
    const auto ends = parse_indices(word);
    if (!ends || ends->size() != 2) {
      throw ParameterError("'" + name + "' is " + quoted(arguments.text(name)) +
                           ", must be edges by their vertices, such as 0-1,4-5");
    }
    edges.push_back({(*ends)[0], (*ends)[1]});
  }
  return edges;
}

}  // namespace espalier
