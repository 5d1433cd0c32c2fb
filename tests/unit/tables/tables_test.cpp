// The tables agree with themselves, and the generated files are those of the data.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/tables/generate/render.h"
#include "core/tables/generated/mpeg4_tables.h"
#include "core/tables/mpeg4.h"
#include "core/types/fapu.h"
#include "core/types/feature_point_id.h"

namespace {

namespace mpeg4 = semblante::mpeg4;

TEST(Tables_Generated, AreWhatTheDataGive) {
  EXPECT_THAT(semblante::codegen::out_of_date(SEMBLANTE_SOURCE_DIR, semblante::tables::generated_files),
              ::testing::IsEmpty())
      << "run: ninja -C build semblante-generate-tables";
}

TEST(Tables_Generator, NamesTheFile_WhenItIsNotThere) {
  try {
    semblante::tables::read_table_data("/nowhere");
    FAIL();
  } catch (const std::exception& fault) {
    EXPECT_NE(std::string(fault.what()).find("/nowhere/faps.json"), std::string::npos);
  }
}

TEST(Tables_Faps, AreNumberedNamedAndGrouped) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < mpeg4::faps.size(); ++i) {
    EXPECT_EQ(mpeg4::faps[i].number, i + 1);
    names.insert(mpeg4::faps[i].name);
    const auto& group = mpeg4::fap_groups[mpeg4::faps[i].group - 1U];
    EXPECT_TRUE(group.first_fap <= i + 1 && i + 1 <= group.last_fap) << i + 1;
  }
  EXPECT_EQ(names.size(), 68U);
  const std::array<int, 10> sizes = {2, 16, 12, 8, 4, 5, 3, 10, 4, 4};
  for (std::size_t g = 0; g < 10; ++g) {
    EXPECT_EQ(mpeg4::fap_groups[g].last_fap - mpeg4::fap_groups[g].first_fap + 1, sizes[g]);
  }
}

TEST(Tables_Faps, MoveAPointOfTheirOwnGroupAlongAnAxisInAUnit) {
  for (std::size_t n = 3; n <= 68; ++n) {
    const mpeg4::Fap& f = mpeg4::fap(n);
    ASSERT_GE(f.feature_point_count, 1) << n;
    EXPECT_EQ(semblante::group_of(semblante::FeaturePointId(f.feature_points[0])), f.group) << n;
    EXPECT_NE(f.unit, mpeg4::Unit::none) << n;
    if (f.kind == mpeg4::FapKind::translation) {
      EXPECT_NE(f.axis, mpeg4::no_axis) << n;
      EXPECT_NE(f.unit, mpeg4::Unit::au) << n;
    }
    EXPECT_EQ(f.axis == mpeg4::no_axis, f.sign == 0) << n;
    EXPECT_LT(f.min(), f.max()) << n;
    EXPECT_LT(f.usual_min, f.usual_max) << n;
    EXPECT_TRUE(f.min() <= 0 && (f.bidirectional || f.usual_min == 0)) << n;
    EXPECT_LE(f.usual_max, f.max()) << n;
    EXPECT_GE(f.usual_min, f.min()) << n;
  }
}

TEST(Tables_Faps, NoTwoMoveOnePointAlongOneAxis) {
  std::set<std::tuple<int, int, int>> seen;
  for (const mpeg4::Fap& f : mpeg4::faps) {
    if (f.sign == 0) continue;
    EXPECT_TRUE(seen.insert({static_cast<int>(f.kind), f.feature_points[0], f.axis}).second) << f.name;
  }
}

TEST(Tables_Mirror, IsSymmetricInFapsAndPoints) {
  for (std::size_t i = 0; i < mpeg4::feature_points.size(); ++i) {
    const mpeg4::FeaturePointInfo& p = mpeg4::feature_points[i];
    const mpeg4::FeaturePointInfo& q = mpeg4::feature_points[p.mirror];
    EXPECT_EQ(q.mirror, i) << p.id;
    EXPECT_EQ(p.side == mpeg4::Side::center, p.mirror == i) << p.id;
    if (p.side != mpeg4::Side::center) {
      EXPECT_NE(p.side, q.side) << p.id;
    }
  }
  for (std::size_t n = 3; n <= 68; ++n) {
    const mpeg4::Fap& f = mpeg4::fap(n);
    const mpeg4::Fap& m = mpeg4::fap(f.mirror);
    EXPECT_EQ(m.mirror, n);
    EXPECT_EQ(m.mirror_sign, f.mirror_sign);
    EXPECT_TRUE(m.unit == f.unit && m.quantizer_step == f.quantizer_step && m.min_level == f.min_level &&
                m.max_level == f.max_level && m.usual_min == f.usual_min && m.usual_max == f.usual_max)
        << n;
    EXPECT_TRUE(n == 47 || mpeg4::feature_points[f.feature_points[0]].mirror == m.feature_points[0]) << n;
    if (f.sign != 0) {
      // A mirror in x flips displacements along x, and rotations about y and z.
      const bool flips = f.kind == mpeg4::FapKind::translation ? f.axis == 0 : f.axis != 0;
      EXPECT_EQ(flips ? -f.sign : f.sign, f.mirror_sign * m.sign) << n;
    }
  }
}

