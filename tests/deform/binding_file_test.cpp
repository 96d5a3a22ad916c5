#include "deform/embed/binding_file.h"

#include <gmock/gmock.h>

#include <bit>
#include <limits>

#include "deform/embed/fringe.h"
#include "lattice/build/primitives.h"
#include "lattice/core/error.h"
#include "lattice/core/hash.h"
#include "lattice/subdivision/freeze.h"
#include "tests/support/families.h"

namespace espalier {
namespace {

using testing::HasSubstr;

const std::vector<glm::dvec3> kPoints = {
    {0.75, 0.5, 0.75}, {0.3, 0.2, 0.1}, {7, 7, 7}, {0, 0.5, 0.5}};

Volume volume_of_box() {
  return freeze_adaptive(test::lattice_from(make_box({2, 2, 2}, {0, 0, 0}, {1, 1, 1})));
}

SavedBinding saved_binding() {
  const Volume volume = volume_of_box();
  Binding binding = embed(volume, kPoints);
  binding.fringe = make_fringe(volume, kPoints, binding.status, 20);
  return {{1, 2, 3, 4, 5, fingerprint_of(volume), "adaptive", "falloff:20"}, std::move(binding)};
}

std::string error_of(const std::string& bytes) {
  try {
    (void)parse_binding("b", bytes);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

/// What the reader says of a binding that was changed before it was written.
template <class Change>
std::string error_after(const Change& change) {
  SavedBinding saved = saved_binding();
  change(saved.binding);
  return error_of(binding_bytes(saved));
}

/// The bytes with `value` at a place, and the checksum made right again.
std::string patched(std::string bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[at + i] = static_cast<char>(value >> (8 * i) & 0xFF);
  }
  Fingerprint sum;
  sum.add_bytes(std::string_view(bytes).substr(0, bytes.size() - 8));
  for (std::size_t i = 0; i < 8; ++i) {
    bytes[bytes.size() - 8 + i] = static_cast<char>(sum.value() >> (8 * i) & 0xFF);
  }
  return bytes;
}

TEST(BindingFile, reads_back_what_was_written_bit_for_bit) {
  const SavedBinding saved = saved_binding();
  const SavedBinding read = parse_binding("b", binding_bytes(saved));
  EXPECT_EQ(read.source, saved.source);
  EXPECT_EQ(read.binding.status, saved.binding.status);
  EXPECT_EQ(read.binding.points, saved.binding.points);
  EXPECT_EQ(read.binding.patches, saved.binding.patches);
  EXPECT_EQ(read.binding.uvw, saved.binding.uvw);
  EXPECT_EQ(read.binding.points.size(), 3u);
  const Fringe& fringe = saved.binding.fringe;
  ASSERT_EQ(fringe.points, std::vector<std::int32_t>{2});
  EXPECT_EQ(read.binding.fringe.points, fringe.points);
  EXPECT_EQ(read.binding.fringe.patches, fringe.patches);
  EXPECT_EQ(read.binding.fringe.uvw, fringe.uvw);
  EXPECT_EQ(read.binding.fringe.weights, fringe.weights);
  EXPECT_EQ(read.binding.fringe.weight_slopes, fringe.weight_slopes);
  EXPECT_EQ(read.binding.fringe.uvw_slopes, fringe.uvw_slopes);
}

TEST(BindingFile, is_refused_when_cut_short_at_any_byte_or_longer) {
  const std::string bytes = binding_bytes(saved_binding());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_THAT(error_of(bytes.substr(0, n)), HasSubstr("b: is ")) << n;
  }
  EXPECT_THAT(error_of(bytes + "x"), HasSubstr("damaged"));
}

TEST(BindingFile, is_refused_when_any_bit_is_flipped) {
  const std::string bytes = binding_bytes(saved_binding());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int bit : {0, 3, 7}) {
      std::string flipped = bytes;
      flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
      EXPECT_NE(error_of(flipped), "") << i;
    }
  }
}

