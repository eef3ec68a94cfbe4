// Runs that are interrupted and go on from their files: whatever was kept, whoever goes on, the
// result is that of a run that never stopped and kept nothing.

#include "tests/support/kept_runs.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hemicube::test {
namespace {

using radiosity::Options;
using radiosity::Rung;

constexpr std::uint64_t kBlock = radiosity::FormFactorMatrix::kBlockRows;

struct Case {
  const char* name;
  Scene (*scene)();
  void (*choose)(Options*);
};
void PrintTo(const Case& made, std::ostream* out) {
  *out << made.name;
}

Scene room() {
  return kept_room();
}
void hemicube_rung(Options* options) {
  options->rung = Rung::kHemicube;
  options->hash_items = true;
}
void analytic_rung(Options* options) {
  options->rung = Rung::kAnalytic;
}
void area_rung(Options* options) {
  options->rung = Rung::kArea;
}
void adaptive_rung(Options* options) {
  options->rung = Rung::kAdaptive;
  options->error = 0.1;
}
void dial(Options* options) {
  options->choose_rung = options->choose_resolution = options->estimate_error = true;
  options->error = 0.03;
}
void balanced(Options* options) {
  options->balance = options->estimate_error = true;
}
void balanced_adaptive(Options* options) {
  adaptive_rung(options);
  options->balance = true;
}
void without_black(Options* options) {
  options->black_irradiance = false;
}
void adaptive_without_black(Options* options) {
  adaptive_rung(options);
  options->black_irradiance = false;
}

const Case kCases[] = {
    {"room_hemicube", room, hemicube_rung},
    {"room_analytic", room, analytic_rung},
    {"room_area", room, area_rung},
    {"room_adaptive", room, adaptive_rung},
    {"room_dial", room, dial},
    {"room_balanced", room, balanced},
    {"room_balanced_adaptive", room, balanced_adaptive},
    {"room_without_black", room, without_black},
    {"room_adaptive_without_black", room, adaptive_without_black},
    {"open_hemicube", kept_open_scene, hemicube_rung},
    {"open_area", kept_open_scene, area_rung},
    {"open_adaptive", kept_open_scene, adaptive_rung},
    {"open_dial", kept_open_scene, dial},
};

class KeptRows : public testing::TestWithParam<Case> {
protected:
  KeptRows() : scene_(GetParam().scene()) {
    options_.resolution = 32;
    GetParam().choose(&options_);
    const PatchSet patches = patches_of(scene_);
    for (std::uint32_t i = 0; i < patches.patch_count(); ++i) {
      const std::uint32_t material = patches.material[i];
      bool is_black = true;
      for (std::size_t b = 0; b < scene_.band_count(); ++b)
        is_black = is_black && scene_.reflectance[material * scene_.band_count() + b] == 0;
      black_.push_back(is_black);
    }
  }

  /// How many patches have a row in the first loop of a solve.
  std::uint64_t first_loop_rows() const {
    return options_.balance
               ? black_.size()
               : static_cast<std::uint64_t>(std::count(black_.begin(), black_.end(), false));
  }

  /// Rows that a serial run leaves which is stopped when `done` of its first loop are done.
  std::uint64_t rows_left(std::uint64_t done, bool shares_pairs) const {
    std::uint64_t patch = 0;
    for (std::uint64_t k = 0; patch < black_.size() && k < done; ++patch)
      k += shares_pairs || options_.balance || !black_[patch] ? 1 : 0;
    return patch == black_.size() ? patch : patch / kBlock * kBlock;
  }

  static void expect_sound(const Watch& watch) {
    EXPECT_FALSE(watch.has_overshot);
    ASSERT_FALSE(watch.loops.empty());
    EXPECT_EQ(watch.loops.back().last, watch.loops.back().total);
  }

