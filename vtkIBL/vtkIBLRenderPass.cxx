// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLRenderPass.h"

#include "vtkIBLAccumulation.h"
#include "vtkIBLBackground.h"
#include "vtkIBLBRDFTable.h"
#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGL.h"
#include "vtkIBLLighting.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLProbeDisplay.h"
#include "vtkIBLProbeLight.h"
#include "vtkIBLSpecularChain.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFrameBufferObjectBase.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkProp3D.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkIBLRenderPass);

namespace
{
// Marks props so that their mappers call this pass's hooks, for one frame. Not vtkOpenGLRenderPass's own PreRender():
// that marks volumes too, and a volume mapper takes any mark for dual depth peeling.
class MarkedProps
{
public:
  MarkedProps(const std::vector<vtkProp*>& props, vtkOpenGLRenderPass* pass)
    : Pass(pass)
  {
    for (vtkProp* prop : props)
    {
      if (prop->IsA("vtkVolume"))
      {
        continue;
      }
      vtkInformation* keys = prop->GetPropertyKeys();
      if (!keys)
      {
        vtkNew<vtkInformation> made;
        prop->SetPropertyKeys(made);
        keys = made;
      }
      keys->Append(vtkOpenGLRenderPass::RenderPasses(), pass);
      this->Props.push_back(prop);
    }
  }
  ~MarkedProps()
  {
    for (vtkProp* prop : this->Props)
    {
      if (vtkInformation* keys = prop->GetPropertyKeys())
      {
        keys->Remove(vtkOpenGLRenderPass::RenderPasses(), this->Pass);
        if (keys->Length(vtkOpenGLRenderPass::RenderPasses()) == 0)
        {
          keys->Remove(vtkOpenGLRenderPass::RenderPasses());
        }
      }
    }
  }
  MarkedProps(const MarkedProps&) = delete;
  MarkedProps& operator=(const MarkedProps&) = delete;

private:
  vtkOpenGLRenderPass* Pass;
  std::vector<vtkSmartPointer<vtkProp>> Props;
};

// VTK shades PBR surfaces only when a light is on. In a scene without, one of intensity 0 stands in for the frame.
class StandInLight
{
public:
  StandInLight(vtkLightCollection* lights, vtkLight* light)
    : Lights(lights)
    , Light(light)
  {
    vtkCollectionSimpleIterator it;
    lights->InitTraversal(it);
    while (vtkLight* other = lights->GetNextLight(it))
    {
      if (other->GetSwitch())
      {
        this->Lights = nullptr;
        return;
      }
    }
    lights->AddItem(light);
  }
  ~StandInLight()
  {
    if (this->Lights)
    {
      this->Lights->RemoveItem(this->Light);
    }
  }
  bool IsOn() const { return this->Lights != nullptr; }
  StandInLight(const StandInLight&) = delete;
  StandInLight& operator=(const StandInLight&) = delete;

private:
  vtkLightCollection* Lights;
  vtkLight* Light;
};

// Lights that are switched on and go where the camera goes.
std::vector<vtkLight*> GetCameraLights(vtkLightCollection* lights)
{
  std::vector<vtkLight*> found;
  vtkCollectionSimpleIterator it;
  lights->InitTraversal(it);
  while (vtkLight* light = lights->GetNextLight(it))
  {
    if (light->GetSwitch() && !light->LightTypeIsSceneLight())
    {
      found.push_back(light);
    }
  }
  return found;
}

// What probes that capture may show: all of the scene, in the camera's view or not.
std::vector<vtkProp*> GetCaptured(vtkRenderer* renderer)
{
  std::vector<vtkProp*> captured;
  vtkCollectionSimpleIterator it;
  vtkPropCollection* props = renderer->GetViewProps();
  props->InitTraversal(it);
  while (vtkProp* prop = props->GetNextProp(it))
  {
    if (prop->GetVisibility() && vtkIBLProbe::IsCaptured(prop) && !prop->IsA("vtkVolume") && !prop->IsA("vtkActor2D"))
    {
      captured.push_back(prop);
    }
  }
  return captured;
}

double GetDeterminant3x3(const vtkMatrix4x4* matrix)
{
  return vtkMath::Determinant3x3(matrix->Element[0], matrix->Element[1], matrix->Element[2]);
}

// Whether what is counterclockwise in `prop`'s data runs clockwise in the picture. (A projection looks along -z, so its
// own determinant is negative.)
bool IsMirrored(vtkProp3D* prop, vtkCamera* camera)
{
  prop->ComputeMatrix();
  return GetDeterminant3x3(prop->GetMatrix()) * GetDeterminant3x3(camera->GetModelViewTransformMatrix()) *
    camera->GetProjectionTransformMatrix(1, -1, 1)->Determinant() >
    0;
}
}

