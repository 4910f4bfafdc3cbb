// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLRenderPass
 * @brief lights a renderer's PBR actors with an environment
 *
 *     vtkNew<vtkIBLEnvironment> environment;  environment->SetFileName("studio.exr");
 *     vtkNew<vtkIBLRenderPass> ibl;           ibl->SetEnvironment(environment);
 *     renderer->SetPass(ibl);
 *
 * Adds diffuse and specular environment light to actors whose interpolation is PBR, beside VTK's own direct lights,
 * textures, normal maps, emission, occlusion, scalar colours, opacity, depth peeling, clipping and picking, which stay
 * as they are. With no environment given, a built-in studio lights the scene. A scene without lights needs none: while
 * this pass renders, VTK makes no headlight of its own.
 *
 * Not VTK's: a mirrored actor, of negative scale, is lit on its outside, by all lights; VTK lights it from within.
 * VTK's, and a surprise: colours are linear albedo, so a matt surface of a map's colour c shows c^(1/2.2) in light of
 * 1; in VTK 9.1 only directional lights throw shadows on PBR surfaces.
 *
 * Other passes. Those that filter the picture (vtkSSAAPass, vtkOpenGLFXAAPass, vtkToneMappingPass, blurs) stand around
 * this one; those that draw the scene (vtkRenderStepsPass, shadows in a vtkCameraPass) are its DelegatePass;
 * vtkSSAOPass may be either. vtkToneMappingPass decodes what it gets: leave OutputEncoding at Display below it; its
 * framebuffer holds floats, so nothing is cut off at 1. A DelegatePass peels translucent surfaces only if it holds a
 * vtkDualDepthPeelingPass. Several renderers of one window may share one pass; windows share an environment, and have a
 * pass each.
 *
 * Leave vtkRenderer's UseImageBasedLighting off, or the actors get the environment twice.
 *
 * With vtkIBLLighting's SamplesPerPixel above 0, a scene at rest converges: each further Render() of the window adds as
 * many samples, and the picture is the mean of all. Nothing renders by itself; call Render() again to refine. Whatever
 * changes the picture starts anew, as far as GetMTime() tells; else (uniforms that an observer sets, say) Modified() of
 * this pass does. Renderers that draw over another's picture, and passes inside another pass, don't accumulate.
 *
 * Needs OpenGL 4.5. Where there is less, one error says so, and the scene shows with VTK's own lights.
 */
#ifndef vtkIBLRenderPass_h
#define vtkIBLRenderPass_h

#include "vtkIBLModule.h" // For export macro
#include "vtkNew.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkSmartPointer.h"

#include <memory> // For std::unique_ptr
#include <vector> // For std::vector

class vtkIBLAccumulation;
class vtkIBLBackground;
class vtkIBLEnvironment;
class vtkIBLLighting;
class vtkIBLProbe;
class vtkIBLProbeCollection;
class vtkIBLProbeDisplay;
class vtkIBLProbeLight;
class vtkIBLStamp;
class vtkImageData;
class vtkLight;

