// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// Broken texels are counted and repaired from their neighbours; mean luminance is weighted by solid angle.
#include "vtkIBLRadianceImage.h"

#include "Reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace reference = vtkIBLReference;

namespace
{
const float NaN = std::numeric_limits<float>::quiet_NaN();
const float Infinity = std::numeric_limits<float>::infinity();

// An image that owns its memory. Texel i holds (i + 1, 2 (i + 1), 3 (i + 1)).
class Image
{
public:
  Image(int width, int height, int faces = 1)
    : Memory(3 * width * height * faces)
    , View{ this->Memory.data(), width, height, faces }
  {
    for (std::size_t i = 0; i < this->Memory.size(); ++i)
    {
      this->Memory[i] = static_cast<float>((i / 3 + 1) * (i % 3 + 1));
    }
  }
  float* At(int column, int row, int face = 0)
  {
    return &this->Memory[3 * ((face * this->View.Height + row) * this->View.Width + column)];
  }
  void Set(float r, float g, float b, int column, int row, int face = 0)
  {
    const float rgb[3] = { r, g, b };
    std::copy(rgb, rgb + 3, this->At(column, row, face));
  }
  void Fill(float r, float g, float b)
  {
    for (std::size_t i = 0; i < this->Memory.size(); i += 3)
    {
      this->Set(r, g, b, static_cast<int>(i / 3), 0);
    }
  }
  std::vector<float> GetTexel(int column, int row) { return { this->At(column, row), this->At(column, row) + 3 }; }
  std::vector<float> Memory;
  vtkIBLRadianceImage View;
};

// The texel holds the mean of these others of its face.
void ExpectMean(Image& image, int column, int row, std::initializer_list<std::array<int, 2>> texels, int face = 0)
{
  for (int k = 0; k < 3; ++k)
  {
    double sum = 0.0;
    for (const auto& texel : texels)
    {
      sum += image.At(texel[0], texel[1], face)[k];
    }
    EXPECT_FLOAT_EQ(image.At(column, row, face)[k], sum / texels.size()) << column << ", " << row << ", " << face;
  }
}
}

// A sound image stays as it is, to the bit, up to the largest radiance taken at its word, and down to 0 and denormals.
TEST(CleanRadiance, LeavesSoundTexelsAlone)
{
  Image image(8, 4);
  image.Set(vtkIBLLargestRadiance, 0.0f, 1e-42f, 3, 2);
  image.Set(65504.0f, 0.0f, -0.0f, 4, 2);
  const std::vector<float> before = image.Memory;
  const vtkIBLRadianceFaults faults = vtkIBLCleanRadiance(image.View);
  EXPECT_EQ(faults.NotFinite + faults.TooLarge + faults.Negative, 0u);
  EXPECT_EQ(faults.MostNegative, 0.0f);
  EXPECT_EQ(image.Memory, before);
}

// One broken channel breaks the texel: it becomes the mean of the eight around it, which stay as they are. Mutants:
// only the broken channel replaced; isnan for the comparison (infinities stay); the limit compared without abs.
TEST(CleanRadiance, RepairsFromNeighbours)
{
  for (float broken : { NaN, Infinity, -Infinity, 1e30f, -1e30f, 1.001e10f })
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      Image image(8, 4);
      image.At(3, 2)[channel] = broken;
      const vtkIBLRadianceFaults faults = vtkIBLCleanRadiance(image.View);
      EXPECT_EQ(faults.NotFinite, std::isfinite(broken) ? 0u : 1u) << broken;
      EXPECT_EQ(faults.TooLarge, std::isfinite(broken) ? 1u : 0u) << broken;
      EXPECT_EQ(image.Memory, Image(8, 4).Memory) << broken; // a ramp: the mean of the eight is what stood there
    }
  }
}

