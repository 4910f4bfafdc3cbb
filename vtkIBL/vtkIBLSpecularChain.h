// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLSpecularChain
 * @brief smooth to matt: the environment seen through GGX lobes, one layer a roughness, and its irradiance
 *
 * Layer i holds, for every direction R, the mean of radiance under the GGX lobe of GetPerceptualRoughness(i) around N =
 * V = R, weighted by N.L (Karis 2013). Layer 0 is the mirror: the radiance cube map, not this stage's. Odd layers are
 * the mip levels of one RGBA16F cube map, even ones those of another, half as large, so that shading reads any
 * roughness with two bilinear fetches. The irradiance map is the lobe of roughness 1, the clamped cosine, once more,
 * finer: irradiance over pi. Values are radiance divided by the environment's mean luminance, at most 65504.
 *
 * Texels of the spectral engine are not samples but what comes closest when it is read bilinearly, and mixed between
 * layers: see SetFitReading().
 */
#ifndef vtkIBLSpecularChain_h
#define vtkIBLSpecularChain_h

#include "vtkIBLStage.h"
#include "vtkSmartPointer.h"

#include <memory> // For std::unique_ptr
#include <vector> // For std::vector

class vtkIBLCubeMap;
class vtkIBLEnvironment;
class vtkIBLSpectrum;
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
   * The stage to the left. The spectral engine takes the light from its environment, and leaves the cube map alone.
   */
  void SetCubeMap(vtkIBLCubeMap* cubeMap);
  vtkIBLCubeMap* GetCubeMap() const;
  ///@}

  enum Engines
  {
    Sampled, ///< sums and samples of the cube map, on the GPU: for any source
    Spectral ///< spherical harmonics and bright texels, on the CPU: for lat-long images, exact to 2e-4 from roughness
             ///< 0.12 up and to 2e-3 at 0.1
  };
  ///@{
  /**
   * What makes the layers. A cube environment is sampled either way. Default Spectral.
   */
  vtkSetClampMacro(Engine, int, Sampled, Spectral);
  vtkGetMacro(Engine, int);
  ///@}

  ///@{
  /**
   * How far what a shader reads may be from the lobe's integral: relative L1 error over all directions, at the worst
   * roughness from 0.1 up, in [0.002, 0.5]. Default 0.02. It chooses the ladder's FaceSize and with it the number of
   * layers: 10 at 256. Too large shows as reflections that sharpen and blur again while roughness grows, and as texels
   * in sharp highlights; small costs time and memory: four times of both for half the error.
   */
  vtkSetClampMacro(ErrorTolerance, double, 0.002, 0.5);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  ///@{
  /**
   * Texels along a face's edge of layer 1, rounded down to a power of two in [16, 1024]; 0, the default: what
   * ErrorTolerance asks for. Each further pair of layers has half of it, down to 8.
   */
  vtkSetClampMacro(FaceSize, int, 0, 1024);
  vtkGetMacro(FaceSize, int);
  ///@}

  ///@{
  /**
   * Samples a texel of the sharp layers, below roughness 0.4, that the sampled engine makes; in [16, 65536]. Default
   * 64: their mean relative error is 2 % on real HDRIs. Too few shows as blotches near bright lights; more costs time
   * in proportion.
   */
  vtkSetClampMacro(NumberOfSamples, int, 16, 65536);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * The spectral engine stores what, read bilinearly and mixed between two layers, lies closest to the light in the
   * mean: it halves the error of reading. Off: texels are the filtered light at their centres, as an export wants them.
   * Default on.
   */
  vtkSetMacro(FitReading, bool);
  vtkGetMacro(FitReading, bool);
  vtkBooleanMacro(FitReading, bool);
  ///@}

  ///@{
  /**
   * Leave the strongest lamps, at most eight, out of layers and irradiance map, for a shader that takes them as lights.
   * A lamp is what lies side by side of texels above 20 times the mean, within 0.05 rad, and has 2 % of all light or
   * more. Default off: all light is in the layers. The sampled engine has no lamps.
   */
  vtkSetMacro(LampsApart, bool);
  vtkGetMacro(LampsApart, bool);
  vtkBooleanMacro(LampsApart, bool);
  ///@}

  ///@{
  /**
   * What was left out, strongest first: unit direction in the environment's frame, and radiance times solid angle [sr];
   * returns the variance of direction along either tangent [rad^2]. All of it, and of what a cube map of 256^2 makes of
   * it, lies within the radius [rad].
   */
  int GetNumberOfLamps() const;
  int GetNumberOfSampledLamps() const; // with weaker ones behind them, which layers have and samples go to
  double GetLamp(int index, double direction[3], double power[3]) const;
  double GetLampRadius(int index) const;
  ///@}

  ///@{
  /**
   * The roughness that will be read, in [0, 1]; a minimum above the maximum: none. Layers outside are not made; when
   * the range grows, those that are missing are added. Default [0, 1]. And whether the irradiance map will be. Default
   * on.
   */
  void SetNeededRoughness(double minimum, double maximum);
  vtkGetVector2Macro(NeededRoughness, double);
  vtkSetMacro(IrradianceNeeded, bool);
  vtkGetMacro(IrradianceNeeded, bool);
  vtkBooleanMacro(IrradianceNeeded, bool);
  ///@}

  ///@{
  /**
   * The ladder after the last build: number of layers without the mirror, which perceptualRoughness a layer in [0,
   * GetNumberOfLayers()] is made for, its face size, and whether it is there.
   */
  int GetNumberOfLayers() const;
  double GetPerceptualRoughness(int layer) const;
  int GetLayerFaceSize(int layer) const;
  bool HasLayer(int layer) const;
  ///@}

  /**
   * Of layer 1: below it, reflections are mixed with the mirror's. 0.1.
   */
  static double GetFirstRoughness();

  ///@{
  /**
   * How many layers were made so far, over all builds that GetStatistics() has, the irradiance map among them; and by
   * the last build.
   */
  vtkTypeInt64 GetNumberOfLayersMade() const;
  vtkGetMacro(LastNumberOfLayersMade, int);
  ///@}

  /**
   * Texels and lights that the sampled engine read in the last build, one filtered fetch counted as one.
   */
  vtkGetMacro(NumberOfReads, vtkTypeInt64);

  /**
   * The error that was predicted for the layers as they stand, to compare with ErrorTolerance; it holds within a factor
   * of two. Negative when none can be: of the sampled engine.
   */
  double GetPredictedError() const;

  ///@{
  /**
   * The output: cube maps of layers 1, 3, 5 … and 2, 4, 6 …, the irradiance map, and what their values are multiplied
   * by to be radiance.
   */
  const vtkIBLGL::Texture& GetOddLayers() const;
  const vtkIBLGL::Texture& GetEvenLayers() const;
  const vtkIBLGL::Texture& GetIrradianceMap() const;
  double GetStoredScale() const;
  ///@}

  ///@{
  /**
   * Texels that the spectral engine took out of the environment before filtering, and gave back as exact lobes but for
   * lamps: unit direction in the environment's frame and radiance; returns the solid angle [sr]. None with the sampled
   * engine.
   */
  int GetNumberOfBrightTexels() const;
  double GetBrightTexel(int index, double direction[3], double radiance[3]) const;
  ///@}

  ///@{
  /**
   * Copies one layer, or the irradiance map over pi, back from the GPU, as radiance: n x n x 6 float RGB in GL's face
   * order, row 0 at t = -1. Null when there is none.
   */
  vtkSmartPointer<vtkImageData> ReadLayer(int layer);
  vtkSmartPointer<vtkImageData> ReadIrradianceMap();
  ///@}

