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
#include "vtkSmartPointer.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string
#include <vector> // For std::vector

class vtkIBLBRDFTable;
class vtkIBLCubeMap;
class vtkIBLEnvironment;
class vtkIBLSpecularChain;
class vtkIBLStatistics;
class vtkLight;
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

  enum ReflectionModels
  {
    Physical, ///< GGX, height-correlated Smith, Schlick, by lobes fitted to theirs
    Classic   ///< as other real-time renderers have it: Schlick-Smith with k = alpha/2, along the mirror direction, and
            ///< a Fresnel term of the normal's angle, dampened by roughness. To match their pictures; 2 to 3 times the
            ///< error
  };
  ///@{
  /**
   * What surfaces do with light. Default Physical.
   */
  void SetReflectionModel(int model);
  vtkGetMacro(ReflectionModel, int);
  ///@}

  ///@{
  /**
   * Give back the light that rough surfaces lose in a single-scattering model (Fdez-Aguera 2019): white stays white at
   * any roughness, for metals, dielectrics and mixtures. Default on. Off is the plain integral of GGX over a matt base
   * under Schlick's term, in which a white metal of roughness 1 reflects 31 % at normal incidence. Classic has it
   * always.
   */
  vtkSetMacro(EnergyCompensation, bool);
  vtkGetMacro(EnergyCompensation, bool);
  vtkBooleanMacro(EnergyCompensation, bool);
  ///@}

  ///@{
  /**
   * Shade the strongest lamps of the environment, at most eight, exactly: the sun, windows, bulbs. Default on: for a
   * light more a lamp it halves the error of metals where there is a sun. Off: they are in the layers, as all else.
   */
  vtkSetMacro(BrightTexels, bool);
  vtkGetMacro(BrightTexels, bool);
  vtkBooleanMacro(BrightTexels, bool);
  ///@}

  ///@{
  /**
   * A directional light that shines as the environment's strongest lamp does, at its present rotation, intensity and
   * tint, so that VTK's shadow passes can use it; add it to a renderer. From then on SunInEnvironment is off: surfaces
   * get that lamp from nowhere else. (Mirrors and the background still show it.) Null, with a warning, where the
   * environment, as of the last Update(), has no lamp.
   */
  vtkSmartPointer<vtkLight> CreateSunLight();
  vtkSetMacro(SunInEnvironment, bool);
  vtkGetMacro(SunInEnvironment, bool);
  vtkBooleanMacro(SunInEnvironment, bool);
  ///@}

  ///@{
  /**
   * Ambient occlusion hides a reflection as much as it hides the directions that the reflection comes from (Lagarde &
   * de Rousiers 2014). Default on. Off: as much as diffuse light.
   */
  vtkSetMacro(SpecularOcclusion, bool);
  vtkGetMacro(SpecularOcclusion, bool);
  vtkBooleanMacro(SpecularOcclusion, bool);
  ///@}

  ///@{
  /**
   * On surfaces with a normal map, reflections that would come from below the surface itself fade out. Default on.
   */
  vtkSetMacro(HorizonOcclusion, bool);
  vtkGetMacro(HorizonOcclusion, bool);
  vtkBooleanMacro(HorizonOcclusion, bool);
  ///@}

  ///@{
  /**
   * 0, the default: shade by prefiltered layers and the table, at a handful of texture reads a pixel. Above: estimate
   * the reflection integral itself with so many samples a pixel of the surface's density, and twice as many of the
   * lamps', read from the cube map: slow, and what the fast form is judged by. At most 8192 (llvmpipe ends a shader's
   * loops after 65535 turns in all); vtkIBLRenderPass adds as many with every frame of a scene at rest. Takes effect
   * with the next frame.
   */
  vtkSetClampMacro(SamplesPerPixel, int, 0, 8192);
  vtkGetMacro(SamplesPerPixel, int);
  ///@}

  ///@{
  /**
   * Whether GetShaderChunk() reads local probes, too, whose numbers vtkIBLRenderPass sets. Default off.
   */
  vtkSetMacro(ReadsProbes, bool);
  vtkGetMacro(ReadsProbes, bool);
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
   * contains GetShaderChunk() all it needs to shade what `renderer`'s camera sees. `firstSample`, in [0, 65536): where
   * in the sequence of a pixel's samples this frame goes on; it changes nothing where SamplesPerPixel is 0.
   */
  void Activate(vtkOpenGLRenderWindow* window);
  void Deactivate();
  void SetShaderParameters(vtkShaderProgram* program, vtkRenderer* renderer, int firstSample = 0);
  void SetLayerParameters(const vtkIBLGL::Program& program) const; // what vtkIBLLayers.glsl takes
  void SetLampParameters(const vtkIBLGL::Program& program, double perceptualRoughness) const; // and vtkIBLBackgroundFS
  ///@}

  ///@{
  /**
   * GLSL 1.50 whose global names all begin with ibl, with what shaders/vtkIBLSurface.glsl has, and among it
   *
   *     iblOutgoing iblEnvironmentLight(iblMaterial material, vec3 positionVC)
   *
   * the radiance that a surface sends to the camera. `features` are names of that file to define, IBL_COAT, say. And
   * when the text last changed. As of the last Update(): it reads the mirror only if that was needed since the light is
   * what it is, and does the work of metals and dielectrics only if there were some.
   */
  std::string GetShaderChunk(const std::vector<std::string>& features = {}) const;
  vtkMTimeType GetShaderTime() const { return this->ShaderTime.GetMTime(); }
  ///@}

  /**
   * Drops all GL objects.
   */
  void ReleaseGraphicsResources(vtkWindow* window);

  /**
   * Rotation from `renderer`'s view space to the environment's, column by column, as OpenGL takes it; the first has the
   * length 1.
   */
  void GetEnvironmentFromView(vtkRenderer* renderer, float columns[9]);

  /**
   * Whether that is a rotation; a camera's user transform may scale or mirror. Then its shaders may have IBL_RIGID_VIEW
   * among their features, which is faster.
   */
  bool IsViewRigid(vtkRenderer* renderer);

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
  void UpdateShaderText();
  void SetLamps(vtkShaderProgram* program, const float environmentFromView[9]);
  bool IsTinted() const;
  int GetLampsEnd() const;
  int GetFirstLamp() const { return this->SunInEnvironment ? 0 : 1; }
  int ReflectionModel = Physical;
  bool EnergyCompensation = true;
  bool BrightTexels = true;
  bool SunInEnvironment = true;
  bool SpecularOcclusion = true;
  bool HorizonOcclusion = true;
  bool ReadsProbes = false;
  int SamplesPerPixel = 0;
  std::string ShaderDefines; // as of the last Update(), and the file under them
  std::string ShaderText;
  vtkTimeStamp ShaderTime;
  vtkIBLSceneNeeds Needs; // since the light is what it is
  vtkMTimeType NeedsTime = 0;
};

#endif
