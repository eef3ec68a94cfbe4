// What a caller of long runs is told, and when: whoever takes the time of rows relies on it.

#include "radiosity/parallel/thread_pool.h"
#include "radiosity/radiosity.h"
#include "tests/support/scenes_shared.h"

#include <gtest/gtest.h>

namespace hemicube::test {
namespace {

using radiosity::Certificate;
using radiosity::FormFactorMatrix;
using radiosity::Options;
using radiosity::Solution;
using radiosity::ThreadPool;

constexpr std::uint64_t kNever = ~std::uint64_t{0};

/// Keeps every call; stops the run at one of them.
class Recorder final : public radiosity::Progress {
public:
  struct Call {
    bool is_row;
    std::uint64_t done, total; ///< of sweeps: those done, 0
  };

  explicit Recorder(std::uint64_t stop_at = kNever) : stop_at_(stop_at) {}

  bool rows(std::uint64_t done, std::uint64_t total) noexcept override {
    calls.push_back({true, done, total});
    return calls.size() <= stop_at_;
  }
  bool sweeps(std::uint64_t sweeps, double) noexcept override {
    calls.push_back({false, sweeps, 0});
    return calls.size() <= stop_at_;
  }

  std::vector<Call> calls;

private:
  std::uint64_t stop_at_;
};

/// The longest pieces of `calls` that are of one kind.
std::vector<std::vector<Recorder::Call>> loops_of(const std::vector<Recorder::Call>& calls) {
  std::vector<std::vector<Recorder::Call>> loops;
  for (const Recorder::Call& call : calls) {
    if (loops.empty() || loops.back().back().is_row != call.is_row)
      loops.emplace_back();
    loops.back().push_back(call);
  }
  return loops;
}

/// Expects a loop over the rows begin .. end-1 of `total`.
void expect_rows(const std::vector<Recorder::Call>& loop, std::uint64_t begin, std::uint64_t end,
                 std::uint64_t total) {
  ASSERT_GE(loop.size(), 2u);
  EXPECT_EQ(loop.front().done, begin);
  EXPECT_EQ(loop.back().done, end);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    EXPECT_TRUE(loop[k].is_row);
    EXPECT_EQ(loop[k].total, total);
    // Only the first call comes before the first row.
    EXPECT_GE(loop[k].done, k == 0 || begin == end ? begin : begin + 1);
    EXPECT_GE(loop[k].done, loop[k == 0 ? 0 : k - 1].done);
  }
}

class ProgressTest : public ::testing::Test {
protected:
  ProgressTest() { options_.resolution = 16; }

  /// A room of 6 x 16 patches: a black lamp for a ceiling, the walls of one reflectance.
  static Scene room(double reflectance) {
    SceneBuilder builder;
    const std::uint32_t wall = builder.material("wall", reflectance, 0);
    const std::uint32_t lamp = builder.material("lamp", 0, 1);
    builder.box({wall, wall, wall, wall, wall, lamp}, {0, 0, 0}, {1, 1, 1}, {4, 4, 4}, true);
    return builder.finish();
  }

  Status solve(double reflectance, Recorder* recorder, std::uint32_t threads = 1) {
    const Scene scene = room(reflectance);
    ThreadPool pool;
    require(pool.init(threads));
    Solution solution;
    return solve_scene(scene, patches_of(scene), options_, pool, recorder, &solution,
                       &certificate_);
  }

  Status form_factors(std::span<const std::uint32_t> rows, Recorder* recorder,
                      std::uint32_t threads = 1) {
    ThreadPool pool;
    require(pool.init(threads));
    FormFactorMatrix matrix;
    return compute_form_factors(patches_of(room(0.5)), rows, options_, pool, recorder, &matrix,
                                &certificate_);
  }

  Options options_;
  Certificate certificate_;
};

// Catches: no call before the first row or after the last one, so that a clock gets set-up or none.
TEST_F(ProgressTest, RowsBeginAndEndWithACall) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t k = 0; k < 80; ++k)
    rows.push_back(k);
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    Recorder all, some;
    require(form_factors({}, &all, threads));
    expect_rows(all.calls, 0, 96, 96);
    require(form_factors(rows, &some, threads));
    expect_rows(some.calls, 0, 80, 80);
    EXPECT_EQ(certificate_.hemicubes, 80u);
  }
}

TEST_F(ProgressTest, ASolveTellsRowsThenSweepsThenRowsOfBlackPatches) {
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    Recorder recorder;
    require(solve(0.5, &recorder, threads));
    const auto loops = loops_of(recorder.calls);
    ASSERT_EQ(loops.size(), 3u);
    expect_rows(loops[0], 0, 80, 96);
    EXPECT_EQ(loops[1].front().done, 0u);
    EXPECT_EQ(loops[1].back().done, certificate_.sweeps);
    expect_rows(loops[2], 80, 96, 96);
  }
}

// Catches: a solve without a sweep whose two loops over rows, and what lies between, look like one.
TEST_F(ProgressTest, TheSolverReportsEvenIfItHasNothingToDo) {
  Recorder recorder;
  require(solve(0, &recorder));
  EXPECT_EQ(certificate_.sweeps, 0u);
  const auto loops = loops_of(recorder.calls);
  ASSERT_EQ(loops.size(), 3u);
  expect_rows(loops[0], 0, 0, 96);
  expect_rows(loops[2], 0, 96, 96);
}

TEST_F(ProgressTest, RowsThatAreNotWantedAreNotCounted) {
  options_.black_irradiance = false;
  Recorder recorder;
  require(solve(0.5, &recorder));
  expect_rows(loops_of(recorder.calls).front(), 0, 80, 80);
  EXPECT_EQ(certificate_.hemicubes, 80u);
}

// Catches: the first call before the set-up, of which a wrong resolution is found.
TEST_F(ProgressTest, NothingIsToldOfAFailedSetUp) {
  options_.resolution = 17;
  Recorder recorder;
  EXPECT_EQ(form_factors({}, &recorder).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(solve(0.5, &recorder).code(), StatusCode::kInvalidArgument);
  EXPECT_TRUE(recorder.calls.empty());
}

TEST_F(ProgressTest, EveryCallCanStopTheRun) {
  Recorder whole;
  require(solve(0.5, &whole));
  for (std::uint64_t k = 0; k < whole.calls.size(); ++k) {
    Recorder recorder(k);
    EXPECT_EQ(solve(0.5, &recorder).code(), StatusCode::kCancelled) << "at call " << k;
    EXPECT_EQ(recorder.calls.size(), k + 1) << "the run went on";
  }
}

} // namespace
} // namespace hemicube::test
