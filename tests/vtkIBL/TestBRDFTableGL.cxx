// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestSupport.h"

#include "vtkIBLBRDFTable.h"

namespace reference = vtkIBLReference;

class TestBRDFTableGL : public GLTest
{
};

// Both geometry terms against converged quadrature. 1024 points of the visible normals were measured at 2.0e-4
// rms, 1.2e-3 at worst. Mutants: roughness for alpha, axes swapped, k = alpha, NoV for sqrt(NoV),
// uncorrelated Smith (0.02).
TEST_F(TestBRDFTableGL, AgreesWithQuadrature)
{
  constexpr int n = vtkIBLBRDFTable::Size;
  vtkNew<vtkIBLBRDFTable> table;
  for (auto [term, geometry] : { std::pair{ vtkIBLBRDFTable::SmithCorrelated, reference::Geometry::SmithCorrelated },
         { vtkIBLBRDFTable::SchlickSmith, reference::Geometry::SchlickSmith } })
  {
    table->SetGeometryTerm(term);
    ASSERT_TRUE(table->Update(this->Window));
    vtkSmartPointer<vtkImageData> image = table->Read();
    double squares = 0;
    double worst = 0;
    int count = 0;
    for (int j = 1; j < n; j += 3) // roughness 0 has its own test
    {
      for (int i = 1; i < n; i += 3)
      {
        const double root = double(i) / (n - 1);
        const reference::SplitSum truth = reference::SplitSumAB(root * root, double(j) / (n - 1), geometry, 0.5);
        const RGB ab = GetTexel(image, i, j);
        for (double error : { ab[0] - truth.A, ab[1] - truth.B })
        {
          squares += error * error;
          worst = std::max(worst, std::abs(error));
          ++count;
        }
      }
    }
    std::printf("geometry term %d: rms %.1e, worst %.1e\n", term, std::sqrt(squares / count), worst);
    EXPECT_LT(std::sqrt(squares / count), 3e-4);
    EXPECT_LT(worst, 2e-3);
  }
}

// A mirror: V = H = N's reflection, so B = (1 - NoV)^5 and A = 1 - B. Float: 1e-4 (alpha is at least 1e-4).
TEST_F(TestBRDFTableGL, OfAMirrorIsFresnel)
{
  constexpr int n = vtkIBLBRDFTable::Size;
  vtkNew<vtkIBLBRDFTable> table;
  ASSERT_TRUE(table->Update(this->Window));
  vtkSmartPointer<vtkImageData> image = table->Read();
  for (int i = 1; i < n; ++i)
  {
    const double NoV = double(i) / (n - 1) * i / (n - 1);
    const double grazing = std::pow(1 - NoV, 5);
    EXPECT_NEAR(GetTexel(image, i, 0)[0], 1 - grazing, 1e-3) << "NoV " << NoV;
    EXPECT_NEAR(GetTexel(image, i, 0)[1], grazing, 1e-3) << "NoV " << NoV;
  }
}

// A white surface never reflects more than it gets, and the table is finite at every edge. 1e-3: sampling.
TEST_F(TestBRDFTableGL, NeverGainsEnergy)
{
  vtkNew<vtkIBLBRDFTable> table;
  ASSERT_TRUE(table->Update(this->Window));
  vtkSmartPointer<vtkImageData> image = table->Read();
  for (int j = 0; j < vtkIBLBRDFTable::Size; ++j)
  {
    for (int i = 0; i < vtkIBLBRDFTable::Size; ++i)
    {
      const RGB ab = GetTexel(image, i, j);
      EXPECT_GE(ab[0], 0);
      EXPECT_GE(ab[1], 0);
      EXPECT_LE(ab[0] + ab[1], 1 + 1e-3) << i << " " << j;
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
