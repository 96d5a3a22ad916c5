/// espalier render: a picture of models and lattices, without a window.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deform/model/model_file.h"
#include "lattice/core/error.h"
#include "lattice/core/text_scanner.h"
#include "lattice/io/lattice.h"
#include "lattice/subdivision/refine.h"
#include "tools/command.h"
#include "tools/report.h"
#include "viewer/render/camera.h"
#include "viewer/render/render_picture.h"
#include "viewer/render/scene_drawing.h"

namespace espalier::tools {
namespace {

using namespace espalier::viewer;

/// "WIDTHxHEIGHT" in pixels.
std::pair<int, int> parse_size(const std::string& word) {
  const std::size_t cross = word.find('x');
  std::int64_t width = 0;
  std::int64_t height = 0;
  const std::string_view text = word;
  if (cross == std::string::npos || !parse_integer(text.substr(0, cross), width) ||
      !parse_integer(text.substr(cross + 1), height) || width < 1 || height < 1 ||
      width > kLargestPictureSide || height > kLargestPictureSide) {
    throw ParameterError(fmt::format("'size' is '{}', must be WIDTHxHEIGHT with sides from 1 to {}",
                                     word, kLargestPictureSide));
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

/// A named view, or "AZIMUTH,ELEVATION" in degrees.
ViewAngles parse_view(const std::string& word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string::npos) {
    return named_view(word);
  }
  ViewAngles angles;
  const std::string_view text = word;
  if (!parse_number(text.substr(0, comma), angles.azimuth) ||
      !parse_number(text.substr(comma + 1), angles.elevation) ||
      !(std::abs(angles.azimuth) <= 3600) || !(std::abs(angles.elevation) <= 90)) {
    throw ParameterError("'view' is '" + word +
                         "', must be a name or AZIMUTH,ELEVATION in degrees, such as 30,20");
  }
  return angles;
}

/// Pictures are PNG whatever the file is called: names that say otherwise are refused.
void require_png_path(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".png" && !path.starts_with("/dev/")) {
    throw FileError(path, "a picture's name must end in .png");
  }
}

ExitStatus run(const Arguments& arguments, const Session& session) {
  const std::string& output = arguments.text("output");
  require_png_path(output);
  const auto [width, height] = parse_size(arguments.text("size"));
  Camera camera;
  camera.angles = parse_view(arguments.text("view"));
  camera.up = arguments.text("up") == "z" ? UpAxis::Z : UpAxis::Y;
  const LatticeShape shape = arguments.flag("rest") ? LatticeShape::Rest : LatticeShape::Posed;
  const int levels = arguments.integer("levels");
  if (levels < 0 || levels > 6) {
    throw ParameterError("'levels' must be 0 to 6");
  }
  std::vector<Model> models;
  std::vector<Lattice> lattices;
  for (const std::string& path : arguments.texts("scene")) {
    if (is_lattice_path(path)) {
      lattices.push_back(read_any_lattice(path, session.progress));
      const auto* subdivision = lattices.back().as<SubdivisionLattice>();
      if (levels > 0 && subdivision == nullptr) {
        throw ParameterError(fmt::format("'levels' is for subdivision lattices, {} is a {} lattice",
                                         path, lattices.back().type()));
      }
      if (levels > 0) {
        lattices.back() = refined(*subdivision, levels);
      }
    } else {
      models.push_back(read_model(path));
    }
  }
  const DrawingFrame frame = DrawingFrame::of(bounds(models, lattices, shape));
  const float pen = std::clamp(static_cast<float>(std::min(width, height)) / 800, 0.5F, 8.0F);
  const Drawing drawing = draw_scene(models, lattices, shape, frame, pen);
  std::vector<glm::dvec3> shown;
  for (const TriangleMesh& mesh : drawing.meshes) {
    shown.insert(shown.end(), mesh.positions.begin(), mesh.positions.end());
  }
  for (const LineSet& lines : drawing.lines) {
    shown.insert(shown.end(), lines.points.begin(), lines.points.end());
  }
  camera = camera.fitted_to(shown, static_cast<double>(width) / height);
  write_png(output, render_picture(drawing, camera, width, height));
  if (!session.is_quiet && output != "/dev/stdout") {
    std::fputs(picture_report(output, width, height, session.is_json).c_str(), stdout);
  }
  return ExitStatus::Done;
}

}  // namespace

Command render_command() {
  using Type = ParameterType;
  return {
      "render",
      "Draw models and lattices into a PNG file",
      {{.name = "scene",
        .type = Type::Path,
        .help = "models (.obj, .off, .ply, .stl) and lattices (.json, .ovm)",
        .is_required = true,
        .is_positional = true,
        .is_list = true},
       {.name = "view",
        .type = Type::Text,
        .help = "front, back, left, right, top, bottom, iso, three-quarter, or AZIMUTH,ELEVATION "
                "in degrees (default three-quarter)",
        .fallback = Value(std::string("three-quarter"))},
       {.name = "size",
        .type = Type::Text,
        .help = "WIDTHxHEIGHT in pixels (default 1200x900)",
        .fallback = Value(std::string("1200x900"))},
       {.name = "up",
        .type = Type::Choice,
        .help = "the axis that points up (default y)",
        .choices = {"y", "z"},
        .fallback = Value(std::string("y"))},
       {.name = "rest", .type = Type::Flag, .help = "draw lattices at rest, not posed"},
       {.name = "levels",
        .type = Type::Integer,
        .help = "draw subdivision lattices refined so often (default 0)",
        .fallback = Value(std::int64_t{0})},
       {.name = "output", .type = Type::Path, .help = "the picture, .png", .is_required = true}},
      run};
}

}  // namespace espalier::tools