vtkIBLRenderPass::vtkIBLRenderPass()
  : ProbeLight(new vtkIBLProbeLight)
  , ShownProbes(new vtkIBLProbeDisplay)
{
  this->NoLight->SetLightTypeToHeadlight();
  this->NoLight->SetIntensity(0.0);
  this->Background->SetLighting(this->Lighting);
  for (auto& accumulation : this->Accumulations)
  {
    accumulation = std::make_unique<vtkIBLAccumulation>();
  }
}

vtkIBLRenderPass::~vtkIBLRenderPass() = default;

void vtkIBLRenderPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BackgroundVisible: " << this->BackgroundVisible << "\n"
     << indent << "BackgroundBlur: " << this->BackgroundBlur << "\n"
     << indent << "OutputEncoding: " << (this->OutputEncoding == Display ? "Display" : "Linear") << "\n"
     << indent << "LightNonPBR: " << this->LightNonPBR << "\n"
     << indent << "TranslucentFresnel: " << this->TranslucentFresnel << "\n"
     << indent << "DirectOcclusion: " << this->DirectOcclusion << "\n"
     << indent << "DelegatePass: " << this->DelegatePass.Get() << "\n"
     << indent << "AccumulatedSamples: " << this->AccumulatedSamples << "\n"
     << indent << "ProbeDisplay: " << this->ProbeDisplay << "\n"
     << indent << "ProbeDisplayRoughness: " << this->ProbeDisplayRoughness << "\n"
     << indent << "Probes:\n";
  this->Probes->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Lighting:\n";
  this->Lighting->PrintSelf(os, indent.GetNextIndent());
}

void vtkIBLRenderPass::SetEnvironment(vtkIBLEnvironment* environment)
{
  this->Lighting->SetEnvironment(environment);
  this->Modified();
}

vtkIBLEnvironment* vtkIBLRenderPass::GetEnvironment()
{
  return this->Lighting->GetEnvironment();
}

vtkIBLProbeCollection* vtkIBLRenderPass::GetProbes()
{
  return this->Probes;
}

vtkIBLLighting* vtkIBLRenderPass::GetLighting()
{
  return this->Lighting;
}

template <typename T>
void vtkIBLRenderPass::SetShaderOption(T& option, T value)
{
  if (value != option)
  {
    option = value;
    this->ShaderTime.Modified();
    this->Modified();
  }
}

void vtkIBLRenderPass::SetShaderState(bool& state, bool value)
{
  if (value != state)
  {
    state = value;
    this->ShaderTime.Modified();
  }
}

void vtkIBLRenderPass::SetOutputEncoding(int encoding)
{
  if (encoding != Display && encoding != Linear)
  {
    vtkErrorMacro("OutputEncoding is " << encoding << "; it is Display (0) or Linear (1). The old one stays.");
  }
  else
  {
    this->OutputEncoding = encoding;
    this->Modified();
  }
}

void vtkIBLRenderPass::SetProbeDisplay(int display)
{
  this->SetShaderOption(this->ProbeDisplay, std::clamp<int>(display, ProbesHidden, ProbeShares));
}

void vtkIBLRenderPass::SetLightNonPBR(bool on)
{
  this->SetShaderOption(this->LightNonPBR, on);
}

void vtkIBLRenderPass::SetTranslucentFresnel(bool on)
{
  this->SetShaderOption(this->TranslucentFresnel, on);
}

void vtkIBLRenderPass::SetDirectOcclusion(bool on)
{
  this->SetShaderOption(this->DirectOcclusion, on);
}

void vtkIBLRenderPass::SetDelegatePass(vtkRenderPass* pass)
{
  if (this->DelegatePass != pass)
  {
    this->DelegatePass = pass;
    this->Modified();
  }
}

vtkRenderPass* vtkIBLRenderPass::GetDelegatePass()
{
  return this->DelegatePass;
}