  const Scene scene_;
  Options options_;
  std::vector<bool> black_; ///< [patch]
};

// Catches: rows kept in part or twice, facts of rows that are lost with them, counts that start
// anew.
TEST_P(KeptRows, AnInterruptedSolveGoesOn) {
  const Outcome expected = solve_kept(scene_, options_);
  ASSERT_TRUE(expected.status.ok()) << expected.status.message();
  const bool shares_pairs = expected.setting.rung >= Rung::kArea;
  const std::uint64_t rows = shares_pairs ? black_.size() : first_loop_rows();
  for (const std::uint64_t stop : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{7},
                                   std::uint64_t{8}, std::uint64_t{13}, rows - 1, rows}) {
    SCOPED_TRACE(stop);
    KeptRun kept;
    Watch first(stop), second;
    ASSERT_EQ(solve_kept(scene_, options_, &kept, 1, &first).status.code(), StatusCode::kCancelled);
    EXPECT_EQ(solve_kept(scene_, options_, &kept, 1, &second), expected);
    EXPECT_EQ(kept.files.rows_resumed, rows_left(stop, shares_pairs));
    expect_sound(second);
  }
}

TEST_P(KeptRows, InterruptedFormFactorsGoOn) {
  const Outcome expected = form_factors_kept(scene_, options_);
  ASSERT_TRUE(expected.status.ok()) << expected.status.message();
  const std::uint64_t rows = black_.size();
  for (const bool is_hcf : {false, true})
    for (const std::uint64_t stop : {std::uint64_t{1}, std::uint64_t{8}, std::uint64_t{23}, rows}) {
      SCOPED_TRACE(stop);
      KeptRun kept;
      kept.files.keeps_black_rows = is_hcf;
      Watch first(stop), second;
      ASSERT_EQ(form_factors_kept(scene_, options_, &kept, 1, &first).status.code(),
                StatusCode::kCancelled);
      EXPECT_EQ(form_factors_kept(scene_, options_, &kept, 1, &second), expected);
      EXPECT_EQ(kept.files.rows_resumed, stop == rows ? rows : stop / kBlock * kBlock);
      EXPECT_EQ(kept.files.rows_are_finished, is_hcf);
      expect_sound(second);
    }
}

// Catches: workers that leave gaps, rows that depend on who goes on.
TEST_P(KeptRows, AnyNumberOfThreadsGoesOn) {
  const Outcome expected = solve_kept(scene_, options_, nullptr, 2);
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    SCOPED_TRACE(threads);
    KeptRun kept;
    Watch first(20), second;
    ASSERT_EQ(solve_kept(scene_, options_, &kept, threads, &first).status.code(),
              StatusCode::kCancelled);
    EXPECT_EQ(solve_kept(scene_, options_, &kept, threads % 3 + 1, &second), expected);
    if (threads == 1) {
      EXPECT_GE(kept.files.rows_resumed, kBlock);
    }
    expect_sound(second);
  }
}

// Catches: a run that gets no farther than the one before it.
TEST_P(KeptRows, ManyInterruptionsEndInTheSameResult) {
  const Outcome expected = solve_kept(scene_, options_);
  KeptRun kept;
  Outcome last;
  std::uint64_t runs = 0, resumed = 0;
  do {
    Watch watch(kBlock * (runs + 1) + 1);
    last = solve_kept(scene_, options_, &kept, 1, &watch);
    EXPECT_GE(kept.files.rows_resumed, resumed);
    EXPECT_TRUE(runs == 0 || kept.files.rows_resumed > 0);
    resumed = kept.files.rows_resumed;
    ASSERT_LT(++runs, 20u);
  } while (last.status.code() == StatusCode::kCancelled);
  EXPECT_EQ(last, expected);
  EXPECT_GE(runs, 3u);
}

