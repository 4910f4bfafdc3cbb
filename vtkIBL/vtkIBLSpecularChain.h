// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLSpecularChain
 * @brief mirror to matt: the environment seen through GGX lobes, one layer a roughness
 *
 * Layer i holds, for every direction R, the mean of radiance under the GGX lobe of GetPerceptualRoughness(i) around N =
 * V = R, weighted by N.L (Karis 2013). Layers alternate between two RGBA16F cube maps of equal size, so that each mip
 * level of each holds one layer, and shading reads any roughness with two bilinear fetches. Values are radiance divided
 * by the environment's mean luminance, at most 65504.
 */
#ifndef vtkIBLSpecularChain_h
#define vtkIBLSpecularChain_h

#include "vtkIBLStage.h"
#include "vtkSmartPointer.h"

#include <memory> // For std::unique_ptr

class vtkIBLCubeMap;
class vtkImageData;
namespace vtkIBLGL
{
class Texture;
}

class VTKIBL_EXPORT vtkIBLSpecularChain : public vtkIBLStage
{
public:
  static vtkIBLSpecularChain* New();
  vtkTypeMacro(vtkIBLSpecularChain, vtkIBLStage);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The stage to the left.
   */
  void SetCubeMap(vtkIBLCubeMap* cubeMap);
  vtkIBLCubeMap* GetCubeMap() const;
  ///@}

  enum Engines
  {
    Sampled, ///< filtered importance sampling of the cube map, on the GPU: for any source
    Spectral ///< spherical harmonics and bright texels, on the CPU: for lat-long images, and exact to 1e-4
  };
  ///@{
  /**
   * What makes the layers. Spectral makes those from roughness 0.17 up, and needs a lat-long environment; sharper
   * layers, and all of a cube environment's, are sampled either way. Default Spectral.
   */
  vtkSetClampMacro(Engine, int, Sampled, Spectral);
  vtkGetMacro(Engine, int);
  ///@}

  ///@{
  /**
   * Samples a texel at roughness 1, in [16, 65536]; sharper layers take fewer, as their lobes are narrower. Default
   * 512. Too few shows as blotches near bright lights; more costs time in proportion.
   */
  vtkSetClampMacro(NumberOfSamples, int, 16, 65536);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * Texels along a face's edge of the sharpest layer, rounded down to a power of two in [256, 2048]; the roughest has a
   * sixteenth. Default 256. Larger sharpens mirrors.
   */
  vtkSetClampMacro(FaceSize, int, 256, 2048);
  vtkGetMacro(FaceSize, int);
  ///@}

  ///@{
  /**
   * The ladder: how many layers, which perceptualRoughness a layer is made for, and its face size after the last build.
   */
  static int GetNumberOfLayers();
  static double GetPerceptualRoughness(int layer);
  int GetLayerFaceSize(int layer) const;
  ///@}

  ///@{
  /**
   * The output: the cube map of layers 0, 2, 4 … and that of 1, 3, 5 …, and what their values are multiplied by to be
   * radiance.
   */
  const vtkIBLGL::Texture& GetEvenLayers() const;
  const vtkIBLGL::Texture& GetOddLayers() const;
  double GetStoredScale() const { return this->StoredScale; }
  ///@}

  ///@{
  /**
   * Texels that the spectral engine took out of the environment before filtering, and gave back as exact lobes: unit
   * direction in the environment's frame and radiance; returns the solid angle [sr]. None with the sampled engine.
   */
  int GetNumberOfBrightTexels() const;
  double GetBrightTexel(int index, double direction[3], double radiance[3]) const;
  ///@}

  /**
   * Copies one layer back from the GPU, as radiance: n x n x 6 float RGB in GL's face order, row 0 at t = -1. Null when
   * there is none.
   */
  vtkSmartPointer<vtkImageData> ReadLayer(int layer);

protected:
  vtkIBLSpecularChain();
  ~vtkIBLSpecularChain() override;

  bool UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime) override;
  vtkTypeInt64 Build(vtkOpenGLRenderWindow* window) override;
  void Release() override;

private:
  vtkIBLSpecularChain(const vtkIBLSpecularChain&) = delete;
  void operator=(const vtkIBLSpecularChain&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
  vtkSmartPointer<vtkIBLCubeMap> CubeMap;
  vtkTypeInt64 BuildSpectralLayers(vtkIBLGL::Texture* chains, int faceSize, double storedScale, int& firstLayer);

  int Engine = Spectral;
  int NumberOfSamples = 512;
  int FaceSize = 256;
  int OutputFaceSize = 0;
  double StoredScale = 1.0;
};

#endif