//------------------------------------------------------------------------------
void vtkIBLRenderPass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  std::vector<vtkProp*> props(state->GetPropArray(), state->GetPropArray() + state->GetPropArrayCount());
  vtkIBLSceneNeeds needs = vtkIBLSceneNeeds::Of(props.data(), int(props.size()), this->LightNonPBR);
  const bool hasProbes = this->Probes->GetNumberOfItems() > 0;
  this->ShownProbes->Clear();
  if (hasProbes && this->ProbeDisplay != ProbesHidden && !renderer->GetSelector())
  {
    const std::vector<vtkProp*>& display = this->ShownProbes->Update(this->Probes,
      this->ProbeDisplay == ProbeReflections ? vtkIBLProbeDisplay::Look{ true, this->ProbeDisplayRoughness }
                                             : vtkIBLProbeDisplay::Look{ false, 1.0 });
    needs.Add(vtkIBLSceneNeeds::Of(display.data(), int(display.size())));
    props.insert(props.end(), display.begin(), display.end());
  }
  std::vector<vtkProp*> captured;
  if (needs.Irradiance && this->AnyProbeCaptures())
  {
    captured = GetCaptured(renderer);
    needs.Add(vtkIBLSceneNeeds::Of(captured.data(), int(captured.size()), this->LightNonPBR));
    needs.RadianceCube = true;
  }
  if (this->BackgroundVisible)
  {
    needs.AddRoughness(this->BackgroundBlur, this->BackgroundBlur);
  }
  if (needs.IsNothing())
  {
    this->RenderScene(state);
    return;
  }
  this->Lighting->SetReadsProbes(hasProbes);
  // A selection never waits for light, but keeps the shaders that the last frame had in this window.
  const bool lit = window &&
    (renderer->GetSelector() ? this->Lit && this->Lighting->GetBRDFTable()->GetTexture().IsIn(window)
                             : this->Lighting->Update(window, needs));
  this->SetShaderState(this->Lit, lit);
  if (!lit)
  {
    this->RenderScene(state);
    return;
  }
  try
  {
    this->Lighting->Activate(window);
    if (hasProbes)
    {
      this->ProbeLight->Prepare(window, this->Probes);
      this->ProbeLight->Activate();
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    this->RenderScene(state);
    return;
  }
  this->Renderer = renderer;
  vtkOpenGLState::ScopedglEnableDisable seamless(window->GetState(), GL_TEXTURE_CUBE_MAP_SEAMLESS);
  window->GetState()->vtkglEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  {
    props.insert(props.end(), captured.begin(), captured.end());
    std::sort(props.begin(), props.end());
    props.erase(std::unique(props.begin(), props.end()), props.end());
    const MarkedProps marked(props, this);
    const StandInLight light(renderer->GetLights(), this->NoLight);
    this->SetShaderState(this->WithoutLights, light.IsOn());
    this->SetShaderState(this->ParallelProjection, renderer->GetActiveCamera()->GetParallelProjection() != 0);
    this->SetShaderState(this->RigidView, this->Lighting->IsViewRigid(renderer));
    if (hasProbes && !renderer->GetSelector())
    {
      this->UpdateProbes(state, captured);
    }
    this->RenderScene(state);
  }
  this->ProbeLight->Deactivate();
  this->Lighting->Deactivate();
  this->Renderer = nullptr;
}

bool vtkIBLRenderPass::Accumulates(const vtkRenderState* state) const
{
  vtkRenderer* renderer = state->GetRenderer();
  if (state->GetFrameBuffer() || renderer->GetSelector() || !vtkIBLGL::FindMissingFeature().empty())
  {
    return false;
  }
  // What is drawn over somebody else's picture changes with that, unnoticed.
  const bool startsClear = renderer->GetRenderWindow()->GetErase() && renderer->GetErase() &&
    !renderer->GetPreserveColorBuffer() && !renderer->GetPreserveDepthBuffer();
  return renderer == this->Capturing || (startsClear && this->Renderer && this->Lighting->GetSamplesPerPixel() > 0);
}