TEST(Tables_FeaturePoints, AreInTheOrderOfTheDenseIndex) {
  ASSERT_EQ(mpeg4::feature_points.size(), semblante::feature_point_count);
  for (std::size_t i = 0; i < mpeg4::feature_points.size(); ++i) {
    EXPECT_EQ(mpeg4::feature_points[i].id,
              semblante::to_string(semblante::FeaturePointId(static_cast<std::uint8_t>(i))));
  }
  std::set<int> moved;
  for (const mpeg4::Fap& f : mpeg4::faps) {
    for (int i = 0; i < f.feature_point_count; ++i) moved.insert(f.feature_points[static_cast<std::size_t>(i)]);
  }
  EXPECT_EQ(moved.size(), 46U);
}

TEST(Tables_Fapus, AreTheSharedUnitsInTheirOrder) {
  for (std::size_t i = 0; i < semblante::fapu_unit_count; ++i) {
    EXPECT_EQ(mpeg4::fapus[i].name, semblante::fapu_unit_names[i]);
    EXPECT_EQ(mpeg4::unit_names[i], semblante::fapu_unit_names[i]);
    EXPECT_GE(mpeg4::fapus[i].measure_count, 1);
  }
  EXPECT_EQ(mpeg4::fapus[5].name, "AU");
  EXPECT_EQ(mpeg4::fapus[5].measure_count, 0);
}

TEST(Tables_CHeader, SaysTheSameAsTheCppTables) {
  for (std::size_t n = 1; n <= 68; ++n) {
    const semblante_fap_entry& c = semblante_fap_table[n];
    const mpeg4::Fap& f = mpeg4::fap(n);
    if (f.kind == mpeg4::FapKind::high_level) {
      EXPECT_EQ(c.kind, SEMBLANTE_FAP_HIGH_LEVEL) << n;
      continue;
    }
    const bool no_axis = f.axis == mpeg4::no_axis;
    EXPECT_EQ(c.kind, f.kind == mpeg4::FapKind::scale         ? SEMBLANTE_FAP_PUPIL
                      : f.kind == mpeg4::FapKind::translation ? SEMBLANTE_FAP_TRANSLATION
                      : no_axis                               ? SEMBLANTE_FAP_ROLL
                                                              : SEMBLANTE_FAP_ROTATION)
        << n;
    EXPECT_EQ(c.fp, f.feature_points[0]) << n;
    EXPECT_EQ(c.axis, no_axis ? 0 : f.axis) << n;
    EXPECT_EQ(c.sign, no_axis ? 1 : f.sign) << n;
    EXPECT_EQ(c.unit, static_cast<int>(f.unit)) << n;
  }
}

TEST(Tables_KnownFacts, AreThere) {
  // One fact a line, from the standard: an open jaw goes down in MNS/1024 at the chin's bottom, and so on.
  const mpeg4::Fap& jaw = mpeg4::fap(3);
  EXPECT_EQ(jaw.name, "open_jaw");
  EXPECT_TRUE(jaw.axis == 1 && jaw.sign == -1 && jaw.unit == mpeg4::Unit::mns && jaw.max() == 4320);
  const mpeg4::Fap& lower_lip = mpeg4::fap(5);
  EXPECT_TRUE(lower_lip.axis == 1 && lower_lip.sign == 1);  // positive closes
  const mpeg4::Fap& yaw = mpeg4::fap(49);
  EXPECT_TRUE(yaw.kind == mpeg4::FapKind::rotation && yaw.axis == 1 && yaw.sign == 1 && yaw.quantizer_step == 170);
  EXPECT_EQ(mpeg4::visemes.size(), 15U);
  EXPECT_EQ(mpeg4::expressions.size(), 7U);
  EXPECT_EQ(mpeg4::visemes[1].name, "p_b_m");
  EXPECT_EQ(mpeg4::expressions[6].name, "surprise");
  EXPECT_EQ(mpeg4::fap_that_moves(0, 1), &jaw);
  EXPECT_EQ(mpeg4::fap_that_moves(9, 0), nullptr);  // 2.10 has FAP 18 for y only
}

TEST(Tables_Companions, FollowLeadersOfAtMostOneLeader) {
  const auto follows = [](int point) {
    return std::any_of(mpeg4::companions.begin(), mpeg4::companions.end(),
                       [point](const mpeg4::Companion& c) { return !c.is_choice && c.point == point; });
  };
  for (const mpeg4::Companion& c : mpeg4::companions) {
    EXPECT_FALSE(c.is_choice && follows(c.leader));
    for (const mpeg4::Companion& of_leader : mpeg4::companions) {
      if (of_leader.is_choice || of_leader.point != c.leader) continue;
      EXPECT_FALSE(follows(of_leader.leader)) << "a leader leads with what it follows itself, but not two steps on";
    }
  }
}

}  // namespace
