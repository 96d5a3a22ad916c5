#include "deform/model/model.h"

#include <utility>

namespace espalier {

Model::Model(std::string path, ModelFormat format, std::string bytes, ModelLayout layout)
    : data_(std::make_shared<const Data>(
          Data{std::move(path), format, std::move(bytes), std::move(layout)})) {}

}  // namespace espalier