vtkIBLStamp vtkIBLRenderPass::GetStamp(const vtkRenderState* state)
{
  vtkIBLStamp stamp(state);
  stamp.Add(this);
  stamp.Add(this->DelegatePass);
  stamp.Add(this->Lighting);
  stamp.Add(this->Lighting->GetCubeMap()->GetBuildTime());
  stamp.Add(this->Lighting->GetSpecularChain()->GetBuildTime());
  stamp.Add(this->Lighting->GetBRDFTable()->GetBuildTime());
  vtkCollectionSimpleIterator it;
  this->Probes->InitTraversal(it);
  while (vtkIBLProbe* probe = this->Probes->GetNextProbe(it))
  {
    stamp.Add(probe);
  }
  stamp.Add(this->ProbeLight->GetTime());
  double numbers[12];
  this->GetEnvironment()->GetRadianceScale(numbers);
  this->GetEnvironment()->GetEnvironmentFromWorld(numbers + 3);
  stamp.Add(numbers, 12);
  return stamp;
}

void vtkIBLRenderPass::RenderScene(const vtkRenderState* state)
{
  const int samples = this->Renderer ? this->Lighting->GetSamplesPerPixel() : 0;
  vtkIBLAccumulation& accumulation = *this->Accumulations[this->OutputEncoding];
  if (state->GetRenderer()->GetSelector())
  {
    for (auto& other : this->Accumulations)
    {
      other->Selected();
    }
  }
  else
  {
    this->AccumulatedSamples = samples;
  }
  if (!this->Accumulates(state))
  {
    this->DrawScene(state);
    return;
  }
  try
  {
    if (samples == 0)
    {
      accumulation.Restart(); // a single frame, to capture
    }
    accumulation.Render(
      state->GetRenderer(), std::max(samples, 1), this->OutputEncoding == Display,
      [&] { return this->GetStamp(state); },
      [&](int firstSample)
      {
        this->FirstSample = firstSample;
        this->DrawScene(state);
        this->FirstSample = 0;
      });
    this->AccumulatedSamples = samples > 0 ? accumulation.GetSamples() : 0;
    if (state->GetRenderer() == this->Capturing)
    {
      accumulation.Read(this->Captured);
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    this->DrawScene(state);
  }
}

//------------------------------------------------------------------------------
bool vtkIBLRenderPass::AnyProbeCaptures()
{
  bool anyCaptures = false;
  vtkCollectionSimpleIterator it;
  this->Probes->InitTraversal(it);
  while (vtkIBLProbe* probe = this->Probes->GetNextProbe(it))
  {
    anyCaptures = anyCaptures || !probe->GetEnvironment();
  }
  return anyCaptures;
}

void vtkIBLRenderPass::UpdateProbes(const vtkRenderState* state, const std::vector<vtkProp*>& captured)
{
  vtkRenderer* renderer = state->GetRenderer();
  vtkIBLProbeLight::Scene scene;
  scene.Window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  scene.Captured = captured;
  std::vector<vtkProp*> seen(state->GetPropArray(), state->GetPropArray() + state->GetPropArrayCount());
  seen.insert(seen.end(), this->ShownProbes->GetProps().begin(), this->ShownProbes->GetProps().end());
  for (vtkProp* prop : seen)
  {
    const double* bounds = prop->GetBounds();
    if (bounds && vtkIBLSceneNeeds::Of(&prop, 1, this->LightNonPBR).Irradiance)
    {
      scene.LitBounds.push_back({ bounds[0], bounds[1], bounds[2], bounds[3], bounds[4], bounds[5] });
    }
  }
  scene.Light.Add(this->GetShaderStageMTime());
  scene.Light.Add(this->GetEnvironment()->GetRadianceTime());
  double numbers[12];
  this->GetEnvironment()->GetRadianceScale(numbers);
  this->GetEnvironment()->GetEnvironmentFromWorld(numbers + 3);
  scene.Light.Add(numbers, 12);
  scene.StoredScale = this->Lighting->GetSpecularChain()->GetStoredScale() * *std::max_element(numbers, numbers + 3);
  const std::vector<vtkLight*> ofTheCamera = GetCameraLights(renderer->GetLights());
  vtkCollectionSimpleIterator it;
  renderer->GetLights()->InitTraversal(it);
  while (vtkLight* light = renderer->GetLights()->GetNextLight(it))
  {
    if (std::find(ofTheCamera.begin(), ofTheCamera.end(), light) == ofTheCamera.end())
    {
      scene.Light.AddLight(light);
    }
  }
  scene.Draw = [&](vtkCamera* camera, const vtkIBLGL::Framebuffer& target, int size, const std::vector<vtkProp*>& props,
                 bool probes)
  {
    // Mappers ask the renderer how many lights there are, and that is counted here.
    this->ClearLights(renderer);
    this->UpdateLightGeometry(renderer);
    this->UpdateLights(renderer);
    vtkOpenGLState* gl = scene.Window->GetState();
    const vtkSmartPointer<vtkCamera> own = renderer->GetActiveCamera();
    std::vector<double> intensities;
    for (vtkLight* light : ofTheCamera)
    {
      intensities.push_back(light->GetIntensity());
      light->SetIntensity(0.0);
    }
    renderer->SetActiveCamera(camera);
    this->CapturesProbe = true;
    this->IsLitByProbes = probes;
    gl->Push();
    gl->PushFramebufferBindings();
    gl->vtkglBindFramebuffer(GL_FRAMEBUFFER, target.Id());
    this->DrawCapture(renderer, size, props);
    gl->PopFramebufferBindings();
    gl->Pop();
    this->CapturesProbe = false;
    this->IsLitByProbes = true;
    renderer->SetActiveCamera(own);
    for (std::size_t i = 0; i < ofTheCamera.size(); ++i)
    {
      ofTheCamera[i]->SetIntensity(intensities[i]);
    }
    vtkIBLGL::CheckErrors("capturing a probe");
  };
  try
  {
    this->ProbeLight->Update(scene, this->Lighting->GetStatistics());
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

// One face. Translucent surfaces are blended in the order in which they come.
void vtkIBLRenderPass::DrawCapture(vtkRenderer* renderer, int size, const std::vector<vtkProp*>& props)
{
  vtkOpenGLState* gl = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow())->GetState();
  gl->vtkglViewport(0, 0, size, size);
  gl->vtkglScissor(0, 0, size, size);
  gl->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl->vtkglDepthMask(GL_TRUE);
  gl->vtkglEnable(GL_DEPTH_TEST);
  gl->vtkglDepthFunc(GL_LEQUAL);
  gl->vtkglDisable(GL_BLEND);
  gl->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  gl->vtkglClearDepth(1.0);
  gl->vtkglClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  this->Background->SetBlur(0.0);
  this->Background->SetSharpLevel(
    std::log2(std::max(double(this->Lighting->GetCubeMap()->GetOutputFaceSize()) / size, 1.0)));
  this->Background->SetDisplayEncoding(false);
  this->Background->RenderOpaqueGeometry(renderer);
  this->Background->SetSharpLevel(0.0);
  for (vtkProp* prop : props)
  {
    prop->RenderOpaqueGeometry(renderer);
  }
  gl->vtkglEnable(GL_BLEND);
  gl->vtkglBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  for (vtkProp* prop : props)
  {
    if (prop->HasTranslucentPolygonalGeometry())
    {
      prop->RenderTranslucentPolygonalGeometry(renderer);
    }
  }
}

vtkSmartPointer<vtkImageData> vtkIBLRenderPass::CaptureProbe(vtkRenderer* renderer, vtkIBLProbe* probe)
{
  auto* window = renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!window || renderer->GetPass() != this || !probe || !this->Probes->IsItemPresent(probe))
  {
    vtkErrorMacro("CaptureProbe() takes a renderer in a window, whose pass is this one, and a probe of GetProbes().");
    return nullptr;
  }
  this->ProbeLight->SetWanted(probe);
  probe->Capture();
  window->Render();
  this->ProbeLight->SetWanted(nullptr);
  vtkSmartPointer<vtkImageData> radiance = this->ProbeLight->Read(probe);
  if (!radiance)
  {
    vtkErrorMacro("The probe has no light: there is no lit surface in sight, or see the errors before.");
  }
  return radiance;
}

//------------------------------------------------------------------------------
void vtkIBLRenderPass::DrawScene(const vtkRenderState* state)
{
  vtkRenderer* renderer = state->GetRenderer();
  const bool background = this->BackgroundVisible && this->Renderer;
  this->SetUpBackground();
  if (this->DelegatePass)
  {
    std::vector<vtkProp*> props(state->GetPropArray(), state->GetPropArray() + state->GetPropArrayCount());
    if (background)
    {
      props.insert(props.begin(), this->Background);
    }
    props.insert(props.end(), this->ShownProbes->GetProps().begin(), this->ShownProbes->GetProps().end());
    vtkRenderState scene(renderer);
    scene.SetPropArrayAndCount(props.data(), static_cast<int>(props.size()));
    scene.SetFrameBuffer(state->GetFrameBuffer());
    scene.SetRequiredKeys(state->GetRequiredKeys());
    this->DelegatePass->Render(&scene);
    this->NumberOfRenderedProps += this->DelegatePass->GetNumberOfRenderedProps();
    return;
  }
  this->ClearLights(renderer);
  this->UpdateLightGeometry(renderer);
  this->UpdateLights(renderer);
  this->UpdateCamera(renderer);
  if (vtkFrameBufferObjectBase* framebuffer = state->GetFrameBuffer())
  {
    // A pass around this one has a framebuffer of its own size, with its origin at 0; the camera knows only the
    // window's.
    int width = 0;
    int height = 0;
    framebuffer->GetLastSize(width, height);
    vtkOpenGLState* gl = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow())->GetState();
    gl->vtkglViewport(0, 0, width, height);
    gl->vtkglScissor(0, 0, width, height);
    if (renderer->GetRenderWindow()->GetErase() && renderer->GetErase())
    {
      renderer->Clear();
    }
  }
  if (background)
  {
    this->Background->RenderOpaqueGeometry(renderer);
  }
  for (vtkProp* prop : this->ShownProbes->GetProps())
  {
    prop->RenderOpaqueGeometry(renderer);
  }
  this->UpdateGeometry(renderer, state->GetFrameBuffer());
  this->NumberOfRenderedProps += renderer->GetNumberOfPropsRendered();
}

