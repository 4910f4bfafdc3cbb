// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLRenderView
 * @brief ParaView's render view, with surfaces lit by an environment
 *
 * Puts a vtkIBLRenderPass where vtkPVRenderView draws its scene; all else of that view stays. The light is, in this
 * order: that of EnvironmentFileName; the texture of ParaView's own skybox, where that is to light the scene; a
 * built-in studio.
 *
 * The client reads the file, or rank 0 of pvbatch does, as it is with ParaView's textures. In a session of several
 * processes its pixels go to all that render, each of which makes its light of them.
 *
 * A probe in the scene lets its surfaces see each other, in a process that draws all of it: ranks that draw a piece
 * each would each see their own.
 */
#ifndef vtkIBLRenderView_h
#define vtkIBLRenderView_h

#include "vtkIBLParaViewViewsModule.h" // For export macro
#include "vtkNew.h"
#include "vtkPVRenderView.h"

#include <string> // For std::string
#include <vector> // For std::vector

class vtkIBLEnvironment;
class vtkIBLProbe;
class vtkIBLRenderPass;
class vtkOpenGLFXAAFilter;

class VTKIBLPARAVIEWVIEWS_EXPORT vtkIBLRenderView : public vtkPVRenderView
{
public:
  static vtkIBLRenderView* New();
  vtkTypeMacro(vtkIBLRenderView, vtkPVRenderView);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Off: the view is vtkPVRenderView. Default on.
   */
  void SetEnvironmentLighting(bool on);

  ///@{
  /**
   * The light, as vtkIBLEnvironment has it. It is read in Update(), which all processes enter.
   */
  void SetEnvironmentFileName(const char* fileName);
  void SetEnvironmentUp(double x, double y, double z);
  void SetEnvironmentRotation(double degrees);
  void SetEnvironmentIntensity(double intensity);
  void SetNormalizeExposure(bool normalize);
  ///@}

  ///@{
  /**
   * What is seen and what is lit, as vtkIBLRenderPass has it.
   */
  void SetEnvironmentVisible(bool visible);
  void SetEnvironmentBlur(double blur);
  void SetLightNonPBR(bool on);
  void SetTranslucentFresnel(bool on);
  ///@}

  ///@{
  /**
   * How well, as vtkIBLSpecularChain and vtkIBLLighting have it.
   */
  void SetErrorTolerance(double tolerance);
  void SetBrightTexels(bool on);
  void SetEnvironmentSamples(int samplesPerPixel);
  ///@}

  enum ProbeModes
  {
    NoProbe,
    StaticProbe, ///< captured when data comes, goes, moves or changes, and by CaptureProbe(); colours and light as then
    DynamicProbe ///< captured when anything changes that it sees
  };
  ///@{
  /**
   * The light in the scene, as vtkIBLProbe and vtkIBLProbeCollection have it. Default NoProbe. Where it fits the data,
   * which is the default, its box is that of what is visible, axes and widgets aside, and it looks from the middle.
   */
  void SetProbeMode(int mode);
  void SetProbeFitsData(bool fits);
  void SetProbeBounds(double xmin, double xmax, double ymin, double ymax, double zmin, double zmax);
  void SetProbePosition(double x, double y, double z);
  void SetProbeBounces(int bounces);
  void SetProbeFaceSize(int faceSize);
  void CaptureProbe();
  ///@}

  /**
   * What this process did for the light so far, one line for each kind of work.
   */
  const char* GetStatisticsText();

  vtkIBLRenderPass* GetPass();

  void Update() override;

protected:
  vtkIBLRenderView();
  ~vtkIBLRenderView() override;

  void UpdateBackground(vtkRenderer* renderer = nullptr) override;
  void AboutToRenderOnLocalProcess(bool interactive) override;

private:
  vtkIBLRenderView(const vtkIBLRenderView&) = delete;
  void operator=(const vtkIBLRenderView&) = delete;

  bool IsAlone();
  bool IsClient();
  bool IsComposited();
  void TakeFile();
  std::vector<double> GetShownData();
  void UpdateProbe();
  void OnSceneRendered();

  vtkNew<vtkIBLEnvironment> Environment;
  vtkNew<vtkIBLRenderPass> Pass;
  bool EnvironmentLighting = true;
  bool EnvironmentVisible = false;
  bool AddsBackground = false; // to a composited picture, after the frame that is being rendered
  bool AddsFXAA = false;
  vtkNew<vtkOpenGLFXAAFilter> FXAA;
  std::string FileName;
  bool FileIsNew = false;
  std::string StatisticsText;

  vtkNew<vtkIBLProbe> Probe;
  int ProbeMode = NoProbe;
  bool ProbeFitsData = true;
  double ProbeBounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  double ProbePosition[3] = { 0.0, 0.0, 0.0 };
  bool ProbeIsNew = false;
  bool SaidNoProbe = false;
  std::vector<double> ShownData; // when the probe was last placed
};

#endif
