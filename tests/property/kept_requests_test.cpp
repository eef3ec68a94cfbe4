// What files of rows are good for: the same request on the same mesh and nothing else; finished
// ones for any light; rows beyond memory.

#include "radiosity/form_factor/matrix_file.h"
#include "tests/support/kept_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hemicube::test {
namespace {

using radiosity::MatrixFileHead;
using radiosity::Options;
using radiosity::RowStorage;
using radiosity::Rung;

Options at(Rung rung) {
  Options options;
  options.rung = rung;
  options.resolution = 32;
  options.error = 0.1;
  return options;
}

/// A room of 55 patches with a lamp just above the floor, which few rows can foretell.
Scene low_lamp_room() {
  SceneBuilder builder;
  const std::uint32_t wall = builder.material("wall", 0.5, 0),
                      lamp = builder.material("lamp", 0, 100);
  builder.box({wall, wall, wall, wall, wall, wall}, {0, 0, 0}, {4, 4, 4}, {3, 3, 3}, true);
  builder.face(lamp, {{1.3, 1.9, 0.05}, {1.3, 2.4, 0.05}, {1.8, 2.4, 0.05}, {1.8, 1.9, 0.05}});
  return builder.finish();
}

MatrixFileHead head_of(const MemoryFile& file) {
  MatrixFileHead head;
  std::memcpy(&head, file.bytes.data(), sizeof head);
  return head;
}

// Catches: rounds of the dial that are forgotten, and rows of one round in another.
TEST(KeptRounds, SettingsChosenBecauseOfErrorsAreRemembered) {
  const Scene scene = low_lamp_room();
  Options options = at(Rung::kHemicube);
  options.choose_rung = options.choose_resolution = options.estimate_error = true;
  KeptRun whole_files;
  Watch whole;
  const Outcome expected = solve_kept(scene, options, &whole_files, 1, &whole);
  ASSERT_TRUE(expected.status.ok()) << expected.status.message();
  ASSERT_EQ(head_of(whole_files.rows).rounds, 1u) << "the scene is of no use for this test";
  ASSERT_EQ(whole.loops.size(), 3u); // two rounds, and the lamp's row
  EXPECT_EQ(solve_kept(scene, options), expected);
  for (std::size_t loop = 0; loop < 3; ++loop)
    for (const std::uint64_t stop : {0, 9, 30, 54, 55}) {
      SCOPED_TRACE(std::to_string(stop) + " of loop " + std::to_string(loop));
      KeptRun kept;
      Watch first(stop, loop), second;
      const Status status = solve_kept(scene, options, &kept, 1, &first).status;
      EXPECT_EQ(status.code(), loop == 0 && stop == 55 ? StatusCode::kOk : StatusCode::kCancelled);
      EXPECT_EQ(solve_kept(scene, options, &kept, 2, &second), expected);
      EXPECT_FALSE(second.has_overshot);
      if (loop == 1) {
        EXPECT_EQ(second.loops.size(), 2u) << "the first round is not to be made again";
      }
      if (loop == 2 || stop >= 9) {
        EXPECT_GT(kept.files.rows_resumed, 0u);
      }
    }
}

struct Change {
  const char* name;
  void (*change)(Scene*, Options*, KeptRun*);
};

// Catches: options that change rows and are not looked at. All runs here keep rows of all patches.
TEST(KeptRequests, OtherRequestsBeginAnew) {
  const Change changes[] = {
      {"resolution", [](Scene*, Options* options, KeptRun*) { options->resolution = 34; }},
      {"rung", [](Scene*, Options* options, KeptRun*) { options->rung = Rung::kAnalytic; }},
      {"adaptive", [](Scene*, Options* options, KeptRun*) { options->rung = Rung::kAdaptive; }},
      {"target", [](Scene*, Options* options, KeptRun*) { options->error = 0.2; }},
      {"balance", [](Scene*, Options* options, KeptRun*) { options->balance = true; }},
      {"estimate", [](Scene*, Options* options, KeptRun*) { options->estimate_error = true; }},
      {"items", [](Scene*, Options* options, KeptRun*) { options->hash_items = true; }},
      {"no black irradiance",
       [](Scene*, Options* options, KeptRun*) { options->black_irradiance = false; }},
      {"black rows too",
       [](Scene*, Options*, KeptRun* kept) { kept->files.keeps_black_rows = true; }},
      {"reflectance", [](Scene* scene, Options*, KeptRun*) { *scene = kept_room(0.61); }},
      {"exitance", [](Scene* scene, Options*, KeptRun*) { *scene = kept_room(0.6, 5.01); }},
      {"vertex",
       [](Scene* scene, Options*, KeptRun*) {
         Vec3& vertex = scene->vertices[0];
         vertex.x = std::nextafter(vertex.x, 1.0);
       }},
      {"results", [](Scene*, Options*, KeptRun* kept) {
         for (MemoryFile* file : {&kept->rows, &kept->pairs, &kept->black_rows}) {
           MatrixFileHead head = head_of(*file);
           ++head.results;
           head.seal();
           std::memcpy(file->bytes.data(), &head, sizeof head);
         }
       }}};
  for (const Rung rung : {Rung::kHemicube, Rung::kAdaptive})
    for (const Change& change : changes) {
      SCOPED_TRACE(change.name);
      Scene scene = kept_room();
      Options options = at(rung);
      if (rung == Rung::kAdaptive && std::string_view(change.name) == "adaptive")
        continue;
      // A run that goes on with what a whole run of the other request left.
      KeptRun kept;
      ASSERT_TRUE(solve_kept(scene, options, &kept).status.ok());
      change.change(&scene, &options, &kept);
      const Outcome expected = solve_kept(scene, options);
      EXPECT_EQ(solve_kept(scene, options, &kept), expected);
      EXPECT_EQ(kept.files.rows_resumed, 0u);
      EXPECT_EQ(solve_kept(scene, options, &kept), expected);
      EXPECT_EQ(kept.files.rows_resumed, expected.patches);
    }
}

TEST(KeptRequests, SolvesAndFormFactorsDoNotMix) {
  const Options options = at(Rung::kHemicube);
  const Scene scene = kept_room();
  KeptRun kept;
  ASSERT_TRUE(solve_kept(scene, options, &kept).status.ok());
  EXPECT_EQ(form_factors_kept(scene, options, &kept), form_factors_kept(scene, options));
  EXPECT_EQ(kept.files.rows_resumed, 0u);
  EXPECT_EQ(solve_kept(scene, options, &kept), solve_kept(scene, options));
  EXPECT_EQ(kept.files.rows_resumed, 0u);
}

// What does not change a bit of a row is no reason to begin anew.
TEST(KeptRequests, ToleranceKernelsAndMemoryGoOn) {
  const Scene scene = kept_room();
  Options options = at(Rung::kAdaptive);
  KeptRun kept;
  ASSERT_TRUE(solve_kept(scene, options, &kept).status.ok());
  options.tolerance = 1e-9;
  options.kernels = raster::kernels_by_name("scalar");
  kept.files.most_bytes = 1 << 20;
  kept.files.range_bytes = 1 << 10;
  EXPECT_EQ(solve_kept(scene, options, &kept), solve_kept(scene, options));
  EXPECT_EQ(kept.files.rows_resumed, 37u);
}

// Catches: rows that were finished since the file was last due, and are dropped when a run ends
// early.
TEST(KeptRequests, WhatAnInterruptedRunFinishedIsKept) {
  const Scene scene = kept_room();
  for (const Rung rung : {Rung::kHemicube, Rung::kAdaptive}) {
    KeptRun kept;
    Watch first(20), second;
    // Two blocks are finished; then the run ends, and asks a third time.
    kept.rows.due_every = kept.pairs.due_every = 3;
    ASSERT_EQ(form_factors_kept(scene, at(rung), &kept, 1, &first).status.code(),
              StatusCode::kCancelled);
    EXPECT_EQ(form_factors_kept(scene, at(rung), &kept), form_factors_kept(scene, at(rung)));
    EXPECT_EQ(kept.files.rows_resumed, 16u);
  }
  KeptRun kept;
  Watch first(27 + 3, 1),
      second; // of 10 black patches the first 3; 2 of them are in the first block
  kept.black_rows.due_every = 2;
  ASSERT_EQ(solve_kept(scene, at(Rung::kHemicube), &kept, 1, &first).status.code(),
            StatusCode::kCancelled);
  EXPECT_EQ(solve_kept(scene, at(Rung::kHemicube), &kept, 1, &second),
            solve_kept(scene, at(Rung::kHemicube)));
  EXPECT_EQ(second.loops.back().first, 27u + 2);
}

// Catches: a failure of the disk that is not told, or costs what was there before it.
TEST(KeptRequests, AFullDiskEndsTheRunAndTheNextOneGoesOn) {
  const Scene scene = kept_room();
  for (const Rung rung : {Rung::kHemicube, Rung::kAdaptive}) {
    const Outcome expected = solve_kept(scene, at(rung));
    for (const std::uint64_t failing : {0, 1, 2, 4}) {
      SCOPED_TRACE(failing);
      KeptRun kept;
      MemoryFile& file = rung == Rung::kAdaptive ? kept.pairs : kept.rows;
      file.failing_append = failing;
      const Status status = solve_kept(scene, at(rung), &kept).status;
      EXPECT_EQ(status.code(), StatusCode::kIo);
      EXPECT_NE(status.message().find("is full"), std::string_view::npos) << status.message();
      EXPECT_EQ(solve_kept(scene, at(rung), &kept), expected);
      // What could not be appended is appended once more when the run ends.
      EXPECT_EQ(kept.files.rows_resumed > 0, failing > 0);
    }
  }
}

/// Computes the finished rows of a scene; the next run is given them.
void make_given(const Scene& scene, const Options& options, KeptRun* kept) {
  kept->files.keeps_black_rows = true;
  kept->files.black_rows = nullptr;
  require(form_factors_kept(scene, options, kept).status);
  ASSERT_TRUE(kept->files.rows_are_finished);
  kept->files.rows_are_given = true;
  kept->files.pairs = nullptr;
}

// Catches: light that is solved with the rows of other materials.
TEST(GivenRows, AnyLightIsSolvedAsIfTheyWereComputed) {
  for (const Rung rung : {Rung::kHemicube, Rung::kArea, Rung::kAdaptive})
    for (const bool balance : {false, true}) {
      SCOPED_TRACE(balance);
      Options options = at(rung);
      options.balance = balance;
      KeptRun kept;
      Options unbalanced = options;
      unbalanced.balance = false;
      make_given(kept_room(), unbalanced, &kept);
      const std::vector<std::byte> file = kept.rows.bytes;
      for (const auto& [reflectance, exitance] :
           {std::pair{0.6, 5.0}, {0.2, 5.0}, {0.6, 7.5}, {0.0, 1.0}, {0.99, 1.0}}) {
        const Scene scene = kept_room(reflectance, exitance);
        const Outcome given = solve_kept(scene, options, &kept),
                      computed = solve_kept(scene, options);
        ASSERT_TRUE(given.status.ok()) << given.status.message();
        EXPECT_EQ(given.values, computed.values) << reflectance;
        EXPECT_EQ(given.sweeps, computed.sweeps);
        EXPECT_EQ(kept.files.rows_resumed, 37u);
      }
      EXPECT_EQ(kept.rows.bytes, file) << "what is given is only read";
      EXPECT_EQ(form_factors_kept(kept_room(), options, &kept),
                form_factors_kept(kept_room(), options));
    }
}

TEST(GivenRows, WhatAsksForOthersIsRefused) {
  KeptRun kept;
  make_given(kept_room(), at(Rung::kArea), &kept);
  const auto code = [&](Options options) {
    return solve_kept(kept_room(), options, &kept).status.code();
  };
  Options options = at(Rung::kArea);
  EXPECT_EQ(code(options), StatusCode::kOk);
  options.rung = Rung::kAdaptive;
  EXPECT_EQ(code(options), StatusCode::kInvalidArgument);
  options.choose_rung = true;
  EXPECT_EQ(code(options), StatusCode::kOk);
  options.resolution = 64;
  EXPECT_EQ(code(options), StatusCode::kInvalidArgument);
  options.choose_resolution = true;
  EXPECT_EQ(code(options), StatusCode::kOk);
  kept.rows.bytes.pop_back();
  EXPECT_EQ(code(options), StatusCode::kBadScene);
}

// Catches: pairs that take more than they may, and other bits where they would.
TEST(PairsBeyondMemory, SayWhatToDoAndGoOnWithMore) {
  for (const Rung rung : {Rung::kArea, Rung::kAdaptive})
    for (const std::uint32_t threads : {1u, 3u}) {
      const Scene scene = kept_room();
      const Options options = at(rung);
      KeptRun whole;
      const Outcome expected = solve_kept(scene, options, &whole);
      ASSERT_TRUE(expected.status.ok());
      ASSERT_GT(whole.pairs.size(), sizeof(MatrixFileHead));
      KeptRun kept;
      // A third of it is for rows, which fit, and the rest for pairs, which do not.
      kept.files.most_bytes = 3 * std::max(whole.rows.size(), whole.black_rows.size());
      const Status status = solve_kept(scene, options, &kept, threads).status;
      EXPECT_EQ(status.code(), StatusCode::kOutOfMemory);
      EXPECT_NE(status.message().find("--memory"), std::string_view::npos) << status.message();
      kept.files.most_bytes = RowStorage::kUnlimited;
      EXPECT_EQ(solve_kept(scene, options, &kept, threads), expected);
      // Of several workers, the one with the first rows may not have finished them.
      if (threads == 1) {
        EXPECT_GT(kept.files.rows_resumed, 0u);
      }
    }
}

class FormFactorsBeyondMemory : public testing::TestWithParam<Rung> {};

// Catches: whatever reads a row that is not there.
TEST_P(FormFactorsBeyondMemory, AreTheSame) {
  for (const Scene& scene :
       {kept_room(), kept_open_scene(), box_enclosure({1, 2, 3}, 5, 7, 9, 0, 1)})
    for (const bool estimate : {false, true}) {
      Options options = at(GetParam());
      options.estimate_error = estimate && scene.face_count() < 50;
      const Outcome expected = form_factors_kept(scene, options);
      ASSERT_TRUE(expected.status.ok()) << expected.status.message();
      for (const std::uint64_t most : {0, 3000, 100000}) {
        KeptRun kept;
        kept.rows.due_every = MemoryFile::kNever;
        kept.files.most_bytes = most;
        kept.files.range_bytes = most / 2;
        EXPECT_EQ(form_factors_kept(scene, options, &kept, 2), expected) << most;
        EXPECT_GE(kept.rows.size(), sizeof(MatrixFileHead));
      }
    }
}

TEST_P(FormFactorsBeyondMemory, GoOn) {
  const Scene scene = kept_room();
  const Options options = at(GetParam());
  KeptRun kept;
  kept.files.most_bytes = 2000;
  kept.files.range_bytes = 1000;
  Watch first(20);
  ASSERT_EQ(form_factors_kept(scene, options, &kept, 1, &first).status.code(),
            StatusCode::kCancelled);
  EXPECT_EQ(form_factors_kept(scene, options, &kept), form_factors_kept(scene, options));
}

TEST_P(FormFactorsBeyondMemory, CannotBeBalanced) {
  Options options = at(GetParam());
  options.balance = true;
  KeptRun kept;
  kept.files.most_bytes = 2000;
  const Status status = form_factors_kept(kept_room(), options, &kept).status;
  EXPECT_EQ(status.code(), StatusCode::kOutOfMemory);
  EXPECT_NE(status.message().find("--memory"), std::string_view::npos) << status.message();
}

// Catches: solvers, black patches and estimates that read a row that is not there.
TEST_P(FormFactorsBeyondMemory, LightIsTheSame) {
  for (const Scene& scene : {kept_room(), kept_open_scene()})
    for (const bool estimate : {false, true}) {
      Options options = at(GetParam());
      options.estimate_error = estimate;
      const Outcome expected = solve_kept(scene, options);
      KeptRun kept;
      kept.files.most_bytes = 2000;
      kept.files.range_bytes = 1000;
      EXPECT_EQ(solve_kept(scene, options, &kept, 2), expected);
      EXPECT_EQ(solve_kept(scene, options, &kept, 1), expected);
      EXPECT_EQ(kept.files.rows_resumed, expected.patches);
    }
}

// The same with rows that were given.
TEST_P(FormFactorsBeyondMemory, LightOfGivenRowsIsTheSame) {
  const Options options = at(GetParam());
  KeptRun kept;
  make_given(kept_room(), options, &kept);
  kept.files.most_bytes = 2000;
  kept.files.range_bytes = 1000;
  for (const double reflectance : {0.6, 0.3})
    EXPECT_EQ(solve_kept(kept_room(reflectance), options, &kept).values,
              solve_kept(kept_room(reflectance), options).values);
}

INSTANTIATE_TEST_SUITE_P(, FormFactorsBeyondMemory,
                         testing::Values(Rung::kHemicube, Rung::kAnalytic), [](const auto& made) {
                           return std::string(radiosity::rung_name(made.param));
                         });

} // namespace
} // namespace hemicube::test