class VTKIBL_EXPORT vtkIBLRenderPass : public vtkOpenGLRenderPass
{
public:
  static vtkIBLRenderPass* New();
  vtkTypeMacro(vtkIBLRenderPass, vtkOpenGLRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The light. Default, and after null: a vtkIBLEnvironment with the built-in studio.
   */
  void SetEnvironment(vtkIBLEnvironment* environment);
  vtkIBLEnvironment* GetEnvironment();
  ///@}

  /**
   * The stages behind the picture, with their settings and what they cost.
   */
  vtkIBLLighting* GetLighting();

  /**
   * Local light: what is in here lights surfaces around it, instead of the environment. See vtkIBLProbe.
   */
  vtkIBLProbeCollection* GetProbes();

  enum ProbeDisplays
  {
    ProbesHidden,
    ProbeReflections, ///< metal balls of ProbeDisplayRoughness
    ProbeIrradiance,  ///< matt white balls
    ProbeShares ///< surfaces in the colours of the probes that light them, mixed by their shares; the sky's is grey
  };
  ///@{
  /**
   * Draws a ball at each probe's place, lit as any surface there, with its proxy in light wires and its influence in
   * dark ones; to look for faults. Default ProbesHidden. And the balls' roughness, in [0, 1]; default 0, mirrors.
   */
  void SetProbeDisplay(int display);
  vtkGetMacro(ProbeDisplay, int);
  vtkSetClampMacro(ProbeDisplayRoughness, double, 0.0, 1.0);
  vtkGetMacro(ProbeDisplayRoughness, double);
  ///@}

  /**
   * Captures a probe of `renderer`'s scene, which is then rendered once, and returns what it sees: n x n x 6 float RGB,
   * radiance, GL's faces, row 0 at t = -1, axes the world's. `renderer`'s pass must be this one, and the probe in
   * GetProbes(). Null, with an error, when that fails.
   */
  vtkSmartPointer<vtkImageData> CaptureProbe(vtkRenderer* renderer, vtkIBLProbe* probe);

  ///@{
  /**
   * Show the environment behind the scene. Default off: the renderer's own background. Lighting is the same either way.
   */
  vtkSetMacro(BackgroundVisible, bool);
  vtkGetMacro(BackgroundVisible, bool);
  vtkBooleanMacro(BackgroundVisible, bool);
  ///@}

  ///@{
  /**
   * How blurred that background is, in [0, 1]: as a mirror of that perceptualRoughness shows it. Default 0, sharp.
   */
  vtkSetClampMacro(BackgroundBlur, double, 0.0, 1.0);
  vtkGetMacro(BackgroundBlur, double);
  ///@}

  enum OutputEncodings
  {
    Display, ///< VTK's own: PBR surfaces end with the power 1/2.2; what a screen expects. The default.
    Linear   ///< radiance as it is: for float framebuffers, tone mapping, measurement
  };
  ///@{
  /**
   * What numbers lit surfaces and the background write.
   */
  void SetOutputEncoding(int encoding);
  vtkGetMacro(OutputEncoding, int);
  ///@}

  ///@{
  /**
   * Light actors of flat, Gouraud and Phong interpolation, too: a matt surface of their colour, taken as the screen's,
   * that is as glossy as their specular colour (f0 = 0.08 of it) and power say (perceptualRoughness = (2/(n+2))^(1/4)).
   * In a white room of radiance 1, or under NormalizeExposure in the mean, a surface shows its own colour: colour maps
   * stay true. Default off: they are as VTK shades them.
   */
  void SetLightNonPBR(bool on);
  vtkGetMacro(LightNonPBR, bool);
  vtkBooleanMacro(LightNonPBR, bool);
  ///@}

  ///@{
  /**
   * Reflections stay as strong as they are on surfaces of opacity below 1, which become more opaque towards their
   * edges, as glass does. Default off: all is blended by the opacity.
   */
  void SetTranslucentFresnel(bool on);
  vtkGetMacro(TranslucentFresnel, bool);
  vtkBooleanMacro(TranslucentFresnel, bool);
  ///@}

  ///@{
  /**
   * A texture's ambient occlusion hides VTK's own lights, too, as it does without this pass. Default on. Off: it hides
   * the environment only, which is what it was made for.
   */
  void SetDirectOcclusion(bool on);
  vtkGetMacro(DirectOcclusion, bool);
  vtkBooleanMacro(DirectOcclusion, bool);
  ///@}

  ///@{
  /**
   * The pass that draws the scene, vtkSSAOPass or a vtkRenderStepsPass, say. Null, the default: as a renderer without a
   * pass draws.
   */
  void SetDelegatePass(vtkRenderPass* pass);
  vtkRenderPass* GetDelegatePass();
  ///@}

  /**
   * Samples a pixel in the last picture, at most 65536: then frames add no more, and cost a copy. 0 when it was not
   * sampled.
   */
  vtkGetMacro(AccumulatedSamples, int);

  /**
   * Renders `renderer`'s window once, through a float framebuffer and with linear encoding, and returns what `renderer`
   * shows: width x height x 1 float RGBA, row 0 at the bottom. `renderer`'s pass must be this one. When sampled, each
   * call adds a frame to the mean of linear pictures, beside which the mean of display-encoded ones is left alone.
   */
  vtkSmartPointer<vtkImageData> CaptureRadiance(vtkRenderer* renderer);

  /**
   * Draws the environment behind a picture that `renderer` shows already, as far as its alpha leaves room: where
   * BackgroundVisible comes too early, as for one that is composited of others'. From an observer of the renderer's
   * EndEvent, say; cleared to black of alpha 0, translucent surfaces peeled. Returns whether it could.
   */
  bool RenderBackgroundBehind(vtkRenderer* renderer);

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /**
   * vtkOpenGLRenderPass's hooks: the environment's term goes into the fragment shaders of lit PBR actors.
   */
  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader,
    vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* VAO = nullptr) override;
  vtkMTimeType GetShaderStageMTime() override;
  ///@}

protected:
  vtkIBLRenderPass();
  ~vtkIBLRenderPass() override;

private:
  vtkIBLRenderPass(const vtkIBLRenderPass&) = delete;
  void operator=(const vtkIBLRenderPass&) = delete;

  void RenderScene(const vtkRenderState* state);
  void DrawScene(const vtkRenderState* state);
  bool AnyProbeCaptures();
  void UpdateProbes(const vtkRenderState* state, const std::vector<vtkProp*>& captured);
  void DrawCapture(vtkRenderer* renderer, int size, const std::vector<vtkProp*>& props);
  void SetUpBackground();
  bool Accumulates(const vtkRenderState* state) const;
  vtkIBLStamp GetStamp(const vtkRenderState* state);

  template <typename T>
  void SetShaderOption(T& option, T value);
  void SetShaderState(bool& state, bool value);

  vtkNew<vtkIBLLighting> Lighting;
  vtkNew<vtkIBLProbeCollection> Probes;
  std::unique_ptr<vtkIBLProbeLight> ProbeLight;
  vtkNew<vtkIBLBackground> Background;
  vtkNew<vtkLight> NoLight;
  vtkSmartPointer<vtkRenderPass> DelegatePass;
  bool BackgroundVisible = false;
  double BackgroundBlur = 0.0;
  int OutputEncoding = Display;
  bool LightNonPBR = false;
  bool TranslucentFresnel = false;
  bool DirectOcclusion = true;
  bool Lit = false;                // there is light to add in this frame
  bool WithoutLights = false;      // nor any light but this pass's own
  bool ParallelProjection = false; // and how it is seen
  bool RigidView = false;
  vtkRenderer* Renderer = nullptr;                      // while Render runs
  vtkTimeStamp ShaderTime;                              // when the GLSL that the hooks write last changed
  std::unique_ptr<vtkIBLAccumulation> Accumulations[2]; // by OutputEncoding
  int AccumulatedSamples = 0;
  int FirstSample = 0; // of this frame, in the mean
  std::unique_ptr<vtkIBLProbeDisplay> ShownProbes;
  int ProbeDisplay = ProbesHidden;
  double ProbeDisplayRoughness = 0.0;
  bool CapturesProbe = false;             // what is drawn now is for a probe...
  bool IsLitByProbes = true;              // ... that shows what probes light, or not yet
  vtkRenderer* Capturing = nullptr;       // while CaptureRadiance() runs: of this renderer...
  vtkSmartPointer<vtkImageData> Captured; // ... the picture
};

#endif