bool vtkIBLRenderPass::RenderBackgroundBehind(vtkRenderer* renderer)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkIBLSceneNeeds needs;
  needs.AddRoughness(this->BackgroundBlur, this->BackgroundBlur);
  if (!window || !this->Lighting->Update(window, needs))
  {
    return false;
  }
  try
  {
    this->Lighting->Activate(window);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
  this->SetUpBackground();
  this->Background->SetBehindPicture(true);
  const int drawn = this->Background->RenderOpaqueGeometry(renderer);
  this->Background->SetBehindPicture(false);
  this->Lighting->Deactivate();
  return drawn > 0;
}

void vtkIBLRenderPass::SetUpBackground()
{
  this->Background->SetBlur(this->BackgroundBlur);
  this->Background->SetDisplayEncoding(this->OutputEncoding == Display);
}

void vtkIBLRenderPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Lighting->ReleaseGraphicsResources(window);
  this->ProbeLight->ReleaseGraphicsResources();
  this->ShownProbes->ReleaseGraphicsResources(window);
  this->Background->ReleaseGraphicsResources(window);
  for (auto& accumulation : this->Accumulations)
  {
    accumulation->ReleaseGraphicsResources();
  }
  if (this->DelegatePass)
  {
    this->DelegatePass->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

vtkSmartPointer<vtkImageData> vtkIBLRenderPass::CaptureRadiance(vtkRenderer* renderer)
{
  auto* window = renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!window || renderer->GetPass() != this)
  {
    vtkErrorMacro("CaptureRadiance() takes a renderer in a window, whose pass is this one.");
    return nullptr;
  }
  // No Modified(): the scene that a display-encoded mean is of stays the same.
  const int encoding = std::exchange(this->OutputEncoding, Linear);
  auto image = vtkSmartPointer<vtkImageData>::New();
  this->Captured = image;
  this->Capturing = renderer;
  window->Render();
  this->Capturing = nullptr;
  this->Captured = nullptr;
  if (this->AccumulatedSamples == 0)
  {
    this->Accumulations[Linear]->ReleaseGraphicsResources();
  }
  this->OutputEncoding = encoding;
  return image;
}

