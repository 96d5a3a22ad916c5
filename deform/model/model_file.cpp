#include "deform/model/model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "deform/model/obj.h"
#include "deform/model/off.h"
#include "deform/model/ply.h"
#include "deform/model/stl.h"
#include "lattice/core/error.h"
#include "lattice/core/file.h"

namespace espalier {
namespace {

struct FormatEntry {
  ModelFormat format;
  std::string_view extension;
  Model (*parse)(std::string path, std::string bytes);
};

constexpr FormatEntry kFormats[] = {
    {ModelFormat::Obj, ".obj", parse_obj},
    {ModelFormat::Off, ".off", parse_off},
    {ModelFormat::Ply, ".ply", parse_ply},
    {ModelFormat::Stl, ".stl", parse_stl},
};

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

std::string known_extensions() {
  std::string names;
  for (const FormatEntry& entry : kFormats) {
    names += (names.empty() ? "" : ", ") + std::string(entry.extension);
  }
  return names;
}

const FormatEntry& entry_of(ModelFormat format) {
  return *std::find_if(std::begin(kFormats), std::end(kFormats),
                       [format](const FormatEntry& entry) { return entry.format == format; });
}

}  // namespace

Model parse_model(ModelFormat format, std::string path, std::string bytes) {
  return entry_of(format).parse(std::move(path), std::move(bytes));
}

Model read_model(const std::string& path) {
  const std::string extension = extension_of(path);
  for (const FormatEntry& entry : kFormats) {
    if (entry.extension == extension) {
      return entry.parse(path, read_file(path));
    }
  }
  throw FileError(
      path, fmt::format("not a model: {}; models that can be read: {}",
                        extension.empty() ? "the name has no extension"
                                          : fmt::format("extension '{}' is unknown", extension),
                        known_extensions()));
}

void require_same_format(const std::string& path, const Model& model) {
  const std::string extension = extension_of(path);
  const std::string_view own = entry_of(model.format()).extension;
  if (!extension.empty() && extension != own) {
    throw FileError(path, fmt::format("cannot write {} as '{}': a model keeps its format; name "
                                      "the output *{}",
                                      model.path(), extension, own));
  }
}

void write_model(const std::string& path, const Model& model) {
  require_same_format(path, model);
  write_file(path, model.bytes());
}

}  // namespace espalier
