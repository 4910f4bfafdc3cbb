// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The built-in studio: sound light of mean about 1, that tells left from right and up from down.
#include "vtkIBLStudio.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace reference = vtkIBLReference;

namespace
{
struct Studio
{
  Studio(int width, int height)
    : Texels(3 * width * height, -1.0f)
    , View{ this->Texels.data(), width, height, 1 }
    , Shape{ width, height, {} }
  {
    vtkIBLMakeStudio(this->View);
  }
  // Luminance, or one channel.
  double Get(int row, int column, int channel = -1) const
  {
    const float* rgb = &this->Texels[3 * (row * this->View.Width + column)];
    return channel < 0 ? 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2] : rgb[channel];
  }
  double Look(reference::Vec3 direction) const
  {
    const int texel = reference::TexelIndex(this->Shape, direction);
    return this->Get(texel / this->View.Width, texel % this->View.Width);
  }
  // Integral over the directions that `inside` is true of, over 4 pi.
  template <typename F>
  double Mean(F inside, int channel = -1) const
  {
    double sum = 0.0;
    for (int row = 0; row < this->View.Height; ++row)
    {
      const double weight = reference::TexelSolidAngle(this->Shape, row) / (4 * reference::Pi);
      for (int column = 0; column < this->View.Width; ++column)
      {
        sum +=
          inside(reference::TexelDirection(this->Shape, row, column)) ? weight * this->Get(row, column, channel) : 0.0;
      }
    }
    return sum;
  }
  std::vector<float> Texels;
  vtkIBLRadianceImage View;
  reference::Environment Shape;
};

bool Everywhere(reference::Vec3)
{
  return true;
}
}

// Every texel is written, finite, and between 0 and 5, at any size. Mutant: tints that multiply past 1; a pole that
// divides by 0.
TEST(Studio, IsSound)
{
  for (int height : { 1, 2, 7, 128 })
  {
    const Studio studio(2 * height, height);
    for (float x : studio.Texels)
    {
      ASSERT_GE(x, 0.0f); // false for NaN
      ASSERT_LE(x, 5.0f);
    }
  }
}

// Mean luminance is within a stop of 1 (it is 0.7), so exposure needs no thought; the hue is neutral to 3 %; and twice
// the texels change nothing that matters: no softbox is too sharp for its pixels. Mutant: a key light of 24.
TEST(Studio, MeanIsAboutOne)
{
  const Studio studio(512, 256);
  const double mean = studio.Mean(Everywhere);
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 2.0);
  for (int channel = 0; channel < 3; ++channel)
  {
    EXPECT_NEAR(studio.Mean(Everywhere, channel) / mean, 1.0, 0.03) << channel;
  }
  EXPECT_NEAR(Studio(1024, 512).Mean(Everywhere) / mean, 1.0, 1e-3);
}

// Where things are, seen from a camera that looks along -z: floor below, ceiling above, key to its upper left, fill to
// its right, rim behind the object. So a picture that is mirrored, or upside down, is seen at once. Mutants: row 0 at
// the top; the key's x negated.
TEST(Studio, TellsItsSides)
{
  const Studio studio(512, 256);
  EXPECT_NEAR(studio.Look({ 0, -1, 1e-3 }), 0.07, 0.01);
  EXPECT_NEAR(studio.Look({ 0, 1, 1e-3 }), 0.5, 0.01);
  EXPECT_GT(studio.Look({ -0.8, 0.8, 0.9 }), 4.5);
  EXPECT_LT(studio.Look({ 0.8, 0.8, 0.9 }), 1.7); // the fill
  EXPECT_NEAR(studio.Look({ 1, 0.25, 0.5 }), 1.2, 0.04);
  EXPECT_NEAR(studio.Look({ 0.35, 0.7, -1 }), 3.5, 0.1);
  EXPECT_GT(studio.Mean([](reference::Vec3 d) { return d.x < 0; }),
    1.5 * studio.Mean([](reference::Vec3 d) { return d.x > 0; }));
  EXPECT_GT(studio.Mean([](reference::Vec3 d) { return d.y > 0; }),
    5.0 * studio.Mean([](reference::Vec3 d) { return d.y < 0; }));
}