//------------------------------------------------------------------------------
namespace
{
bool Replace(std::string& shader, const std::string& what, const std::string& with)
{
  return vtkShaderProgram::Substitute(shader, what, with, false);
}

bool Contains(const std::string& shader, const char* what)
{
  return shader.find(what) != std::string::npos;
}

// iblMaterial out of the variables that VTK's PBR shader has by then, in every version from 9.1 to 9.7; and which of
// them it has.
std::string MakePBRMaterial(const std::string& shader, bool bumped, std::vector<std::string>& features)
{
  std::string material = "  iblMaterial iblSurface;\n"
                         "  iblSurface.normal = N;\n"
                         "  iblSurface.albedo = albedo;\n"
                         "  iblSurface.edgeTint = edgeTintUniform;\n"
                         "  iblSurface.perceptualRoughness = roughness;\n"
                         "  iblSurface.metallic = metallic;\n"
                         "  iblSurface.baseF0 = baseF0Uniform;\n";
  if (Contains(shader, "  float ao = material.r;"))
  {
    features.push_back("IBL_OCCLUSION");
    material += "  iblSurface.occlusion = mix(1.0, ao, aoStrengthUniform);\n";
  }
  if (bumped)
  {
    features.push_back("IBL_BUMPED");
    material += "#ifdef IBL_HORIZON\n  iblSurface.geometricNormal = iblGeometricNormal;\n#endif\n";
  }
  if (Contains(shader, "  float at = "))
  {
    features.push_back("IBL_ANISOTROPY");
    material += "  iblSurface.tangent = tangentVC;\n"
                "  iblSurface.bitangent = bitangentVC;\n"
                "  iblSurface.alpha = vec2(at, ab);\n";
  }
  if (Contains(shader, "  vec3 coatN = "))
  {
    features.push_back("IBL_COAT");
    material += "  iblSurface.coatNormal = coatN;\n"
                "  iblSurface.coatTint = coatColorFactor;\n"
                "  iblSurface.coatRoughness = coatRoughness;\n"
                "  iblSurface.coatStrength = coatStrength;\n"
                "  iblSurface.coatF0 = coatF0Uniform;\n";
  }
  return material;
}

// VTK's other shading as a material: matt, and glossy as far as its specular colour goes. Its colours are display's.
const char* const NonPBRMaterial =
  "  iblMaterial iblSurface;\n"
  "  iblSurface.normal = normalVCVSOutput;\n"
  "  iblSurface.albedo = pow(max(diffuseColor, vec3(0.0)), vec3(2.2));\n"
  "  iblSurface.edgeTint = vec3(1.0);\n"
  "  iblSurface.perceptualRoughness = sqrt(sqrt(2.0 / (specularPower + 2.0)));\n"
  "  iblSurface.metallic = 0.0;\n"
  "  iblSurface.baseF0 = 0.08 * max(specularColor.r, max(specularColor.g, specularColor.b));\n";

const char* const AddAll = "  color += IBL_OUTGOING_SCALE * (iblLight.diffuse + iblLight.specular);\n";

// What is reflected is not let through: a reflection keeps its strength on a surface however clear.
const char* const AddTranslucent =
  "  float iblOpacity = mix(opacity, 1.0, clamp(dot(iblLight.reflectance, vec3(1.0 / 3.0)), 0.0, 1.0));\n"
  "  color = (opacity * (color + IBL_OUTGOING_SCALE * iblLight.diffuse) + IBL_OUTGOING_SCALE * iblLight.specular) / "
  "max(iblOpacity, 1e-6);\n"
  "  opacity = iblOpacity;\n";
}

