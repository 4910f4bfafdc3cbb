// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLBRDFTable.h"
#include "vtkIBLBRDFTableTexels.h"
#include "vtkIBLShaderFunctions.h"

namespace reference = vtkIBLReference;

class TestBRDFTableGL : public GLTest
{
protected:
  static constexpr int n = vtkIBLBRDFTable::Size;

  void Judge(vtkImageData* image, const std::function<reference::SplitSum(int, int)>& getTruth)
  {
    double squares = 0;
    double worst = 0;
    int count = 0;
    for (int j = 1; j < n; j += 3)
    {
      for (int i = 1; i < n; i += 3)
      {
        const reference::SplitSum truth = getTruth(i, j);
        const RGB ab = GetTexel(image, i, j);
        for (double error : { ab[0] - truth.A, ab[1] - truth.B })
        {
          squares += error * error;
          worst = std::max(worst, std::abs(error));
          ++count;
        }
      }
    }
    std::printf("rms %.1e, worst %.1e\n", std::sqrt(squares / count), worst);
    EXPECT_LT(std::sqrt(squares / count), 3e-4);
    EXPECT_LT(worst, 2e-3);
  }
};

// By default the texture is the constant, to the last bit (tests/core/TestBRDFTableTexels says what that is worth). No
// program is made for it. Mutants: BGR order, a row of padding.
TEST_F(TestBRDFTableGL, IsTheConstant)
{
  vtkNew<vtkIBLBRDFTable> table;
  ASSERT_TRUE(table->Update(this->Window));
  vtkSmartPointer<vtkImageData> image = table->Read();
  ASSERT_EQ(image->GetNumberOfPoints() * image->GetNumberOfScalarComponents(), 4 * 2 * n * n);
  const auto* value = static_cast<const float*>(image->GetScalarPointer());
  for (int i = 0; i < 4 * 2 * n * n; ++i)
  {
    ASSERT_NEAR(value[i] * 65535, vtkIBLBRDFTableTexels[i], 0.01) << i;
  }
}

// The GPU's sampling, by visible half vectors, and the constant, by quadrature over all of them, agree: they share no
// more than V and F. 1024 points leave 2e-4 rms, 1.2e-3 at worst; roughness 0 is alpha 1e-3 and NoV 0 is 1e-4 to the
// sampler. Mutants: roughness for alpha, axes swapped, NoV for sqrt(NoV), uncorrelated Smith (0.02) in either.
TEST_F(TestBRDFTableGL, SamplingAgreesWithTheConstant)
{
  vtkNew<vtkIBLBRDFTable> table;
  table->SetNumberOfSamples(1024);
  ASSERT_TRUE(table->Update(this->Window));
  vtkSmartPointer<vtkImageData> image = table->Read();
  this->Judge(image,
    [](int i, int j)
    {
      const std::uint16_t* ab = vtkIBLBRDFTableTexels + 4 * (j * n + i);
      return reference::SplitSum{ ab[0] / 65535.0, ab[1] / 65535.0 };
    });
}

// Schlick-Smith is sampled, and against converged quadrature is as good. Mutant: k = alpha.
TEST_F(TestBRDFTableGL, SchlickSmithAgreesWithQuadrature)
{
  vtkNew<vtkIBLBRDFTable> table;
  table->SetGeometryTerm(vtkIBLBRDFTable::SchlickSmith);
  ASSERT_TRUE(table->Update(this->Window));
  vtkSmartPointer<vtkImageData> image = table->Read();
  this->Judge(image,
    [](int i, int j)
    {
      return reference::SplitSumAB(
        double(i) / (n - 1) * i / (n - 1), double(j) / (n - 1), reference::Geometry::SchlickSmith, 0.5);
    });
}

// With Schlick-Smith lobes are plain: along R, of the surface's roughness, all of it. Mutant: the fitted ones left in.
TEST_F(TestBRDFTableGL, SchlickSmithHasPlainLobes)
{
  vtkNew<vtkIBLBRDFTable> table;
  table->SetGeometryTerm(vtkIBLBRDFTable::SchlickSmith);
  ASSERT_TRUE(table->Update(this->Window));
  vtkSmartPointer<vtkImageData> image = table->Read();
  vtkIBLCore::ShaderFunctions<double> shader;
  for (int j = 0; j < n; j += 7)
  {
    const auto* reflection = static_cast<const float*>(image->GetScalarPointer(20, j, 0));
    const auto* lobes = static_cast<const float*>(image->GetScalarPointer(20, n + j, 0));
    for (int set : { 0, 1 })
    {
      EXPECT_EQ(reflection[2 + set], 0);
      EXPECT_EQ(lobes[2 * set], 1);
      EXPECT_NEAR(lobes[2 * set + 1], shader.iblLadderPosition(j / (n - 1.0)), 1e-5);
    }
  }
}

// What layers a scene needs is told by the narrowest lobe: the constant's, no narrower than half of the surface's, and
// the surface's own at the ladder's first layer and below; 5e-3, since 0.1 lies between two rows.
TEST_F(TestBRDFTableGL, KnowsTheNarrowestLobe)
{
  for (double r : { 0.0, 0.05, 0.1 })
  {
    EXPECT_NEAR(vtkIBLBRDFTable::GetNarrowestLobe(r), r, 5e-3) << r;
  }
  for (double r : { 0.15, 0.3, 0.77, 1.0 })
  {
    EXPECT_GE(vtkIBLBRDFTable::GetNarrowestLobe(r), std::max(0.1, 0.45 * r) - 1e-3) << r;
    EXPECT_LE(vtkIBLBRDFTable::GetNarrowestLobe(r), r) << r;
  }
}

// A white surface never reflects more than it gets, at every edge. Two roundings: 2e-5.
TEST_F(TestBRDFTableGL, NeverGainsEnergy)
{
  vtkNew<vtkIBLBRDFTable> table;
  ASSERT_TRUE(table->Update(this->Window));
  vtkSmartPointer<vtkImageData> image = table->Read();
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const RGB ab = GetTexel(image, i, j);
      EXPECT_GE(ab[0], 0);
      EXPECT_GE(ab[1], 0);
      EXPECT_LE(ab[0] + ab[1], 1 + 2e-5) << i << " " << j;
    }
  }
}

TEST_F(TestBRDFTableGL, BuildsOnce)
{
  vtkNew<vtkIBLBRDFTable> table;
  EXPECT_EQ(table->Read(), nullptr);
  EXPECT_NE(this->Messages.Take().find("not built"), std::string::npos);
  table->Update(this->Window);
  table->Update(this->Window);
  EXPECT_EQ(table->GetNumberOfBuilds(), 1);
  table->ReleaseGraphicsResources(this->Window);
  table->Update(this->Window);
  EXPECT_EQ(table->GetNumberOfBuilds(), 2);
}
