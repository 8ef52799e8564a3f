// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#ifdef LMDBENCH_VISIBLE_THREADS
#include <algorithm>
#include <map>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#endif

/// Loops over several threads, on oneTBB. On std::thread in builds without it and under the thread
/// sanitizer (LMDBENCH_VISIBLE_THREADS): the distribution's oneTBB is not instrumented, so the
/// sanitizer cannot see how its tasks wait for one another and reports each hand-over as a race. A
/// single range makes no pool of threads.
namespace lmdbench {

#ifdef LMDBENCH_VISIBLE_THREADS

/// Calls body(begin, end) for ranges that cover [0, count).
template <typename Body>
void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
  constexpr std::size_t MOST_THREADS = 4;
  const std::size_t parts = std::clamp<std::size_t>(count / std::max<std::size_t>(grain, 1), 1, MOST_THREADS);
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < parts; ++i)
    threads.emplace_back([&, i] { body(count * i / parts, count * (i + 1) / parts); });
  body(0, count / parts);
  for (std::thread& thread : threads) thread.join();
}

template <typename First, typename Second>
void parallel_invoke(const First& first, const Second& second) {
  std::thread other(first);
  second();
  other.join();
}

template <typename T>
class PerThread {
 public:
  explicit PerThread(std::function<T()> make) : make_(std::move(make)) {}
  T& local() {
    const std::lock_guard lock(mutex_);
    const auto id = std::this_thread::get_id();
    const auto found = values_.find(id);
    return found != values_.end() ? found->second : values_.emplace(id, make_()).first->second;
  }

 private:
  std::function<T()> make_;
  std::mutex mutex_;
  std::map<std::thread::id, T> values_;
};

#else

/// Calls body(begin, end) for ranges that cover [0, count), of about `grain` or more.
template <typename Body>
void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
  if (count <= grain) {
    body(std::size_t{0}, count);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

/// Calls both, perhaps at the same time.
template <typename First, typename Second>
void parallel_invoke(const First& first, const Second& second) {
  tbb::parallel_invoke(first, second);
}

/// A value a thread, made when the thread first asks for it.
template <typename T>
class PerThread {
 public:
  explicit PerThread(std::function<T()> make) : values_(std::move(make)) {}
  T& local() { return values_.local(); }

 private:
  tbb::enumerable_thread_specific<T> values_;
};

#endif

/// Calls body(i) for every i in [0, count).
template <typename Body>
void parallel_for(std::size_t count, const Body& body) {
  parallel_ranges(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace lmdbench