// Negative channels become 0, the others stay; a texel counts once. A negative neighbour counts as 0 in a mean,
// wherever it comes in memory. Mutants: texels counted by channel; MostNegative of the last, not the least; a
// neighbour's negative value averaged in.
TEST(CleanRadiance, NegativesBecomeZero)
{
  Image image(8, 4);
  image.Set(-1.0f, 5.0f, -0.25f, 2, 1);
  image.Set(7.0f, -1e-7f, 9.0f, 6, 3);
  const vtkIBLRadianceFaults faults = vtkIBLCleanRadiance(image.View);
  EXPECT_EQ(faults.Negative, 2u);
  EXPECT_EQ(faults.MostNegative, -1.0f);
  EXPECT_EQ(image.GetTexel(2, 1), (std::vector<float>{ 0.0f, 5.0f, 0.0f }));
  EXPECT_EQ(image.GetTexel(6, 3), (std::vector<float>{ 7.0f, 0.0f, 9.0f }));

  Image mixed(8, 4);
  mixed.Fill(8.0f, 8.0f, 8.0f);
  mixed.Set(NaN, 0.0f, 0.0f, 3, 2);
  mixed.Set(-800.0f, 8.0f, 8.0f, 2, 1); // before it in memory
  mixed.Set(8.0f, -800.0f, 8.0f, 4, 3); // after it
  vtkIBLCleanRadiance(mixed.View);
  EXPECT_EQ(mixed.GetTexel(3, 2), (std::vector<float>{ 7.0f, 7.0f, 8.0f }));
}

// A texel with several faults counts once in each, and is repaired. Mutant: else if.
TEST(CleanRadiance, SeveralFaultsInOneTexel)
{
  Image image(8, 4);
  image.Set(NaN, 1e30f, -3.0f, 3, 2);
  const vtkIBLRadianceFaults faults = vtkIBLCleanRadiance(image.View);
  EXPECT_EQ(faults.NotFinite, 1u);
  EXPECT_EQ(faults.TooLarge, 1u);
  EXPECT_EQ(faults.Negative, 1u);
  EXPECT_EQ(faults.MostNegative, -3.0f);
  EXPECT_EQ(image.Memory, Image(8, 4).Memory);
}

// Two broken texels side by side: neither is the other's sound neighbour, whichever is repaired first. Mutant: repairs
// applied at once.
TEST(CleanRadiance, TwoSideBySide)
{
  Image image(8, 4);
  image.Set(NaN, 0.0f, 0.0f, 3, 2);
  image.Set(0.0f, 1e30f, 0.0f, 4, 2);
  vtkIBLCleanRadiance(image.View);
  ExpectMean(image, 3, 2, { { 2, 1 }, { 3, 1 }, { 4, 1 }, { 2, 2 }, { 2, 3 }, { 3, 3 }, { 4, 3 } });
  ExpectMean(image, 4, 2, { { 3, 1 }, { 4, 1 }, { 5, 1 }, { 5, 2 }, { 3, 3 }, { 4, 3 }, { 5, 3 } });
}

// Longitude wraps at either side of the seam. A pole has neighbours on one side only. Mutants: columns clamped; rows
// wrapped.
TEST(CleanRadiance, SeamAndPoles)
{
  Image left(8, 4), right(8, 4), bottom(8, 4), top(8, 4);
  left.Set(NaN, 0.0f, 0.0f, 0, 1);
  right.Set(NaN, 0.0f, 0.0f, 7, 2);
  bottom.Set(NaN, 0.0f, 0.0f, 3, 0);
  top.Set(NaN, 0.0f, 0.0f, 0, 3);
  for (Image* image : { &left, &right, &bottom, &top })
  {
    EXPECT_EQ(vtkIBLCleanRadiance(image->View).NotFinite, 1u);
  }
  ExpectMean(left, 0, 1, { { 7, 0 }, { 0, 0 }, { 1, 0 }, { 7, 1 }, { 1, 1 }, { 7, 2 }, { 0, 2 }, { 1, 2 } });
  ExpectMean(right, 7, 2, { { 6, 1 }, { 7, 1 }, { 0, 1 }, { 6, 2 }, { 0, 2 }, { 6, 3 }, { 7, 3 }, { 0, 3 } });
  ExpectMean(bottom, 3, 0, { { 2, 0 }, { 4, 0 }, { 2, 1 }, { 3, 1 }, { 4, 1 } });
  ExpectMean(top, 0, 3, { { 7, 3 }, { 1, 3 }, { 7, 2 }, { 0, 2 }, { 1, 2 } });
}