TEST(BindingFile, is_refused_before_memory_is_taken_for_a_huge_announced_count) {
  const std::string bytes = binding_bytes(saved_binding());
  for (const std::size_t at : {12u, 16u, 20u, 24u, 28u}) {
    EXPECT_THAT(error_of(patched(bytes, at, 0xFFFFFFFFu)), HasSubstr("its header announces"));
  }
}

TEST(BindingFile, of_another_version_is_refused_by_its_number) {
  EXPECT_THAT(error_of(patched(binding_bytes(saved_binding()), 8, 2)),
              HasSubstr("is a binding of version 2, this program knows version 1"));
}

TEST(BindingFile, names_the_first_place_that_is_no_place) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity, 1.1, -0.1, 1e300}) {
    EXPECT_THAT(error_after([&](Binding& b) { b.uvw[1].z = bad; }),
                HasSubstr("held point 1 has parameters outside of its patch"))
        << bad;
  }
  EXPECT_THAT(error_after([](Binding& b) { b.points[2] = 4; }),
              HasSubstr("held point 2 has index 4, must be 0 to 3"));
  EXPECT_THAT(error_after([](Binding& b) { b.points[0] = -1; }), HasSubstr("has index -1"));
  EXPECT_THAT(error_after([](Binding& b) { b.points[1] = b.points[0]; }),
              HasSubstr("occurs twice"));
  EXPECT_THAT(error_after([](Binding& b) { b.points[0] = 2; }), HasSubstr("which is outside"));
  EXPECT_THAT(error_after([](Binding& b) { b.patches[0] = -1; }), HasSubstr("patches must ascend"));
  EXPECT_THAT(error_after([](Binding& b) { b.patches[2] = 0, b.patches[1] = 5; }),
              HasSubstr("patches must ascend"));
  EXPECT_THAT(error_after([](Binding& b) { b.status[2] = PointStatus::Inside; }),
              HasSubstr("4 points are inside, but patches hold 3"));
  EXPECT_THAT(error_after([](Binding& b) { b.status[2] = static_cast<PointStatus>(200); }),
              HasSubstr("point 2 has an unknown status, 200"));
}

TEST(BindingFile, names_the_first_point_of_the_fringe_that_is_none) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = HasSubstr("fringe point 0 has a weight, parameters or slopes out of range");
  EXPECT_THAT(error_after([&](Binding& b) { b.fringe.weights[0] = nan; }), refuses);
  EXPECT_THAT(error_after([&](Binding& b) { b.fringe.weights[0] = 1.5; }), refuses);
  EXPECT_THAT(error_after([&](Binding& b) { b.fringe.uvw[0].x = nan; }), refuses);
  EXPECT_THAT(error_after([&](Binding& b) { b.fringe.weight_slopes[0].y = nan; }), refuses);
  EXPECT_THAT(error_after([&](Binding& b) { b.fringe.uvw_slopes[0][2].z = nan; }), refuses);
  EXPECT_THAT(error_after([](Binding& b) { b.fringe.points[0] = 1; }),
              HasSubstr("fringe point 0 has index 1, which is inside"));
}

TEST(BindingFile, with_a_patch_that_the_volume_has_not_is_refused) {
  Binding binding = saved_binding().binding;
  const Volume volume = volume_of_box();
  EXPECT_NO_THROW(require_patches("b", binding, volume));
  binding.patches.back() = static_cast<std::int32_t>(volume.n_patches());
  EXPECT_THROW(require_patches("b", binding, volume), FileError);
}

TEST(Fingerprint, differs_after_any_change_of_a_value_and_is_the_same_everywhere) {
  Fingerprint one;
  one.add_bytes("espalier");
  EXPECT_EQ(one.value(), 0x199630116A463244u);
  Fingerprint zero;
  zero.add(0.0);
  Fingerprint minus_zero;
  minus_zero.add(-0.0);
  EXPECT_NE(zero.value(), minus_zero.value());
}

}  // namespace
}  // namespace espalier
