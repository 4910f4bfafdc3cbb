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
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <algorithm>
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

void vtkIBLRenderPass::SetOutputEncoding(int encoding)
{
  if (encoding != Display && encoding != Linear)
  {
    vtkErrorMacro("OutputEncoding is " << encoding << "; it is Display (0) or Linear (1). The old one stays.");
  }
  else
  {
    this->SetShaderOption(this->OutputEncoding, encoding);
  }
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
  vtkIBLSceneNeeds needs = vtkIBLSceneNeeds::Of(state->GetPropArray(), state->GetPropArrayCount(), this->LightNonPBR);
  if (this->BackgroundVisible)
  {
    needs.AddRoughness(this->BackgroundBlur, this->BackgroundBlur);
  }
  if (needs.IsNothing())
  {
    this->RenderScene(state);
    return;
  }
  // A selection never waits for light, but keeps the shaders that the last frame had in this window.
  const bool lit = window &&
    (renderer->GetSelector() ? this->Lit && this->Lighting->GetBRDFTable()->GetTexture().IsIn(window)
                             : this->Lighting->Update(window, needs));
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
  if (encoding != Linear)
  {
    this->ShaderTime.Modified();
  }
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
  if (encoding != Linear)
  {
    this->OutputEncoding = encoding;
    this->ShaderTime.Modified();
  }
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

const char* const AddAll = "  color += iblRadianceScale * (iblLight.diffuse + iblLight.specular);\n";

// What is reflected is not let through: a reflection keeps its strength on a surface however clear.
const char* const AddTranslucent =
  "  float iblOpacity = mix(opacity, 1.0, clamp(dot(iblLight.reflectance, vec3(1.0 / 3.0)), 0.0, 1.0));\n"
  "  color = (opacity * (color + iblRadianceScale * iblLight.diffuse) + iblRadianceScale * iblLight.specular) / "
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
  const std::string evaluate = "  iblOutgoing iblLight = iblEnvironmentLight(iblSurface, vertexVC.xyz);\n";
  const std::string add = this->TranslucentFresnel ? AddTranslucent : AddAll;
  const std::string emission = "  color += emissiveColor;\n";
  // Unlit shaders have none of these lines and need none.
  if (Contains(fragmentShader, emission.c_str()))
  {
    const std::string bump = "  vec3 normalTS = ";
    const bool bumped = Replace(fragmentShader, bump, "  vec3 iblGeometricNormal = normalVCVSOutput;\n" + bump);
    // VTK's own D is 0/0 at roughness 0 where H = N, even for a light of intensity 0.
    const std::string direct = "  color += Lo;\n";
    Replace(fragmentShader, direct, "#ifdef IBL_MIRROR\n  Lo = mix(Lo, vec3(0.0), isnan(Lo));\n#endif\n" + direct);
    if (!this->DirectOcclusion)
    {
      Replace(fragmentShader, "  color = mix(color, color * ao, aoStrengthUniform);\n", "");
    }
    Replace(fragmentShader, emission, emission + MakePBRMaterial(fragmentShader, bumped, features) + evaluate + add);
    if (this->OutputEncoding == Linear)
    {
      Replace(fragmentShader, "color = pow(color, vec3(1.0/2.2));", "");
      Replace(fragmentShader, "gl_FragData[0].rgb = pow(gl_FragData[0].rgb, vec3(1.0/2.2));", ""); // 9.7
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
        evaluate + add + "  gl_FragData[0] = vec4(" +
        (this->OutputEncoding == Linear ? "color" : "pow(color, vec3(1.0 / 2.2))") +
        ", opacity);\n  }\n  //VTK::Light::Impl");
  }
  else
  {
    return true;
  }
  // VTK turns the normals of back faces, and takes all faces of a mirrored actor for such.
  Replace(fragmentShader, "(gl_FrontFacing == false) { normalVCVSOutput",
    "(gl_FrontFacing == iblMirrored) { normalVCVSOutput");
  Replace(fragmentShader, "void main()",
    "uniform bool iblMirrored;\n" + this->Lighting->GetShaderChunk(features) + "void main()");
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
  return true;
}

vtkMTimeType vtkIBLRenderPass::GetShaderStageMTime()
{
  return std::max(this->ShaderTime.GetMTime(), this->Lighting->GetShaderTime());
}
