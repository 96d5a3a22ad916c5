#include "lattice/osd/refine_values.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "lattice/core/error.h"
#include "lattice/osd/used_mesh.h"

namespace espalier::osd {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using Interpolator = Far::PrimvarRefinerReal<double>;

/// What OpenSubdiv interpolates: a place or a number.
template <class T>
struct Sum {
  T at{0};
  void Clear() { at = T(0); }
  void AddWithWeight(const Sum& other, double weight) { at += weight * other.at; }
};

/// The value of a corner, and of which it is made.
struct CornerSum {
  static constexpr std::int32_t kNothing = -1;
  static constexpr std::int32_t kSeveral = -2;

  glm::dvec3 at{0};
  std::int32_t source = kNothing;  ///< the one old value that it is
  bool is_missing = false;

  void Clear() { *this = {}; }
  void AddWithWeight(const CornerSum& other, double weight) {
    if (weight == 0) {
      return;
    }
    at += weight * other.at;
    source = source == kNothing || source == other.source ? other.source : kSeveral;
    is_missing = is_missing || other.is_missing;
  }
};

/// A mesh with a channel of values for each of the surface's; corners without one refer to a value
/// after all others.
std::unique_ptr<Far::TopologyRefiner> make_refiner(const SurfaceValues& surface,
                                                   const UsedMesh& mesh, SurfaceScheme scheme) {
  std::vector<std::vector<int>> indices;
  std::vector<Far::TopologyDescriptor::FVarChannel> channels;
  for (const CornerValues& channel : surface.channels) {
    const int none = static_cast<int>(channel.values.size());
    std::vector<int>& corners = indices.emplace_back(channel.of_corners.begin(),  //
                                                     channel.of_corners.end());
    std::replace_if(
        corners.begin(), corners.end(), [](int value) { return value < 0; }, none);
    Far::TopologyDescriptor::FVarChannel& described = channels.emplace_back();
    described.numValues = none + 1;
    described.valueIndices = corners.data();
  }
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(mesh.points.size());
  descriptor.numFaces = static_cast<int>(mesh.sizes.size());
  descriptor.numVertsPerFace = mesh.sizes.data();
  descriptor.vertIndicesPerFace = mesh.corners.data();
  descriptor.numFVarChannels = static_cast<int>(channels.size());
  descriptor.fvarChannels = channels.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  options.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_ALL);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const Sdc::SchemeType type =
      scheme == SurfaceScheme::Loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(descriptor, Factory::Options(type, options)));
  if (!refiner) {
    throw ParameterError("refine: OpenSubdiv cannot order the faces of this mesh");
  }
  Far::TopologyRefiner::UniformOptions uniform(1);
  uniform.fullTopologyInLastLevel = false;
  refiner->RefineUniform(uniform);
  return refiner;
}

class Refinement {
 public:
  Refinement(const SurfaceValues& surface, SurfaceScheme scheme)
      : surface_(surface),
        mesh_(used_mesh(surface.points.size(), surface.faces)),
        refiner_(make_refiner(surface, mesh_, scheme)),
        interpolator_(*refiner_) {}

  [[nodiscard]] SurfaceValues result() {
    number_points();
    add_points();
    for (std::size_t i = 0; i < surface_.channels.size(); ++i) {
      add_channel(i);
    }
    add_faces();
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Far::TopologyLevel& fine() const { return refiner_->GetLevel(1); }

  /// Old points keep their numbers, the others follow.
  void number_points() {
    numbers_.assign(static_cast<std::size_t>(fine().GetNumVertices()), -1);
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      const int child = refiner_->GetLevel(0).GetVertexChildVertex(static_cast<int>(i));
      numbers_[static_cast<std::size_t>(child)] = mesh_.points[i];
    }
    auto next = static_cast<std::int32_t>(surface_.points.size());
    for (std::int32_t& number : numbers_) {
      number = number < 0 ? next++ : number;
    }
    n_points_ = static_cast<std::size_t>(next);
  }

  void add_points() {
    std::vector<Sum<glm::dvec3>> places;
    for (const std::int32_t point : mesh_.points) {
      places.push_back({surface_.points[static_cast<std::size_t>(point)]});
    }
    std::vector<Sum<glm::dvec3>> refined(numbers_.size());
    Sum<glm::dvec3>* target = refined.data();
    interpolator_.Interpolate(1, places.data(), target);
    result_.points = surface_.points;
    result_.points.resize(n_points_);
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      result_.points[static_cast<std::size_t>(numbers_[i])] = refined[i].at;
    }
    result_.n_extras = surface_.n_extras;
    result_.extras = surface_.extras;
    result_.extras.resize(n_points_ * surface_.n_extras);
    for (std::size_t k = 0; k < surface_.n_extras; ++k) {
      add_extra(k);
    }
  }

  void add_extra(std::size_t k) {
    std::vector<Sum<double>> values;
    for (const std::int32_t point : mesh_.points) {
      values.push_back({surface_.extras[static_cast<std::size_t>(point) * surface_.n_extras + k]});
    }
    std::vector<Sum<double>> refined(numbers_.size());
    Sum<double>* target = refined.data();
    interpolator_.InterpolateVarying(1, values.data(), target);
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      if (const auto number = static_cast<std::size_t>(numbers_[i]);
          number >= surface_.points.size()) {
        result_.extras[number * surface_.n_extras + k] = refined[i].at;
      }
    }
  }

  void add_channel(std::size_t index) {
    const int i = static_cast<int>(index);
    const CornerValues& channel = surface_.channels[index];
    std::vector<CornerSum> values;
    for (const glm::dvec3& value : channel.values) {
      values.push_back({value, static_cast<std::int32_t>(values.size())});
    }
    values.push_back({glm::dvec3(0), static_cast<std::int32_t>(values.size()), true});
    std::vector<CornerSum> refined(static_cast<std::size_t>(fine().GetNumFVarValues(i)));
    CornerSum* target = refined.data();
    interpolator_.InterpolateFaceVarying(1, values.data(), target, i);
    CornerValues& result = result_.channels.emplace_back();
    result.values = channel.values;
    std::vector<std::int32_t> numbers;
    for (const CornerSum& value : refined) {
      const bool is_new = !value.is_missing && value.source < 0;
      numbers.push_back(value.is_missing ? -1
                        : is_new         ? static_cast<std::int32_t>(result.values.size())
                                         : value.source);
      if (is_new) {
        result.values.push_back(value.at);
      }
    }
    for (int face = 0; face < fine().GetNumFaces(); ++face) {
      for (const int value : fine().GetFaceFVarValues(face, i)) {
        result.of_corners.push_back(numbers[static_cast<std::size_t>(value)]);
      }
    }
  }

  void add_faces() {
    std::vector<std::int32_t> loop;
    for (int face = 0; face < fine().GetNumFaces(); ++face) {
      loop.clear();
      for (const int vertex : fine().GetFaceVertices(face)) {
        loop.push_back(numbers_[static_cast<std::size_t>(vertex)]);
      }
      result_.faces.push_back(loop);
      result_.parents.push_back(fine().GetFaceParentFace(face));
    }
  }

  const SurfaceValues& surface_;
  UsedMesh mesh_;
  std::unique_ptr<Far::TopologyRefiner> refiner_;
  Interpolator interpolator_;
  std::vector<std::int32_t> numbers_;  // of refined points
  std::size_t n_points_ = 0;
  SurfaceValues result_;
};

}  // namespace

SurfaceValues refine_values(const SurfaceValues& surface, SurfaceScheme scheme) {
  return Refinement(surface, scheme).result();
}

}  // namespace espalier::osd
