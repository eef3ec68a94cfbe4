#include "radiosity/parallel/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace hemicube::radiosity {
namespace {

TEST(ThreadPool, RunsEveryBlockOnce) {
  for (const std::uint32_t threads : {1u, 2u, 3u, 7u}) {
    ThreadPool pool;
    ASSERT_TRUE(pool.init(threads).ok());
    EXPECT_EQ(pool.worker_count(), threads);
    for (const std::size_t blocks : {0, 1, 2, 1000}) {
      std::vector<std::atomic<int>> runs(blocks);
      ASSERT_TRUE(pool.for_each(blocks,
                                [&](std::size_t block, std::size_t worker) {
                                  EXPECT_LT(worker, threads);
                                  ++runs[block];
                                  return Status();
                                })
                      .ok());
      for (const auto& count : runs)
        EXPECT_EQ(count, 1);
    }
  }
}

TEST(ThreadPool, BlocksOfOneWorkerDoNotOverlap) {
  ThreadPool pool;
  ASSERT_TRUE(pool.init(4).ok());
  std::vector<std::atomic<int>> inside(4);
  ASSERT_TRUE(pool.for_each(5000,
                            [&](std::size_t, std::size_t worker) {
                              EXPECT_EQ(inside[worker]++, 0);
                              --inside[worker];
                              return Status();
                            })
                  .ok());
}

TEST(ThreadPool, ReturnsTheLowestFailureAndStops) {
  for (const std::uint32_t threads : {1u, 2u, 5u}) {
    ThreadPool pool;
    ASSERT_TRUE(pool.init(threads).ok());
    std::atomic<std::size_t> ran{0};
    const Status status = pool.for_each(100000, [&](std::size_t block, std::size_t) {
      ++ran;
      return block >= 50 ? Status::error(StatusCode::kIo, "block ", block) : Status();
    });
    EXPECT_EQ(status.code(), StatusCode::kIo);
    EXPECT_EQ(status.message(), "block 50");
    EXPECT_LT(ran, 1000u);
  }
}

TEST(ThreadPool, WorksAgainAfterAFailure) {
  ThreadPool pool;
  ASSERT_TRUE(pool.init(3).ok());
  EXPECT_FALSE(pool.for_each(10, [](std::size_t,
                                    std::size_t) { return Status::error(StatusCode::kIo, "no"); })
                   .ok());
  std::atomic<int> ran{0};
  EXPECT_TRUE(pool.for_each(10,
                            [&](std::size_t, std::size_t) {
                              ++ran;
                              return Status();
                            })
                  .ok());
  EXPECT_EQ(ran, 10);
}

} // namespace
} // namespace hemicube::radiosity
