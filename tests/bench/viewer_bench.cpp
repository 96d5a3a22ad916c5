/// How long it takes from a move of the mouse to deformed vertices, beside the bare kernels of
/// drags and evaluation on the same vertices. Ratios within this run; one thread, time of the
/// processor.
///
/// usage: viewer_bench

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "deform/evaluate/drag.h"
#include "lattice/core/file.h"
#include "lattice/core/parallel.h"
#include "tests/bench/timing.h"
#include "viewer/interact/session.h"

namespace espalier::viewer {
namespace {

using bench::best_seconds;
using bench::print_mark;

/// A wavy torus in [0, 10]³ of about n points, as a file.
std::string torus(std::size_t n) {
  const auto round = static_cast<std::size_t>(std::sqrt(2.0 * static_cast<double>(n)));
  const std::size_t across = n / round;
  std::string text;
  for (std::size_t j = 0; j < across; ++j) {
    for (std::size_t i = 0; i < round; ++i) {
      const double a = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(round);
      const double b = 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(across);
      const double r = 1.4 + 0.15 * std::sin(7 * a) * std::cos(5 * b);
      text += fmt::format("v {} {} {}\n", 5 + (3 + r * std::cos(b)) * std::cos(a),
                          5 + (3 + r * std::cos(b)) * std::sin(a), 5 + 1.8 * r * std::sin(b));
    }
  }
  for (std::size_t j = 0; j < across; ++j) {
    for (std::size_t i = 0; i < round; ++i) {
      const std::size_t k = (i + 1) % round;
      const std::size_t l = (j + 1) % across;
      text += fmt::format("f {} {} {} {}\n", 1 + i + round * j, 1 + k + round * j,
                          1 + k + round * l, 1 + i + round * l);
    }
  }
  return text;
}

/// A session with the torus bound to a grid of 10³ cells, all control points selected.
Session session_with(std::size_t n) {
  const std::string path =
      (std::filesystem::temp_directory_path() / "espalier_viewer_bench.obj").string();
  write_file(path, torus(n));
  Session session;
  session.open(path);
  std::filesystem::remove(path);
  session.run_line("new box cells=10,10,10 max=10,10,10 output=grid");
  session.frame_all();
  session.bind();
  session.set_mode(Mode::Pose);
  session.select_all(true);
  return session;
}

/// What the session's model is, for kernels of our own.
struct Bare {
  std::vector<glm::dvec3> rest, normals;
  std::vector<LatticeMotion> motions;
  std::vector<glm::vec3> points, turned;
  std::vector<float> determinants;

  explicit Bare(const Session& session) {
    const auto& [name, bent] = *session.bent_models().all().begin();
    const auto& [names, bound] = *session.scene().bound.begin();
    rest.assign(bent.model().points().begin(), bent.model().points().end());
    normals.assign(bent.normals().begin(), bent.normals().end());
    normals.resize(rest.size(), glm::dvec3(0, 0, 1));
    const Volume& volume = *bound.volume;
    motions = {{bound.volume, bound.binding, volume.displacements(volume.rest_controls())}};
    points.resize(rest.size());
    turned.resize(rest.size());
    determinants.resize(bound.binding->points.size());
  }
};

/// Moves the mouse to and fro by one pixel, so that every move is one.
class Shaking {
 public:
  explicit Shaking(Session& session) : session_(session) {}
  void move() {
    at_.x = at_.x > 0 ? 0 : 1;
    session_.handle(MouseMove{glm::dvec2(640, 400) + at_});
  }

 private:
  Session& session_;
  glm::dvec2 at_{0.0};
};

void bench_drag(std::size_t n, TransformKind kind) {
  Session session = session_with(n);
  session.handle(MouseMove{{640, 400}});
  const Bare bare(session);
  std::vector<glm::vec3> points = bare.points;
  std::vector<glm::vec3> normals = bare.turned;
  const std::vector<double> selection(bare.motions[0].volume->n_controls(), 1.0);
  const DragModel model{.rest_points = bare.rest, .motions = bare.motions, .normals = bare.normals};
  session.begin_transform(kind);
  Shaking mouse(session);
  const int rounds = n < 100000 ? 60 : 12;
  if (kind == TransformKind::Move) {
    const Drag<float> drag(model, selection);
    const auto [moves, kernel] = best_seconds(
        rounds, [&] { mouse.move(); },
        [&] {
          drag.update({0.01, 0.01, 0}, 0.01, {.points = points, .normals = normals});
        });
    print_mark(fmt::format("move, {} vertices: to a drag's update", points.size()), moves / kernel,
               '<', 1.3);
  } else {
    const AffineDrag<float> drag(
        model, {selection, bare.motions[0].volume->rest_controls(), glm::dvec3(5)});
    const glm::dmat3 map(1, 0.01, 0, -0.01, 1, 0, 0, 0, 1);
    const auto [moves, kernel] = best_seconds(
        rounds, [&] { mouse.move(); },
        [&] { drag.update(map, 0.01, {.points = points, .normals = normals}); });
    print_mark(fmt::format("turn, {} vertices: to an affine drag's update", points.size()),
               moves / kernel, '<', 1.3);
  }
}

/// A soft turn is no linear map: everything is evaluated.
void bench_evaluation(std::size_t n) {
  Session session = session_with(n);
  session.handle(MouseMove{{640, 400}});
  Bare bare(session);
  const Volume& volume = *bare.motions[0].volume;
  const Binding& binding = *bare.motions[0].binding;
  std::vector<glm::dvec3> rest;
  std::vector<glm::dvec3> normals;
  for (const std::int32_t point : binding.points) {
    rest.push_back(bare.rest[static_cast<std::size_t>(point)]);
    normals.push_back(bare.normals[static_cast<std::size_t>(point)]);
  }
  const Evaluator<float> evaluator(volume, {binding.patches, binding.uvw, rest, normals});
  VolumeMotion<float> motion(volume.n_points());
  std::vector<glm::dvec3> controls(volume.rest_controls().begin(), volume.rest_controls().end());
  Handling handling = session.handling();
  handling.is_soft = true;
  session.set_handling(handling);
  session.begin_transform(TransformKind::Turn);
  Shaking mouse(session);
  double step = 0;
  std::vector<glm::vec3> points(rest.size());
  std::vector<glm::vec3> turned(rest.size());
  const auto [moves, kernel] = best_seconds(
      n < 100000 ? 30 : 6, [&] { mouse.move(); },
      [&] {
        step = 0.01 - step;
        for (glm::dvec3& control : controls) {
          control.x += step - 0.005;
        }
        motion.set(volume.displacements(controls));
        evaluator.evaluate(
            motion, {.points = points, .determinants = bare.determinants, .normals = turned});
      });
  print_mark(fmt::format("soft turn, {} vertices: to a full evaluation", points.size()),
             moves / kernel, '<', 1.3);
}

}  // namespace
}  // namespace espalier::viewer

int main() {
  using namespace espalier;
  using namespace espalier::viewer;
  set_thread_count(1);
  fmt::print("from a move of the mouse to deformed vertices, {}, one thread\n",
             name_of(instruction_set()));
  for (const std::size_t n : {46590U, 527252U}) {
    bench_drag(n, TransformKind::Move);
    bench_drag(n, TransformKind::Turn);
    bench_evaluation(n);
  }
}