// What a kill leaves: any beginning of each file. Catches: files that rely on one another.
TEST_P(KeptRows, WhateverAKillLeavesIsGoneOnWith) {
  const Outcome expected = solve_kept(scene_, options_);
  KeptRun kept;
  ASSERT_EQ(solve_kept(scene_, options_, &kept), expected);
  const std::vector<std::byte> rows = kept.rows.bytes, pairs = kept.pairs.bytes,
                               black = kept.black_rows.bytes;
  Random random(3);
  for (int round = 0; round < 8; ++round) {
    const auto some_of = [&](std::vector<std::byte> bytes) {
      const std::uint32_t kind = random.index(4);
      bytes.resize(kind == 0   ? bytes.size()
                   : kind == 1 ? 0
                               : random.index(static_cast<std::uint32_t>(bytes.size()) + 1));
      return bytes;
    };
    kept.rows.bytes = some_of(rows);
    kept.pairs.bytes = some_of(pairs);
    kept.black_rows.bytes = some_of(black);
    SCOPED_TRACE(std::to_string(kept.rows.size()) + " of " + std::to_string(rows.size()) + ", " +
                 std::to_string(kept.pairs.size()) + " of " + std::to_string(pairs.size()) + ", " +
                 std::to_string(kept.black_rows.size()) + " of " + std::to_string(black.size()));
    Watch watch;
    EXPECT_EQ(solve_kept(scene_, options_, &kept, 1, &watch), expected);
    expect_sound(watch);
    EXPECT_EQ(solve_kept(scene_, options_, &kept), expected);
    EXPECT_EQ(kept.files.rows_resumed, black_.size()) << "what was added is found again";
  }
}

// Catches: files that change what is computed, or are not written at all.
TEST_P(KeptRows, AnUndisturbedRunKeepsEverything) {
  const Outcome expected = solve_kept(scene_, options_);
  KeptRun kept;
  EXPECT_EQ(solve_kept(scene_, options_, &kept, 2), expected);
  EXPECT_EQ(kept.files.rows_resumed, 0u);
  EXPECT_EQ(solve_kept(scene_, options_, &kept, 2), expected);
  EXPECT_EQ(kept.files.rows_resumed, black_.size());
}

// Rows of black patches come after the sweeps, in a file of their own.
TEST_P(KeptRows, BlackRowsGoOnToo) {
  if (options_.balance || !options_.black_irradiance)
    return; // there are none
  const Outcome expected = solve_kept(scene_, options_);
  const std::uint64_t first_loop = first_loop_rows();
  Watch whole;
  ASSERT_EQ(solve_kept(scene_, options_, nullptr, 1, &whole), expected);
  const std::size_t last_loop = whole.loops.size() - 1;
  for (const std::uint64_t stop :
       {first_loop, first_loop + 1, first_loop + 2, static_cast<std::uint64_t>(black_.size())}) {
    SCOPED_TRACE(stop);
    KeptRun kept;
    Watch first(stop, last_loop), second;
    ASSERT_EQ(solve_kept(scene_, options_, &kept, 1, &first).status.code(), StatusCode::kCancelled);
    EXPECT_EQ(solve_kept(scene_, options_, &kept, 1, &second), expected);
    EXPECT_EQ(kept.files.rows_resumed, black_.size());
    expect_sound(second);
    if (stop == black_.size() && expected.setting.rung < Rung::kArea) {
      EXPECT_EQ(second.loops.back().first, stop) << "no row is built again";
    }
  }
}

TEST_P(KeptRows, InterruptionsBetweenTheRowsLoseNone) {
  const Outcome expected = solve_kept(scene_, options_);
  for (const bool in_sweeps : {true, false}) {
    if (!in_sweeps && !options_.balance)
      continue;
    KeptRun kept;
    Watch first, second;
    first.stops_in_sweeps = in_sweeps;
    first.stops_in_balancing = !in_sweeps;
    ASSERT_EQ(solve_kept(scene_, options_, &kept, 1, &first).status.code(), StatusCode::kCancelled);
    EXPECT_EQ(solve_kept(scene_, options_, &kept, 1, &second), expected);
    EXPECT_EQ(kept.files.rows_resumed, black_.size());
    EXPECT_EQ(second.loops.front().first, second.loops.front().last);
  }
}

INSTANTIATE_TEST_SUITE_P(, KeptRows, testing::ValuesIn(kCases),
                         [](const auto& made) { return std::string(made.param.name); });

} // namespace
} // namespace hemicube::test
