// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLParallelFor.h"

#include "vtkIBLSpectrum.h"

#include <gtest/gtest.h>

#include <cstring>
#include <thread>
#include <vector>

namespace
{
void InOrder(int count, const std::function<void(int)>& body)
{
  for (int i = 0; i < count; ++i)
  {
    body(i);
  }
}

// An exception out of body ends the program here, as in any pool.
void OnThreads(int count, const std::function<void(int)>& body)
{
  std::vector<std::thread> pool;
  for (int t = 0; t < 3; ++t)
  {
    pool.emplace_back(
      [&, t]
      {
        for (int i = t; i < count; i += 3)
        {
          body(i);
        }
      });
  }
  for (std::thread& thread : pool)
  {
    thread.join();
  }
}
}

// Left alone it is the loop that was given: each item once, and all counted.
TEST(TestParallelFor, RunsEachItemOnce)
{
  const std::atomic<bool> abort{ false };
  std::atomic<int> finished{ 0 };
  std::vector<int> runs(100);
  const vtkIBLParallelFor loop = vtkIBLMakeAbortable(OnThreads, abort, finished);
  loop(100, [&runs](int i) { ++runs[i]; });
  loop(0, [](int) { FAIL(); });
  EXPECT_EQ(runs, std::vector<int>(100, 1));
  EXPECT_EQ(finished, 100);
}

// Called off, it begins nothing more, waits for what is at work and throws on the thread that called. Mutants: the
// exception thrown where the item is; no exception when the last item called it off; none when the flag has fallen
// again by the end, which would pass off half a result as whole.
TEST(TestParallelFor, StopsWhenCalledOff)
{
  for (int last : { 0, 6, 99 })
  {
    std::atomic<bool> abort{ false };
    std::atomic<int> finished{ 0 };
    const auto body = [&](int i)
    {
      if (i == last)
      {
        abort = true;
      }
    };
    EXPECT_THROW(vtkIBLMakeAbortable(InOrder, abort, finished)(100, body), vtkIBLAborted);
    EXPECT_EQ(finished, last + 1);
    EXPECT_THROW(vtkIBLMakeAbortable(InOrder, abort, finished)(100, body), vtkIBLAborted);
    EXPECT_EQ(finished, last + 1);
    abort = false;
    EXPECT_THROW(vtkIBLMakeAbortable(OnThreads, abort, finished)(100, body), vtkIBLAborted);
  }
  std::atomic<bool> abort{ false };
  std::atomic<int> finished{ 0 };
  const vtkIBLParallelFor takenBack = [&abort](int count, const std::function<void(int)>& body)
  {
    InOrder(count, body);
    abort = false;
  };
  EXPECT_THROW(vtkIBLMakeAbortable(takenBack, abort, finished)(10, [&abort](int i) { abort = i == 3; }), vtkIBLAborted);
  EXPECT_EQ(finished, 4);
}

// A bake in work, called off by another thread who watches it, stops somewhere in each of its two halves and leaves
// nothing behind: done again, it gives the bits of one that was left alone. Mutant: the spectrum's second loop without
// parallelFor.
TEST(TestParallelFor, ABakeCanBeCalledOff)
{
  const int width = 128, height = 64, order = 48, faceSize = 16;
  std::vector<float> texels(std::size_t(3) * width * height);
  for (std::size_t i = 0; i < texels.size(); ++i)
  {
    texels[i] = float(i % 97) / 97;
  }
  const vtkIBLRadianceImage image{ texels.data(), width, height, 1 };
  const auto bake = [&](const vtkIBLParallelFor& parallelFor)
  {
    std::vector<float> layer(std::size_t(18) * faceSize * faceSize);
    vtkIBLSpectrum(image, order, parallelFor).Filter({ { 0.4, 1.0 } }, faceSize, 0, layer.data(), parallelFor);
    return layer;
  };
  const std::atomic<bool> never{ false };
  std::atomic<int> all{ 0 };
  const std::vector<float> whole = bake(vtkIBLMakeAbortable(OnThreads, never, all));
  EXPECT_GT(all, height + order);

  for (int share = 0; share < 8; ++share)
  {
    std::atomic<bool> abort{ false };
    std::atomic<int> finished{ 0 };
    std::atomic<bool> isWatched{ false };
    std::thread watcher(
      [&]
      {
        while (finished < all * share / 8)
        {
          std::this_thread::yield();
        }
        abort = true;
        isWatched = true;
      });
    // However slow the watcher is, the bake's last item waits for it.
    const vtkIBLParallelFor patient = [&](int count, const std::function<void(int)>& body)
    {
      OnThreads(count,
        [&](int i)
        {
          while (finished + 3 >= all && !isWatched)
          {
            std::this_thread::yield();
          }
          body(i);
        });
    };
    EXPECT_THROW(bake(vtkIBLMakeAbortable(patient, abort, finished)), vtkIBLAborted) << share;
    EXPECT_LT(finished, all) << share;
    watcher.join();
  }
  std::atomic<int> finished{ 0 };
  const std::vector<float> again = bake(vtkIBLMakeAbortable(OnThreads, never, finished));
  EXPECT_EQ(std::memcmp(again.data(), whole.data(), whole.size() * sizeof(float)), 0);
  EXPECT_EQ(finished, all.load());
}