bool vtkIBLRenderPass::PostReplaceShaderValues(
  std::string&, std::string&, std::string& fragmentShader, vtkAbstractMapper*, vtkProp* prop)
{
  if (!this->Lit)
  {
    return true;
  }
  std::vector<std::string> features;
  if (this->ParallelProjection)
  {
    features.push_back("IBL_PARALLEL_PROJECTION");
  }
  if (this->RigidView)
  {
    features.push_back("IBL_RIGID_VIEW");
  }
  const std::string evaluate = "  iblOutgoing iblLight = iblEnvironmentLight(iblSurface, vertexVC.xyz);\n";
  const bool showsShares = this->ProbeDisplay == ProbeShares && this->Lighting->GetReadsProbes();
  if (showsShares)
  {
    features.push_back("IBL_SHOW_SHARES");
  }
  const std::string add = showsShares ? "  color = iblSharesAsColors(vertexVC.xyz);\n"
    : this->TranslucentFresnel        ? AddTranslucent
                                      : AddAll;
  const std::string emission = "  color += emissiveColor;\n";
  // Unlit shaders have none of these lines and need none.
  if (Contains(fragmentShader, emission.c_str()))
  {
    const std::string bump = "  vec3 normalTS = ";
    const bool bumped = Replace(fragmentShader, bump, "  vec3 iblGeometricNormal = normalVCVSOutput;\n" + bump);
    // VTK's own D is 0/0 at roughness 0 where H = N.
    const std::string direct = "  color += Lo;\n";
    Replace(fragmentShader, direct,
      this->WithoutLights ? "" : "#ifdef IBL_MIRROR\n  Lo = mix(Lo, vec3(0.0), isnan(Lo));\n#endif\n" + direct);
    if (!this->DirectOcclusion)
    {
      Replace(fragmentShader, "  color = mix(color, color * ao, aoStrengthUniform);\n", "");
    }
    Replace(fragmentShader, emission, emission + MakePBRMaterial(fragmentShader, bumped, features) + evaluate + add);
    const std::string encode = "color = pow(color, vec3(1.0/2.2));";
    const std::string encode97 = "gl_FragData[0].rgb = pow(gl_FragData[0].rgb, vec3(1.0/2.2));";
    for (const std::string& line : { encode, encode97 })
    {
      Replace(fragmentShader, line, "if (!iblLinear) { " + line + " }");
    }
  }
  else if (this->LightNonPBR && Contains(fragmentShader, "vec4(ambientColor + diffuse + specular, opacity)"))
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    if (actor && !(actor->GetProperty()->GetSpecular() > 0.0))
    {
      features.push_back("IBL_MATT"); // VTK makes shaders anew when a property changes
    }
    Replace(fragmentShader, "//VTK::Light::Impl",
      "\n  {\n  vec3 color = pow(max(gl_FragData[0].rgb, vec3(0.0)), vec3(2.2));\n" + std::string(NonPBRMaterial) +
        evaluate + add +
        "  gl_FragData[0] = vec4(iblLinear ? color : pow(color, vec3(1.0 / 2.2)), opacity);\n  }\n  "
        "//VTK::Light::Impl");
  }
  else
  {
    // What is not lit has the screen's colours, of which a probe makes light.
    const std::string last = "  if (gl_FragData[0].a <= 0.0)";
    if (this->Lighting->GetReadsProbes() &&
      Replace(fragmentShader, last,
        "  if (iblDecodes) { gl_FragData[0].rgb = pow(max(gl_FragData[0].rgb, vec3(0.0)), vec3(2.2)); }\n" + last))
    {
      Replace(fragmentShader, "void main()", "uniform bool iblDecodes;\nvoid main()");
    }
    return true;
  }
  // VTK turns the normals of back faces, and takes all faces of a mirrored actor for such.
  Replace(fragmentShader, "(gl_FrontFacing == false) { normalVCVSOutput",
    "(gl_FrontFacing == iblMirrored) { normalVCVSOutput");
  if (this->Lighting->GetReadsProbes())
  {
    Replace(
      fragmentShader, "//VTK::System::Dec", "//VTK::System::Dec\n#extension GL_ARB_texture_cube_map_array : enable");
  }
  Replace(fragmentShader, "void main()",
    "uniform bool iblMirrored;\nuniform bool iblLinear;\n" + this->Lighting->GetShaderChunk(features) + "void main()");
  return true;
}

