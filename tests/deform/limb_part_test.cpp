/// limb_part() finds what one cut parts from a lattice.

#include "deform/animate/limb_part.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace espalier {
namespace {

using Net = std::vector<std::array<std::int32_t, 2>>;

/// Two legs of section 1 × 1, from y = 0 to 3, joined at the top by a bar: the edges of unit cells.
struct Staple {
  std::vector<glm::dvec3> points;
  Net net;

  Staple() {
    for (int z = 0; z < 2; ++z) {
      for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 6; ++x) {
          points.emplace_back(x, y, z);
        }
      }
    }
    std::set<std::array<std::int32_t, 2>> edges;
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 5; ++x) {
        if (y == 3 || x == 0 || x == 4) {
          add_cell(x, y, edges);
        }
      }
    }
    net.assign(edges.begin(), edges.end());
  }

 private:
  static void add_cell(int x, int y, std::set<std::array<std::int32_t, 2>>& edges) {
    const auto point = [&](int corner) {
      return x + (corner & 1) + 6 * (y + (corner >> 1 & 1) + 5 * (corner >> 2));
    };
    for (int corner = 0; corner < 8; ++corner) {
      for (const int bit : {1, 2, 4}) {
        if ((corner & bit) == 0) {
          edges.insert({point(corner), point(corner | bit)});
        }
      }
    }
  }
};

TEST(LimbPart, is_one_of_two_legs_that_the_plane_cuts) {
  const Staple staple;
  const LimbPart limb = limb_part(staple.points, staple.net, {0.5, 1.5, 0.5}, {0, -2, 0});
  EXPECT_NEAR(limb.radius, std::sqrt(0.5), 1e-15);
  for (std::size_t i = 0; i < staple.points.size(); ++i) {
    const glm::dvec3& p = staple.points[i];
    const double across = std::hypot(p.x - 0.5, p.z - 0.5);
    if (p.y < 1.5) {
      EXPECT_EQ(limb.shares[i], p.x <= 1 ? 1 : 0) << p.x << " " << p.y;
    } else if (p.x <= 1) {
      EXPECT_NEAR(limb.shares[i], 1, 1e-15) << "before the joint, in the leg";
    } else if (across >= 2 * limb.radius) {
      EXPECT_EQ(limb.shares[i], 0) << p.x << " " << p.y;
    }
  }
}

TEST(LimbPart, is_the_same_wherever_the_lattice_is_and_however_it_is_turned) {
  const Staple staple;
  std::vector<glm::dvec3> turned;
  for (const glm::dvec3& p : staple.points) {
    turned.emplace_back(8 + 4 * p.y, 16 + 4 * p.z, -4 * p.x);
  }
  const LimbPart limb = limb_part(staple.points, staple.net, {4.5, 1.5, 0.5}, {0, -1, 0});
  const LimbPart there = limb_part(turned, staple.net, {14, 18, -18}, {-1, 0, 0});
  EXPECT_EQ(limb.shares, there.shares);
  EXPECT_EQ(4 * limb.radius, there.radius);
}

TEST(LimbPart, holds_all_beyond_a_plane_where_no_smaller_cut_parts_it) {
  const Staple staple;
  // Across the bar: both ends of the staple hang together with it elsewhere nowhere.
  const LimbPart limb = limb_part(staple.points, staple.net, {2.5, 3.5, 0.5}, {1, 0, 0});
  for (std::size_t i = 0; i < staple.points.size(); ++i) {
    const glm::dvec3& p = staple.points[i];
    const bool is_used = p.y >= 3 || p.x <= 1 || p.x >= 4;
    if (p.x > 2.5 && is_used) {
      EXPECT_EQ(limb.shares[i], 1);
    }
  }
}

TEST(LimbPart, is_everything_where_nothing_lies_on_one_side) {
  const Staple staple;
  for (const double y : {-1.0, 9.0}) {
    const LimbPart limb = limb_part(staple.points, staple.net, {0, y, 0}, {0, 1, 0});
    EXPECT_EQ(limb.shares, std::vector<double>(staple.points.size(), 1.0));
  }
}

}  // namespace
}  // namespace espalier