// A cube face ends at its edge: the mean of the five, or at a corner three, neighbours on the same face, each once.
// Mutants: columns wrapped; columns clamped, so that the edge counts twice; the face's index left out.
TEST(CleanRadiance, CubeFacesDoNotWrap)
{
  Image image(4, 4, 6);
  image.Set(NaN, 0.0f, 0.0f, 0, 1, 2);
  image.Set(0.0f, NaN, 0.0f, 3, 3, 4);
  image.Set(0.0f, 0.0f, NaN, 1, 0, 5);
  EXPECT_EQ(vtkIBLCleanRadiance(image.View).NotFinite, 3u);
  ExpectMean(image, 0, 1, { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 2 }, { 1, 2 } }, 2);
  ExpectMean(image, 3, 3, { { 2, 2 }, { 3, 2 }, { 2, 3 } }, 4);
  ExpectMean(image, 1, 0, { { 0, 0 }, { 2, 0 }, { 0, 1 }, { 1, 1 }, { 2, 1 } }, 5);
}

// No sound neighbour: black. Of one texel, of all of an image, of a face of one texel.
TEST(CleanRadiance, NothingSound)
{
  for (int faces : { 1, 6 })
  {
    Image image(1, 1, faces);
    image.Fill(NaN, 1.0f, 1.0f);
    EXPECT_EQ(vtkIBLCleanRadiance(image.View).NotFinite, std::size_t(faces));
    EXPECT_EQ(image.Memory, std::vector<float>(3 * faces, 0.0f));
  }
  Image image(8, 4);
  image.Fill(Infinity, NaN, -1.0f);
  EXPECT_EQ(vtkIBLCleanRadiance(image.View).NotFinite, 32u);
  EXPECT_EQ(image.Memory, std::vector<float>(3 * 32, 0.0f));
}

// Rec. 709: 0.2126, 0.7152, 0.0722. Mutants: a plain mean of channels; the weights of red and blue swapped.
TEST(MeanLuminance, OfAConstant)
{
  for (int faces : { 1, 6 })
  {
    Image image(8, faces == 6 ? 8 : 4, faces);
    image.Fill(1.0f, 2.0f, 4.0f);
    EXPECT_NEAR(vtkIBLMeanLuminance(image.View), 0.2126 + 2 * 0.7152 + 4 * 0.0722, 1e-12);
  }
}

// 1 + axis.direction has mean 1 whatever the axis: each texel of the reference holds the exact mean over its solid
// angle. The same light on cube faces has the same mean. 1e-7: texels rounded to float; 1e-6: the reference's
// meridians. Mutants: sin at the row's lower edge; lat-long weights on cube faces.
TEST(MeanLuminance, OfACosine)
{
  const reference::Environment cosine = reference::CosineEnvironment(reference::Normalize({ 0.2, 0.9, -0.3 }), 32, 16);
  Image image(32, 16);
  std::copy(cosine.rgb.begin(), cosine.rgb.end(), image.Memory.begin());
  EXPECT_NEAR(vtkIBLMeanLuminance(image.View), 1.0, 1e-7);

  const std::vector<reference::RGB> texels = reference::CubeTexelAverages(cosine, 6);
  Image faces(6, 6, 6);
  std::copy_n(texels[0].data(), faces.Memory.size(), faces.Memory.begin());
  EXPECT_NEAR(vtkIBLMeanLuminance(faces.View), 1.0, 1e-6);
}

// A sun of one texel has L Omega / 4 pi, by the reference's solid angles, at poles, equator, face centres and corners.
// Mutants: every texel weighed the same, of lat-long or of cube.
TEST(MeanLuminance, OfOneTexel)
{
  const float sun = 1e6f;
  const reference::Environment shape{ 32, 16, {} };
  for (int row : { 0, 1, 7, 8, 15 })
  {
    Image image(32, 16);
    image.Fill(0.0f, 0.0f, 0.0f);
    image.Set(sun, sun, sun, row, row);
    const double expected = sun * reference::TexelSolidAngle(shape, row) / (4 * reference::Pi);
    EXPECT_NEAR(vtkIBLMeanLuminance(image.View), expected, 1e-12 * expected) << row;
  }
  for (int texel : { 0, 3, 21, 36, 63 })
  {
    Image image(8, 8, 6);
    image.Fill(0.0f, 0.0f, 0.0f);
    image.Set(sun, sun, sun, texel % 8, texel / 8, texel % 6);
    const double expected = sun * reference::CubeTexelSolidAngle(8, texel % 8, texel / 8) / (4 * reference::Pi);
    EXPECT_NEAR(vtkIBLMeanLuminance(image.View), expected, 1e-12 * expected) << texel;
  }
}
