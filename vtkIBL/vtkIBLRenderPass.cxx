// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLRenderPass.h"

#include "vtkIBLBackground.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLGLHeader.h"
#include "vtkIBLLighting.h"

#include "vtkFramebufferPass.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkIBLRenderPass);

namespace
{
// Marks props so that their mappers call this pass's hooks, for one frame. Not vtkOpenGLRenderPass's own PreRender():
// that marks volumes too, and a volume mapper takes any mark for dual depth peeling.
class MarkedProps
{
public:
  MarkedProps(const vtkRenderState* state, vtkOpenGLRenderPass* pass)
    : Pass(pass)
  {
    for (int i = 0; i < state->GetPropArrayCount(); ++i)
    {
      vtkProp* prop = state->GetPropArray()[i];
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
  StandInLight(const StandInLight&) = delete;
  StandInLight& operator=(const StandInLight&) = delete;

private:
  vtkLightCollection* Lights;
  vtkLight* Light;
};
}

vtkIBLRenderPass::vtkIBLRenderPass()
{
  this->NoLight->SetLightTypeToHeadlight();
  this->NoLight->SetIntensity(0.0);
  this->Background->SetLighting(this->Lighting);
}

vtkIBLRenderPass::~vtkIBLRenderPass() = default;

void vtkIBLRenderPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BackgroundVisible: " << this->BackgroundVisible << "\n"
     << indent << "BackgroundBlur: " << this->BackgroundBlur << "\n"
     << indent << "OutputEncoding: " << (this->OutputEncoding == Display ? "Display" : "Linear") << "\n"
     << indent << "DelegatePass: " << this->DelegatePass.Get() << "\n"
     << indent << "Lighting:\n";
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

vtkIBLLighting* vtkIBLRenderPass::GetLighting()
{
  return this->Lighting;
}

void vtkIBLRenderPass::SetOutputEncoding(int encoding)
{
  if (encoding != Display && encoding != Linear)
  {
    vtkErrorMacro("OutputEncoding is " << encoding << "; it is Display (0) or Linear (1). The old one stays.");
  }
  else if (encoding != this->OutputEncoding)
  {
    this->OutputEncoding = encoding;
    this->ShaderTime.Modified();
    this->Modified();
  }
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
  vtkIBLSceneNeeds needs = vtkIBLSceneNeeds::Of(state->GetPropArray(), state->GetPropArrayCount());
  if (this->BackgroundVisible)
  {
    needs.AddRoughness(this->BackgroundBlur, this->BackgroundBlur);
  }
  if (needs.IsNothing())
  {
    this->RenderScene(state);
    return;
  }
  // A selection never waits for light, but keeps the shaders that the last frame had.
  const bool lit = window && (renderer->GetSelector() ? this->Lit : this->Lighting->Update(window, needs));
  if (lit != this->Lit)
  {
    this->Lit = lit;
    this->ShaderTime.Modified();
  }
  if (!lit)
  {
    this->RenderScene(state);
    return;
  }
  try
  {
    this->Lighting->Activate(window);
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
    const MarkedProps marked(state, this);
    const StandInLight light(renderer->GetLights(), this->NoLight);
    this->RenderScene(state);
  }
  this->Lighting->Deactivate();
  this->Renderer = nullptr;
}

void vtkIBLRenderPass::RenderScene(const vtkRenderState* state)
{
  vtkRenderer* renderer = state->GetRenderer();
  const bool background = this->BackgroundVisible && this->Renderer;
  this->Background->SetBlur(this->BackgroundBlur);
  this->Background->SetDisplayEncoding(this->OutputEncoding == Display);
  if (this->DelegatePass)
  {
    std::vector<vtkProp*> props(state->GetPropArray(), state->GetPropArray() + state->GetPropArrayCount());
    if (background)
    {
      props.insert(props.begin(), this->Background);
    }
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
  if (background)
  {
    this->Background->RenderOpaqueGeometry(renderer);
  }
  this->UpdateGeometry(renderer, state->GetFrameBuffer());
  this->NumberOfRenderedProps += renderer->GetNumberOfPropsRendered();
}

void vtkIBLRenderPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Lighting->ReleaseGraphicsResources(window);
  this->Background->ReleaseGraphicsResources(window);
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
  const int encoding = this->OutputEncoding;
  vtkNew<vtkFramebufferPass> framebuffer;
  framebuffer->SetColorFormat(vtkTextureObject::Float32);
  framebuffer->SetDelegatePass(this);
  const vtkSmartPointer<vtkIBLRenderPass> alive = this; // SetPass() lets go
  this->SetOutputEncoding(Linear);
  renderer->SetPass(framebuffer);
  window->Render();
  window->MakeCurrent();

  vtkTextureObject* texture = framebuffer->GetColorTexture();
  auto image = vtkSmartPointer<vtkImageData>::New();
  if (texture->GetHandle())
  {
    image->SetDimensions(int(texture->GetWidth()), int(texture->GetHeight()), 1);
    image->AllocateScalars(VTK_FLOAT, 4);
    glGetTextureImage(texture->GetHandle(), 0, GL_RGBA, GL_FLOAT,
      GLsizei(4 * sizeof(float) * image->GetNumberOfPoints()), image->GetScalarPointer());
  }
  framebuffer->SetDelegatePass(nullptr); // its release would be ours, too
  framebuffer->ReleaseGraphicsResources(window);
  renderer->SetPass(this);
  this->SetOutputEncoding(encoding);
  return image;
}

//------------------------------------------------------------------------------
bool vtkIBLRenderPass::PostReplaceShaderValues(
  std::string&, std::string&, std::string& fragmentShader, vtkAbstractMapper*, vtkProp*)
{
  if (!this->Lit)
  {
    return true;
  }
  // Where VTK adds its direct light, in every version from 9.1 to 9.7. Unlit shaders have no such line and need none.
  const std::string direct = "  color += Lo;\n";
  // VTK's own D is 0/0 at roughness 0 where H = N, even for a light of intensity 0.
  const std::string environment =
    "  Lo = mix(Lo, vec3(0.0), isnan(Lo));\n"
    "  color += iblEnvironmentLight(\n"
    "    N, vertexVC.xyz, albedo, roughness, metallic, baseF0Uniform, edgeTintUniform);\n";
  if (!vtkShaderProgram::Substitute(fragmentShader, direct, environment + direct, false))
  {
    return true;
  }
  vtkShaderProgram::Substitute(fragmentShader, "void main()", this->Lighting->GetShaderChunk() + "void main()", false);
  if (this->OutputEncoding == Linear)
  {
    vtkShaderProgram::Substitute(fragmentShader, "color = pow(color, vec3(1.0/2.2));", "", false);
  }
  return true;
}

bool vtkIBLRenderPass::SetShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper*, vtkProp*, vtkOpenGLVertexArrayObject*)
{
  if (this->Renderer && program->IsUniformUsed("iblRadianceScale"))
  {
    this->Lighting->SetShaderParameters(program, this->Renderer);
  }
  return true;
}

vtkMTimeType vtkIBLRenderPass::GetShaderStageMTime()
{
  return std::max(this->ShaderTime.GetMTime(), this->Lighting->GetShaderTime());
}
