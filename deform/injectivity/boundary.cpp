// [MO63] G. H. Meisters, C. Olech, "Locally one-to-one mappings and a classical theorem on schlicht
// functions", 1963.

#include "deform/injectivity/boundary.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <utility>

#include "deform/injectivity/boundary_parts.h"
#include "deform/injectivity/boundary_seams.h"
#include "deform/injectivity/face_pair.h"
#include "deform/injectivity/pose_checks.h"
#include "lattice/core/box_tree.h"
#include "lattice/core/parallel.h"

namespace espalier {
namespace {

/// What a coordinate of a control point may be off by, of the largest: stencils sum up hundreds of
/// weights, and parts are cut by tens of steps.
constexpr double kRounding = 1e-13;
constexpr std::size_t kBatch = 128;  // faces between two looks at what was found
constexpr std::size_t kGrain = 16;
constexpr std::size_t kMostPairs = 8;       // of one face that may take all the boxes they may
constexpr std::size_t kMostPatience = 100;  // undecided pairs

BoundaryPlace place_of(const BoundaryMesh& mesh, std::size_t face, const glm::dvec2& st) {
  const BoundaryFaceId& id = mesh.faces[face];
  return {static_cast<std::size_t>(id.patch), patch_place(id.face, st), mesh.rest[face].value(st)};
}

/// What is found out about the pairs of one face with itself and later ones.
struct FaceFindings {
  std::vector<BoundaryCrossing> crossings;
  std::vector<UndecidedFaces> undecided;
};

class BoundaryTester {
 public:
  BoundaryTester(const BoundaryMesh& mesh, double tolerance, const BoundaryOptions& options)
      : mesh_(mesh), tolerance_(tolerance), options_(options), tree_(boxes_of(mesh, tolerance)) {}

  void test(BoundaryReport& report, const Progress& progress) const {
    const std::size_t n = mesh_.faces.size();
    for (std::size_t begin = 0; begin < n; begin += kBatch) {
      progress.update("boundary", static_cast<double>(begin) / static_cast<double>(n));
      const std::size_t end = std::min(begin + kBatch, n);
      std::vector<FaceFindings> found(end - begin);
      // Once it is not simple, pairs that can hardly be told apart are of less interest.
      const bool is_spent = !report.crossings.empty() || report.undecided.size() >= kMostPatience;
      const std::size_t most_boxes = is_spent ? options_.most_boxes / 16 : options_.most_boxes;
      parallel_ranges(found.size(), kGrain, [&](std::size_t from, std::size_t to) {
        FacePairTester tester(mesh_, tolerance_);
        for (std::size_t i = from; i < to; ++i) {
          test_face(begin + i, tester, most_boxes, found[i]);
        }
      });
      for (const FaceFindings& of_face : found) {
        report.crossings.insert(report.crossings.end(), of_face.crossings.begin(),
                                of_face.crossings.end());
        report.undecided.insert(report.undecided.end(), of_face.undecided.begin(),
                                of_face.undecided.end());
      }
      if (report.crossings.size() >= options_.most_crossings) {
        report.crossings.resize(options_.most_crossings);
        return;
      }
      if (report.undecided.size() >= options_.most_undecided) {
        return;
      }
    }
    progress.update("boundary", 1.0);
  }

 private:
  static std::vector<Box> boxes_of(const BoundaryMesh& mesh, double tolerance) {
    std::vector<Box> boxes;
    std::vector<glm::dvec3> points;
    for (const FaceNet& net : mesh.pose) {
      net.positions(points);
      boxes.push_back(box_of(points).grown(2 * tolerance));
    }
    return boxes;
  }

  void test_face(std::size_t face, FacePairTester& tester, std::size_t most_boxes,
                 FaceFindings& found) const {
    std::vector<std::size_t> others;
    tree_.visit_overlapping(tree_.box(face), [&](std::size_t other) {
      if (other >= face) {
        others.push_back(other);
      }
    });
    std::sort(others.begin(), others.end());
    std::size_t boxes_left = kMostPairs * most_boxes;
    for (const std::size_t other : others) {
      const FacePairResult result = tester.test(face, other, std::min(most_boxes, boxes_left));
      boxes_left -= std::min(result.n_boxes, boxes_left);
      if (result.crossing) {
        const auto& [at, at_other] = *result.crossing;
        found.crossings.push_back({place_of(mesh_, face, at), place_of(mesh_, other, at_other),
                                   mesh_.pose[face].value(at)});
      } else if (!result.is_apart) {
        const BoundaryFaceId& a = mesh_.faces[face];
        const BoundaryFaceId& b = mesh_.faces[other];
        found.undecided.push_back(
            {{static_cast<std::size_t>(a.patch), static_cast<std::size_t>(b.patch)},
             {a.face, b.face}});
      }
      if (found.crossings.size() >= options_.most_crossings ||
          found.undecided.size() >= options_.most_undecided) {
        return;
      }
    }
  }

  const BoundaryMesh& mesh_;
  double tolerance_;
  const BoundaryOptions& options_;
  BoxTree tree_;
};

/// Whether the first patch of the boundary is left-handed in the pose.
bool is_mirrored(const Volume& volume, const BoundaryMesh& mesh,
                 std::span<const glm::dvec3> points) {
  const auto patch = static_cast<std::size_t>(mesh.faces.front().patch);
  return glm::determinant(volume.bezier(patch, points).derivative(glm::dvec3(0.5))) < 0;
}

}  // namespace

BoundaryReport check_boundary(const Volume& volume, std::span<const glm::dvec3> pose,
                              std::span<const double> pose_weights, const BoundaryOptions& options,
                              const Progress& progress) {
  require_coordinates("pose", pose, volume.n_controls());
  require_weights(pose_weights, volume);
  const double tolerance = kRounding * largest_coordinate(pose);
  const std::vector<glm::dvec3> points = volume.points(pose);
  const BoundaryMesh mesh = boundary_mesh(volume, points, pose_weights);
  BoundaryReport report;
  report.n_faces = mesh.faces.size();
  BoundaryTester(mesh, tolerance, options).test(report, progress);
  const std::vector<std::int32_t> parts = boundary_parts(mesh);
  report.n_parts =
      parts.empty() ? 0
                    : static_cast<std::size_t>(*std::max_element(parts.begin(), parts.end())) + 1;
  if (!report.crossings.empty()) {
    report.verdict = BoundaryVerdict::Intersecting;
  } else if (!report.undecided.empty()) {
    report.verdict = BoundaryVerdict::Undecided;
  } else if (report.n_parts > 1) {
    report.is_unnested = is_covered_once(mesh, parts, is_mirrored(volume, mesh, points));
  }
  return report;
}

}  // namespace espalier
