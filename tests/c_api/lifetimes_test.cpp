// Handles, threads, callbacks, memory that runs out: at any moment an error code at worst.
#include "tests/c_api/rooms.h"

#include <atomic>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace hemicube::c_api_test {
namespace {

/// Memory that is counted, and runs out at one request.
class Memory {
public:
  Memory() {
    const hc_allocator allocator = {sizeof allocator, allocate, release, this};
    EXPECT_EQ(hc_set_allocator(&allocator), HC_OK) << hc_error_text();
  }
  ~Memory() {
    EXPECT_EQ(hc_set_allocator(nullptr), HC_OK) << hc_error_text();
    EXPECT_TRUE(blocks_.empty()) << blocks_.size() << " blocks were not given back";
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// @param request  from now on, 1 = the next; 0: none fails
  void fail_at(std::uint64_t request) {
    const std::lock_guard lock(mutex_);
    requests_ = 0;
    failing_ = request;
  }
  std::uint64_t requests() const { return requests_; }

private:
  static void* allocate(void* self, std::size_t bytes) {
    auto& memory = *static_cast<Memory*>(self);
    const std::lock_guard lock(memory.mutex_);
    if (++memory.requests_ == memory.failing_)
      return nullptr;
    void* block = std::aligned_alloc(64, (bytes + 63) / 64 * 64);
    memory.blocks_[block] = bytes;
    return block;
  }
  static void release(void* self, void* block, std::size_t bytes) {
    auto& memory = *static_cast<Memory*>(self);
    const std::lock_guard lock(memory.mutex_);
    EXPECT_EQ(memory.blocks_.at(block), bytes);
    memory.blocks_.erase(block);
    std::free(block);
  }

  std::mutex mutex_;
  std::map<void*, std::size_t> blocks_;
  std::uint64_t requests_ = 0, failing_ = 0;
};

/// Everything a scene can be asked for, until something fails.
int use_everything(const Room& cube, const hc_options& options) {
  OwnedScene scene;
  OwnedFormFactors rows, points;
  OwnedSolution direct, given;
  const double point[] = {0.5, 0.5, 0}, normal[] = {0, 0, 1};
  hc_options without_balance = options;
  without_balance.balance = 0;
  const auto ignore = [](void*, const hc_row*) { return 0; };
  int code = hc_scene_create(&cube.desc, scene.to());
  if (code == HC_OK)
    code = hc_form_factors_create(scene, &options, rows.to());
  if (code == HC_OK)
    code = hc_point_form_factors_create(scene, point, normal, 1, &without_balance, points.to());
  if (code == HC_OK)
    code = hc_form_factors_for_each(scene, &without_balance, ignore, nullptr, nullptr);
  if (code == HC_OK)
    code = hc_solve(scene, nullptr, &options, direct.to());
  return code == HC_OK ? hc_solve(scene, rows, &options, given.to()) : code;
}

TEST(CLifetimes, MemoryMayRunOutAtAnyRequest) {
  Memory memory;
  const Room cube = room(1, {0.5, 0}, {0, 1}); // with a patch that reflects nothing
  std::vector<hc_options> all = {options_of(HC_RUNG_HEMICUBE, 16, 2),
                                 options_of(HC_RUNG_CHOSEN, 16), options_of(HC_RUNG_ADAPTIVE, 16),
                                 options_of(HC_RUNG_HEMICUBE, 16)};
  all[1].no_error_estimate = 0;
  all[2].balance = 1;
  all[3].solver = HC_SOLVER_PROGRESSIVE;
  for (const hc_options& options : all) {
    memory.fail_at(0);
    ASSERT_EQ(use_everything(cube, options), HC_OK) << hc_error_text();
    const std::uint64_t requests = memory.requests();
    EXPECT_GT(requests, 100u);
    for (std::uint64_t request = 1; request <= requests; ++request) {
      memory.fail_at(request);
      const int code = use_everything(cube, options);
      // With threads the number of requests may differ from run to run.
      if (code != HC_OK || memory.requests() >= request) {
        EXPECT_EQ(code, HC_OUT_OF_MEMORY) << request << ": " << hc_error_text();
      }
    }
  }
}

TEST(CLifetimes, AllocatorStaysWhileThereAreHandles) {
  const Room cube = room(1);
  const hc_allocator incomplete = {sizeof incomplete, nullptr, nullptr, nullptr};
  EXPECT_EQ(hc_set_allocator(&incomplete), HC_INVALID_ARGUMENT);
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  EXPECT_EQ(hc_set_allocator(nullptr), HC_INVALID_ARGUMENT);
  scene.to();
  EXPECT_EQ(hc_set_allocator(nullptr), HC_OK);
}

TEST(CLifetimes, HandlesKeepWhatTheyNeed) {
  const Room cube = room(2);
  hc_scene* scene = nullptr;
  hc_form_factors* rows = nullptr;
  OwnedSolution solution;
  const hc_options options = options_of(HC_RUNG_HEMICUBE, 16);
  ASSERT_EQ(hc_scene_create(&cube.desc, &scene), HC_OK);
  ASSERT_EQ(hc_form_factors_create(scene, &options, &rows), HC_OK);
  ASSERT_EQ(hc_solve(scene, rows, &options, solution.to()), HC_OK);
  hc_scene_release(scene);
  std::uint64_t nonzeros = 0;
  ASSERT_EQ(hc_form_factors_get_size(rows, nullptr, nullptr, &nonzeros), HC_OK);
  std::vector<double> values(nonzeros);
  EXPECT_EQ(hc_form_factors_get_csr(rows, 24, nonzeros, nullptr, nullptr, values.data(), nullptr,
                                    nullptr),
            HC_OK);
  hc_form_factors_release(rows);
  EXPECT_GT(values_of(solution, HC_RADIOSITY, 24)[0], 0);
}

TEST(CLifetimes, CallsMayEndAtAnyProgress) {
  const Room cube = room(2, {0.5, 0}, {0, 1});
  OwnedScene scene;
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  struct Count {
    std::atomic<int> calls{0};
    int last = -1;
  };
  for (const int solver : {HC_SOLVER_GAUSS_SEIDEL, HC_SOLVER_JACOBI, HC_SOLVER_PROGRESSIVE})
    for (const int balance : {0, 1}) {
      int told = 0;
      for (const bool asks : {false, true}) {
        hc_options options = options_of(HC_RUNG_AREA, 16, 2);
        options.solver = solver;
        options.balance = balance;
        Count count;
        options.context = &count;
        if (asks)
          options.is_cancelled = [](void* context) {
            auto& c = *static_cast<Count*>(context);
            const int call = c.calls++;
            return c.last >= 0 && call >= c.last ? 1 : 0;
          };
        else
          options.progress = [](void* context, const hc_progress* progress) {
            auto& c = *static_cast<Count*>(context);
            EXPECT_EQ(progress->struct_size, sizeof(hc_progress));
            EXPECT_TRUE(progress->stage != HC_STAGE_ROWS || progress->done <= progress->total);
            return c.calls++ == c.last ? 1 : 0;
          };
        OwnedSolution solution;
        ASSERT_EQ(hc_solve(scene, nullptr, &options, solution.to()), HC_OK) << hc_error_text();
        const int calls = count.calls;
        EXPECT_GT(calls, asks ? told : 3); // it is asked before every block, too
        told = calls;
        const int step = calls > 40 ? calls / 40 : 1;
        for (count.last = 0; count.last < calls; count.last += step) {
          count.calls = 0;
          const int code = hc_solve(scene, nullptr, &options, solution.to());
          // A call that finds another one at work leaves it at that: there may be fewer.
          if (count.calls > count.last) {
            EXPECT_EQ(code, HC_CANCELLED) << hc_error_text();
            EXPECT_EQ(solution, nullptr);
          }
        }
      }
    }
}

TEST(CLifetimes, RowCallbackMayStopAndReleaseItsScene) {
  const Room cube = room(2);
  hc_scene* scene = nullptr;
  ASSERT_EQ(hc_scene_create(&cube.desc, &scene), HC_OK);
  const hc_options options = options_of(HC_RUNG_HEMICUBE, 16, 2);
  const auto stop = [](void*, const hc_row* row) { return row->index == 20 ? 1 : 0; };
  EXPECT_EQ(hc_form_factors_for_each(scene, &options, stop, nullptr, nullptr), HC_CANCELLED);
  EXPECT_STREQ(hc_error_text(), "interrupted at row 20");
  const auto release = [](void* context, const hc_row*) {
    auto& owned = *static_cast<hc_scene**>(context);
    hc_scene_release(owned);
    owned = nullptr;
    return 0;
  };
  EXPECT_EQ(hc_form_factors_for_each(scene, &options, release, &scene, nullptr), HC_OK);
  EXPECT_EQ(scene, nullptr);
}

TEST(CLifetimes, ThreadsShareHandlesAndKeepTheirErrors) {
  const Room cube = room(2);
  OwnedScene scene;
  OwnedFormFactors rows;
  const hc_options options = options_of(HC_RUNG_HEMICUBE, 16, 2);
  ASSERT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK);
  ASSERT_EQ(hc_form_factors_create(scene, &options, rows.to()), HC_OK);
  OwnedSolution expected;
  ASSERT_EQ(hc_solve(scene, rows, &options, expected.to()), HC_OK);
  const std::uint64_t hash = certificate_of(expected).radiosity_hash;
  std::vector<std::thread> threads;
  for (std::uint32_t number = 0; number < 4; ++number)
    threads.emplace_back([&, number] {
      hc_options wrong = options;
      wrong.resolution = 2 * number + 1;
      for (int round = 0; round < 5; ++round) {
        OwnedSolution solution;
        EXPECT_EQ(hc_solve(scene, nullptr, &wrong, solution.to()), HC_INVALID_ARGUMENT);
        EXPECT_EQ(hc_solve(scene, round % 2 == 0 ? static_cast<hc_form_factors*>(rows) : nullptr,
                           &options, solution.to()),
                  HC_OK);
        EXPECT_EQ(certificate_of(solution).radiosity_hash, hash);
        EXPECT_NE(std::string(hc_error_text()).find(std::to_string(2 * number + 1) + ", not even"),
                  std::string::npos)
            << hc_error_text();
      }
    });
  for (std::thread& thread : threads)
    thread.join();
}

TEST(CLifetimes, RepairsAreLogged) {
  Room cube = room(1);
  for (int k = 0; k < 4; ++k) // a polygon without area
    cube.indices.push_back(k == 3 ? 0 : static_cast<std::uint32_t>(k));
  cube.offsets.push_back(cube.indices.size());
  cube.materials.push_back(0);
  cube.point();
  std::string told;
  ASSERT_EQ(hc_set_log([](void* context,
                          const char* message) { *static_cast<std::string*>(context) += message; },
                       &told),
            HC_OK);
  OwnedScene scene;
  EXPECT_EQ(hc_scene_create(&cube.desc, scene.to()), HC_OK) << hc_error_text();
  hc_set_log(nullptr, nullptr);
  EXPECT_NE(told.find("polygons left out: 1"), std::string::npos) << told;
  hc_scene_info info = {};
  info.struct_size = sizeof info;
  ASSERT_EQ(hc_scene_get_info(scene, &info), HC_OK);
  EXPECT_EQ(info.dropped_repeated_index, 1u);
  EXPECT_EQ(info.patch_count, 6u);
}

} // namespace
} // namespace hemicube::c_api_test