bool vtkIBLRenderPass::SetShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper*, vtkProp* prop, vtkOpenGLVertexArrayObject*)
{
  auto* prop3D = vtkProp3D::SafeDownCast(prop);
  if (this->Renderer && prop3D && program->IsUniformUsed("iblMirrored"))
  {
    program->SetUniformi("iblMirrored", IsMirrored(prop3D, this->Renderer->GetActiveCamera()));
  }
  if (this->Renderer && program->IsUniformUsed("iblRadianceScale"))
  {
    this->Lighting->SetShaderParameters(program, this->Renderer, this->FirstSample);
  }
  if (this->Renderer && program->IsUniformUsed("iblProbeCount"))
  {
    this->ProbeLight->SetShaderParameters(program, this->Renderer, this->IsLitByProbes ? prop->GetBounds() : nullptr);
  }
  for (const auto& [name, value] : { std::pair("iblLinear", this->CapturesProbe || this->OutputEncoding == Linear),
         std::pair("iblDecodes", this->CapturesProbe) })
  {
    if (program->IsUniformUsed(name))
    {
      program->SetUniformi(name, value);
    }
  }
  return true;
}

vtkMTimeType vtkIBLRenderPass::GetShaderStageMTime()
{
  return std::max(this->ShaderTime.GetMTime(), this->Lighting->GetShaderTime());
}
