#pragma once

/// Models in and out of files, by extension.

#include <string>

#include "deform/model/model.h"

namespace espalier {

/// Reads the model at `path`; its extension (.obj, .off, .ply or .stl, in any case)
/// says how.
/// Throws FileError for an unknown extension, or as the format's parser does.
[[nodiscard]] Model read_model(const std::string& path);

/// The model that `bytes` hold. path: kept as the model's, and named in errors.
[[nodiscard]] Model parse_model(ModelFormat format, std::string path, std::string bytes);

/// Throws FileError unless a model of this format can be written to `path`: a model keeps its
/// format, so the extension must be one of its format's, or missing.
void require_same_format(const std::string& path, const Model& model);

/// Writes the model's bytes to `path`. Throws FileError as require_same_format and write_file do.
void write_model(const std::string& path, const Model& model);

}  // namespace espalier
