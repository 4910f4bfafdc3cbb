// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLLighting
 * @brief an environment's light, ready for shading: the stages of the pipeline and how a shader reads them
 *
 * Owns one cube map, specular chain and BRDF table, brings them up to date for a window, and hands them to
 * shader programs. What the stages cost can be read from them.
 */
#ifndef vtkIBLLighting_h
#define vtkIBLLighting_h

#include "vtkIBLModule.h" // For export macro
#include "vtkIBLSceneNeeds.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkIBLBRDFTable;
class vtkIBLCubeMap;
class vtkIBLEnvironment;
class vtkIBLSpecularChain;
class vtkIBLStatistics;
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkShaderProgram;
class vtkWindow;
namespace vtkIBLGL
{
class Program;
}

class VTKIBL_EXPORT vtkIBLLighting : public vtkObject
{
public:
  static vtkIBLLighting* New();
  vtkTypeMacro(vtkIBLLighting, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The light. Default: a new vtkIBLEnvironment, the built-in studio. Never null: setting null goes back to that.
   */
  void SetEnvironment(vtkIBLEnvironment* environment);
  vtkIBLEnvironment* GetEnvironment() const;
  ///@}

  ///@{
  /**
   * The stages, to set them up or to read what they made.
   */
  vtkIBLCubeMap* GetCubeMap() const;
  vtkIBLSpecularChain* GetSpecularChain() const;
  vtkIBLBRDFTable* GetBRDFTable() const;
  ///@}

  /**
   * What Update() did so far: in these stages and, for them, in the environment. What others made that environment do
   * is in its own statistics.
   */
  vtkIBLStatistics* GetStatistics() const;

  ///@{
  /**
   * Give back the light that rough surfaces lose in a single-scattering model (Fdez-Aguera 2019): white stays white at
   * any roughness. Default on. Off is the plain split sum, in which a white metal of roughness 1 reflects 31 % at
   * normal incidence.
   */
  vtkSetMacro(EnergyCompensation, bool);
  vtkGetMacro(EnergyCompensation, bool);
  vtkBooleanMacro(EnergyCompensation, bool);
  ///@}

  ///@{
  /**
   * 0, the default: shade by prefiltered layers and the table, at a handful of texture reads a pixel. Above: estimate
   * the reflection integral itself with so many samples a pixel, read from the cube map: slow, and what the fast form
   * is judged by; 1024 leave about 1 %. At most 65536. Takes effect with the next frame.
   */
  void SetSamplesPerPixel(int samples);
  vtkGetMacro(SamplesPerPixel, int);
  ///@}

  ///@{
  /**
   * Brings up to date in `window` what a scene needs, by default everything. Returns whether there is light to shade
   * with, be it an older one. Needs add up while the light stays the same.
   */
  bool Update(vtkOpenGLRenderWindow* window);
  bool Update(vtkOpenGLRenderWindow* window, const vtkIBLSceneNeeds& needs);
  ///@}

  ///@{
  /**
   * Between these two the textures are bound to units of their own, and SetShaderParameters() gives a program that
   * contains GetShaderChunk() all it needs to shade what `renderer`'s camera sees.
   */
  void Activate(vtkOpenGLRenderWindow* window);
  void Deactivate();
  void SetShaderParameters(vtkShaderProgram* program, vtkRenderer* renderer);
  void SetLayerParameters(const vtkIBLGL::Program& program) const; // what vtkIBLLayers.glsl takes
  ///@}

  ///@{
  /**
   * GLSL 1.50 whose global names all begin with ibl, and which defines
   *
   *     vec3 iblEnvironmentLight(vec3 normalVC, vec3 positionVC, vec3 albedo, float perceptualRoughness, float
   * metallic, float baseF0, vec3 edgeTint)
   *
   * the radiance that a surface sends to the camera; and when that text last changed.
   */
  std::string GetShaderChunk() const;
  vtkMTimeType GetShaderTime() const { return this->ShaderTime.GetMTime(); }
  ///@}

  /**
   * Drops all GL objects.
   */
  void ReleaseGraphicsResources(vtkWindow* window);

  /**
   * Rotation from `renderer`'s view space to the environment's, row by row.
   */
  void GetEnvironmentFromView(vtkRenderer* renderer, float rows[9]);

protected:
  vtkIBLLighting();
  ~vtkIBLLighting() override;

private:
  vtkIBLLighting(const vtkIBLLighting&) = delete;
  void operator=(const vtkIBLLighting&) = delete;

  bool UpdateStages(vtkOpenGLRenderWindow* window, const vtkIBLSceneNeeds& needs);

  struct Bindings;
  std::unique_ptr<Bindings> Bound;
  vtkNew<vtkIBLStatistics> Statistics;
  vtkNew<vtkIBLCubeMap> CubeMap;
  vtkNew<vtkIBLSpecularChain> SpecularChain;
  vtkNew<vtkIBLBRDFTable> BRDFTable;
  bool EnergyCompensation = true;
  int SamplesPerPixel = 0;
  vtkTimeStamp ShaderTime;
  vtkIBLSceneNeeds Needs; // since the light is what it is
  vtkMTimeType NeedsTime = 0;
};

#endif
