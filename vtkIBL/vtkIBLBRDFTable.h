// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLBRDFTable
 * @brief the split sum's second factor: what share of light a surface reflects, by angle and roughness
 *
 * Texel (i, j) holds (A, B) with  reflectance = f0 A + f90 B  for Schlick's Fresnel term, at NoV = (i/(n-1))^2 and
 * perceptualRoughness = j/(n-1): sqrt(NoV) across, outer texel centres on the domain's edges (Karis 2013). Needs no
 * input at all: by default it is a constant of the library, integrated when that was built, in 16 bits a channel (4e-6
 * rms; read between texels, 1e-4 rms over NoV and perceptualRoughness).
 */
#ifndef vtkIBLBRDFTable_h
#define vtkIBLBRDFTable_h

#include "vtkIBLStage.h"
#include "vtkSmartPointer.h"

#include <memory> // For std::unique_ptr

class vtkImageData;
namespace vtkIBLGL
{
class Texture;
}

class VTKIBL_EXPORT vtkIBLBRDFTable : public vtkIBLStage
{
public:
  static vtkIBLBRDFTable* New();
  vtkTypeMacro(vtkIBLBRDFTable, vtkIBLStage);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum GeometryTerms
  {
    SmithCorrelated, ///< height-correlated Smith (Heitz 2014): the physically right one, and the default
    SchlickSmith     ///< Schlick's approximation with k = alpha/2 (Karis 2013): to match other real-time renderers
  };
  ///@{
  /**
   * How microfacets shadow each other. Default SmithCorrelated.
   */
  vtkSetClampMacro(GeometryTerm, int, SmithCorrelated, SchlickSmith);
  vtkGetMacro(GeometryTerm, int);
  ///@}

  ///@{
  /**
   * 0, the default: SmithCorrelated is the built-in constant, and SchlickSmith takes 1024 samples a texel. Above:
   * samples a texel, on the GPU, for either, up to 65536. Too few shows as bands along NoV; 1024 leave 2e-4 rms.
   */
  vtkSetClampMacro(NumberOfSamples, int, 0, 65536);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * The output, Size x Size.
   */
  static constexpr int Size = 64;
  const vtkIBLGL::Texture& GetTexture() const;
  ///@}

  /**
   * Copies the table back from the GPU: Size x Size float RGB, (A, B, 0). Null before the first Update().
   */
  vtkSmartPointer<vtkImageData> Read();

protected:
  vtkIBLBRDFTable();
  ~vtkIBLBRDFTable() override;

  bool UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime) override;
  std::vector<vtkIBLStatistics::Work> Build(vtkOpenGLRenderWindow* window) override;
  void Release() override;

private:
  vtkIBLBRDFTable(const vtkIBLBRDFTable&) = delete;
  void operator=(const vtkIBLBRDFTable&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
  void Sample(vtkOpenGLRenderWindow* window, const vtkIBLGL::Texture& table);

  int GeometryTerm = SmithCorrelated;
  int NumberOfSamples = 0;
};

#endif