protected:
  vtkIBLSpecularChain();
  ~vtkIBLSpecularChain() override;

  bool UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime) override;
  vtkIBLStatistics* GetInputStatistics() const override;
  std::vector<vtkIBLStatistics::Work> Build(vtkOpenGLRenderWindow* window) override;
  void Release() override;

private:
  vtkIBLSpecularChain(const vtkIBLSpecularChain&) = delete;
  void operator=(const vtkIBLSpecularChain&) = delete;

  bool IsSpectral() const;
  vtkSmartPointer<vtkImageData> Read(int layer); // 0: the irradiance map

  struct Internals;
  struct Layers;
  std::unique_ptr<Internals> Internal;
  vtkTypeInt64 MakeSpectral(Layers& out, const vtkIBLSpectrum& spectrum, const std::vector<int>& missing);
  vtkTypeInt64 MakeSampled(vtkOpenGLRenderWindow* window, Layers& out, const std::vector<int>& missing);

  vtkSmartPointer<vtkIBLCubeMap> CubeMap;
  int Engine = Spectral;
  double ErrorTolerance = 0.02;
  int FaceSize = 0;
  int NumberOfSamples = 64;
  bool FitReading = true;
  bool LampsApart = false;
  double NeededRoughness[2] = { 0.0, 1.0 };
  bool IrradianceNeeded = true;
  int LastNumberOfLayersMade = 0;
  vtkTypeInt64 NumberOfReads = 0;
};

#endif
