// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLBRDFTable
 * @brief the split sum's second factor, and the lobes of its first: what a surface reflects, by angle and roughness
 *
 * Two blocks, one above the other, of Size x Size texels. Texel (i, j) of each is at NoV = (i/(n-1))^2 and
 * perceptualRoughness = j/(n-1): sqrt(NoV) across, outer texel centres on the domain's edges (Karis 2013).
 *
 *     lower  A, B, and the diffuse share of the white lobe (f0 = 1) and of the dielectric one (f0 = 0.04)
 *     upper  bend and perceptualRoughness of the white lobe, and of the dielectric one, roughness as a position on the
 *            ladder of layers (iblLadderPosition)
 *
 * Reflectance is f0 A + f90 B for Schlick's Fresnel term. What is reflected is (1 - share) of the prefiltered radiance
 * of that perceptualRoughness around (1 - bend) N + bend R, and the share of irradiance / pi: the lobes that lie
 * closest to the surface's own, for light as it is in nature (docs/derivations/fitted-lobes.md).
 *
 * Needs no input at all: by default it is a constant of the library, integrated and fitted when that was built, in 16
 * bits a channel (A and B: 4e-6 rms; read between texels, 1e-4 rms over NoV and perceptualRoughness).
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
    SchlickSmith ///< Schlick's approximation with k = alpha/2, and plain lobes: along R, of the surface's roughness,
                 ///< and no diffuse share (Karis 2013): to match other real-time renderers
  };
  ///@{
  /**
   * How microfacets shadow each other, and with it the lobes. Default SmithCorrelated.
   */
  vtkSetClampMacro(GeometryTerm, int, SmithCorrelated, SchlickSmith);
  vtkGetMacro(GeometryTerm, int);
  ///@}

  ///@{
  /**
   * 0, the default: SmithCorrelated is the built-in constant, and SchlickSmith takes 1024 samples a texel. Above:
   * samples a texel, on the GPU, for A and B of either, up to 65536. Too few shows as bands along NoV; 1024 leave 2e-4
   * rms.
   */
  vtkSetClampMacro(NumberOfSamples, int, 0, 65536);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * The output, Size x 2 Size.
   */
  static constexpr int Size = 64;
  const vtkIBLGL::Texture& GetTexture() const;
  ///@}

  /**
   * Copies the table back from the GPU: Size x 2 Size float RGBA. Null before the first Update().
   */
  vtkSmartPointer<vtkImageData> Read();

  /**
   * The least perceptualRoughness that the fitted lobes of a surface of perceptualRoughness have, at any angle and f0.
   */
  static double GetNarrowestLobe(double perceptualRoughness);

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
