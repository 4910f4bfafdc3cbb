// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLCubeMap
 * @brief the environment's radiance as a cube map with solid-angle-weighted mip levels
 *
 * Every texel is the exact solid-angle-weighted mean of the environment's texels under it, and every mip level that of
 * the level before: energy is kept, there is no seam and no pole artefact. Stored as RGBA32F, down to 1x1.
 */
#ifndef vtkIBLCubeMap_h
#define vtkIBLCubeMap_h

#include "vtkIBLStage.h"
#include "vtkSmartPointer.h"

#include <memory> // For std::unique_ptr

class vtkIBLEnvironment;
class vtkImageData;
namespace vtkIBLGL
{
class Texture;
}

class VTKIBL_EXPORT vtkIBLCubeMap : public vtkIBLStage
{
public:
  static vtkIBLCubeMap* New();
  vtkTypeMacro(vtkIBLCubeMap, vtkIBLStage);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where the light comes from.
   */
  void SetEnvironment(vtkIBLEnvironment* environment);
  vtkIBLEnvironment* GetEnvironment() const;
  ///@}

  ///@{
  /**
   * Texels along a face's edge, rounded down to a power of two in [16, 4096]. 0, the default: as fine as the
   * environment (a quarter of a lat-long map's width), at most 512. Smaller blurs mirrors and a sharp background;
   * larger costs memory: 128 bytes per face edge squared.
   */
  vtkSetClampMacro(FaceSize, int, 0, 4096);
  vtkGetMacro(FaceSize, int);
  ///@}

  ///@{
  /**
   * Whether anybody samples the cube map, and so reads its mip levels: the sampled engine and vtkIBLLighting's
   * SamplesPerPixel. Default on; vtkIBLLighting turns it off where mirrors and the background are all.
   */
  vtkSetMacro(MipLevelsNeeded, bool);
  vtkGetMacro(MipLevelsNeeded, bool);
  ///@}

  ///@{
  /**
   * The output: face size and mip levels of the last build.
   */
  vtkGetMacro(OutputFaceSize, int);
  int GetNumberOfLevels() const;
  const vtkIBLGL::Texture& GetTexture() const;
  ///@}

  /**
   * Copies one mip level back from the GPU: n x n x 6 float RGB in GL's face order, row 0 at t = -1. Null when there is
   * no such level.
   */
  vtkSmartPointer<vtkImageData> ReadLevel(int level);

protected:
  vtkIBLCubeMap();
  ~vtkIBLCubeMap() override;

  bool UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime) override;
  vtkIBLStatistics* GetInputStatistics() const override;
  std::vector<vtkIBLStatistics::Work> Build(vtkOpenGLRenderWindow* window) override;
  void Release() override;

private:
  vtkIBLCubeMap(const vtkIBLCubeMap&) = delete;
  void operator=(const vtkIBLCubeMap&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
  vtkSmartPointer<vtkIBLEnvironment> Environment;
  int FaceSize = 0;
  bool MipLevelsNeeded = true;
  int OutputFaceSize = 0;
  int OutputLevels = 0;
};

#endif
