#include "base/thread_pool.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

#include "fusee/base.h"

namespace fusee {
namespace {

using namespace std::chrono_literals;

void sleep_briefly() { std::this_thread::sleep_for(1ms); }

// Each job waits for the other, so one thread alone would never end.
TEST(ThreadPool, LoopUsesTwoThreads) {
  ThreadPool pool(2);
  std::latch both(2);
  pool.each(2, [&](std::size_t, std::size_t) { both.arrive_and_wait(); });
}

TEST(ThreadPool, LoopStaysWithinLimit) {
  for (const unsigned limit : {1u, 2u, 3u}) {
    ThreadPool pool(4);
    std::atomic<unsigned> working = 0;
    std::atomic<unsigned> most = 0;
    const auto job = [&](std::size_t, std::size_t) {
      const unsigned now = ++working;
      for (unsigned before = most; before < now && !most.compare_exchange_weak(before, now);) {
      }
      sleep_briefly();
      --working;
    };
    pool.each(24, job, limit);
    EXPECT_LE(most, limit);
  }
}

TEST(ThreadPool, LoopCallsEveryIndexOnce) {
  for (const unsigned threads : {1u, 2u, 5u}) {
    ThreadPool pool(threads);
    for (const std::size_t count : {0, 1, 3, 1000}) {
      std::vector<int> calls(count);
      pool.each(count, [&](std::size_t i, std::size_t) { ++calls[i]; });
      EXPECT_EQ(calls, std::vector<int>(count, 1));
    }
  }
}

TEST(ThreadPool, SlotIsNeverSharedAtOnce) {
  ThreadPool pool(4);
  std::vector<std::atomic<bool>> taken(pool.threads());
  pool.each(40, [&](std::size_t, std::size_t slot) {
    EXPECT_FALSE(taken.at(slot).exchange(true));
    sleep_briefly();
    taken[slot] = false;
  });
}

TEST(ThreadPool, ExceptionOfLowestIndexIsThrown) {
  ThreadPool pool(3);
  for (const std::size_t later : {3, 4}) {
    std::latch both(2);
    std::string message;
    try {
      pool.each(100, [&](std::size_t i, std::size_t) {
        if (i != 3 && i != 4) return;
        both.arrive_and_wait();
        if (i == later) std::this_thread::sleep_for(50ms);
        throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    EXPECT_EQ(message, "3") << later << " fails later";
  }
}

TEST(ThreadPool, LoopEndsAfterStop) {
  ThreadPool pool(2);
  std::stop_source source;
  std::atomic<int> calls = 0;
  const auto job = [&](std::size_t, std::size_t) {
    if (++calls == 3) source.request_stop();
    sleep_briefly();
  };
  EXPECT_THROW(pool.each(1000, job, 0, source.get_token()), Stopped);
  EXPECT_LE(calls, 4);  // the third call requests the stop; the other thread may have begun a fourth
}

TEST(ThreadPool, StopInLastJobIsIgnored) {
  ThreadPool pool(2);
  std::stop_source source;
  const auto job = [&](std::size_t i, std::size_t) {
    if (i == 9) source.request_stop();
  };
  EXPECT_NO_THROW(pool.each(10, job, 0, source.get_token()));
}

/// Number of leaves of a tree whose nodes have four branches: three by a loop, one by a task.
int leaves_of_tree(ThreadPool& pool, int depth) {
  if (depth == 0) return 1;
  std::vector<int> parts(3);
  auto other = pool.run_async([&pool, depth] { return leaves_of_tree(pool, depth - 1); });
  pool.each(parts.size(), [&](std::size_t i, std::size_t) { parts[i] = leaves_of_tree(pool, depth - 1); });
  return parts[0] + parts[1] + parts[2] + other.get();
}

TEST(ThreadPool, NestedJobsFinish) {
  for (const unsigned threads : {1u, 2u, 4u}) {
    ThreadPool pool(threads);
    EXPECT_EQ(leaves_of_tree(pool, 5), 1024);  // 4⁵
  }
}

// A chain of tasks, each of which awaits the one before it.
TEST(ThreadPool, TaskThatAwaitsAnotherFinishes) {
  ThreadPool pool(2);
  std::vector<Task<int>> chain;
  chain.push_back(pool.run_async([] { return 1; }));
  chain.reserve(50);
  for (std::size_t i = 1; i < 50; ++i)
    chain.push_back(pool.run_async([before = &chain[i - 1]] { return before->value() + 1; }));
  EXPECT_EQ(chain.back().value(), 50);
}

// The caller waits for `slow`, and `slow` for `other`. The pool of two threads begins `other` only if the thread of
// `slow` does not count while it waits.
TEST(ThreadPool, WaitingThreadDoesNotCount) {
  ThreadPool pool(2);
  std::latch begun(1);
  std::latch end(1);
  auto slow = pool.run_async([&] {
    begun.count_down();
    const ThreadPool::WaitingScope waiting(pool);
    end.wait();
  });
  begun.wait();
  auto other = pool.run_async([&] { end.count_down(); });
  slow.get();
  other.get();
}

TEST(ThreadPool, TaskKeepsException) {
  ThreadPool pool(2);
  for (const bool in_background : {false, true}) {
    auto task = pool.run_async([]() -> int { throw InputError("joint.toml", "bad"); }, in_background);
    EXPECT_THROW(task.get(), InputError);
  }
}

// The work refers to a variable that is destroyed after the task.
TEST(ThreadPool, TaskEndsWithItsScope) {
  ThreadPool pool(2);
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> state = 0;
    try {
      auto task = pool.run_async([&state] {
        state = 1;
        std::this_thread::yield();
        state = 2;
      });
      throw Stopped();
    } catch (const Stopped&) {
      ASSERT_NE(state, 1);
    }
  }
}

TEST(ThreadPool, UnrequestedForegroundWorkIsDropped) {
  ThreadPool pool(2);
  bool has_begun = false;
  {
    auto task = pool.run_async([&has_begun] { has_begun = true; }, /*in_background=*/false);
    sleep_briefly();
  }
  EXPECT_FALSE(has_begun);
}

// The shared pool of the parent has threads that do not exist in the child. There, each of two jobs waits for the
// other.
TEST(ThreadPool, ForkedProcessHasThreads) {
  if (ThreadPool::shared().threads() < 2) GTEST_SKIP() << "one processor";
  ThreadPool::shared().each(100, [](std::size_t, std::size_t) { sleep_briefly(); });
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::alarm(20);
    std::latch both(2);
    ThreadPool::shared().each(2, [&](std::size_t, std::size_t) { both.arrive_and_wait(); });
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace fusee
