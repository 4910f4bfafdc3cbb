// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLRenderView.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLImageReader.h"
#include "vtkIBLLighting.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLRenderPass.h"
#include "vtkIBLSpecularChain.h"
#include "vtkIBLStatistics.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFXAAFilter.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPVServerInformation.h"
#include "vtkPVSession.h"
#include "vtkPVSynchronizedRenderer.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

vtkStandardNewMacro(vtkIBLRenderView);

namespace
{
constexpr int FileTag = 0x1b1; // of messages between client and server

// What ParaView puts among the data: no part of the scene that surfaces are to see.
bool IsOrnament(vtkProp* prop)
{
  const char* const kinds[] = { "vtkPVCenterAxesActor", "vtkGridAxesActor3D", "vtkPolarAxesActor", "vtkFlagpoleLabel",
    "vtkBillboardTextActor3D", "vtkSkybox", "vtkWidgetRepresentation" };
  return std::any_of(std::begin(kinds), std::end(kinds), [prop](const char* kind) { return prop->IsA(kind); });
}
}

vtkIBLRenderView::vtkIBLRenderView()
{
  this->Pass->SetEnvironment(this->Environment);
  this->SynchronizedRenderers->SetRenderPass(this->Pass);
  // After SynchronizedRenderers' own observer, which was there before.
  this->GetRenderer()->AddObserver(vtkCommand::EndEvent, this, &vtkIBLRenderView::OnSceneRendered);
}

vtkIBLRenderView::~vtkIBLRenderView() = default;

void vtkIBLRenderView::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EnvironmentLighting: " << this->EnvironmentLighting << "\n"
     << indent << "EnvironmentVisible: " << this->EnvironmentVisible << "\n"
     << indent << "EnvironmentFileName: " << this->FileName << "\n"
     << indent << "ProbeMode: " << this->ProbeMode << "\n"
     << indent << "ProbeFitsData: " << this->ProbeFitsData << "\n"
     << indent << "Pass:\n";
  this->Pass->PrintSelf(os, indent.GetNextIndent());
}

void vtkIBLRenderView::SetEnvironmentLighting(bool on)
{
  if (on != this->EnvironmentLighting)
  {
    this->EnvironmentLighting = on;
    this->SynchronizedRenderers->SetRenderPass(on ? this->Pass.Get() : nullptr);
  }
}

void vtkIBLRenderView::SetEnvironmentFileName(const char* fileName)
{
  this->FileName = fileName ? fileName : "";
  this->FileIsNew = true;
}

void vtkIBLRenderView::SetEnvironmentUp(double x, double y, double z)
{
  this->Environment->SetUp(x, y, z);
}

void vtkIBLRenderView::SetEnvironmentRotation(double degrees)
{
  this->Environment->SetRotation(degrees);
}

void vtkIBLRenderView::SetEnvironmentIntensity(double intensity)
{
  this->Environment->SetIntensity(intensity);
}

void vtkIBLRenderView::SetNormalizeExposure(bool normalize)
{
  this->Environment->SetNormalizeExposure(normalize);
}

void vtkIBLRenderView::SetEnvironmentVisible(bool visible)
{
  this->EnvironmentVisible = visible;
}

void vtkIBLRenderView::SetEnvironmentBlur(double blur)
{
  this->Pass->SetBackgroundBlur(blur);
}

void vtkIBLRenderView::SetLightNonPBR(bool on)
{
  this->Pass->SetLightNonPBR(on);
}

void vtkIBLRenderView::SetTranslucentFresnel(bool on)
{
  this->Pass->SetTranslucentFresnel(on);
}

void vtkIBLRenderView::SetErrorTolerance(double tolerance)
{
  this->Pass->GetLighting()->GetSpecularChain()->SetErrorTolerance(tolerance);
}

void vtkIBLRenderView::SetBrightTexels(bool on)
{
  this->Pass->GetLighting()->SetBrightTexels(on);
}

void vtkIBLRenderView::SetEnvironmentSamples(int samplesPerPixel)
{
  this->Pass->GetLighting()->SetSamplesPerPixel(samplesPerPixel);
}

void vtkIBLRenderView::SetProbeMode(int mode)
{
  this->ProbeMode = mode;
  this->ProbeIsNew = true;
}

void vtkIBLRenderView::SetProbeFitsData(bool fits)
{
  this->ProbeFitsData = fits;
  this->ProbeIsNew = true;
}

void vtkIBLRenderView::SetProbeBounds(double xmin, double xmax, double ymin, double ymax, double zmin, double zmax)
{
  const double bounds[6] = { xmin, xmax, ymin, ymax, zmin, zmax };
  std::copy(bounds, bounds + 6, this->ProbeBounds);
  this->ProbeIsNew = true;
}

void vtkIBLRenderView::SetProbePosition(double x, double y, double z)
{
  const double position[3] = { x, y, z };
  std::copy(position, position + 3, this->ProbePosition);
  this->ProbeIsNew = true;
}

void vtkIBLRenderView::SetProbeBounces(int bounces)
{
  this->Probe->SetBounces(bounces);
  this->ProbeIsNew = true;
}

void vtkIBLRenderView::SetProbeFaceSize(int faceSize)
{
  this->Pass->GetProbes()->SetFaceSize(faceSize);
}

void vtkIBLRenderView::CaptureProbe()
{
  this->Probe->Capture();
}

const char* vtkIBLRenderView::GetStatisticsText()
{
  const vtkIBLStatistics* statistics = this->Pass->GetLighting()->GetStatistics();
  std::ostringstream text;
  text << std::fixed << std::setprecision(1);
  for (int kind = 0; kind < vtkIBLStatistics::Total; ++kind)
  {
    if (const auto count = statistics->GetCount(kind))
    {
      text << vtkIBLStatistics::GetKindName(kind) << ": " << count << " in " << 1000.0 * statistics->GetSeconds(kind)
           << " ms\n";
    }
  }
  this->StatisticsText = text.str();
  return this->StatisticsText.c_str();
}

vtkIBLRenderPass* vtkIBLRenderView::GetPass()
{
  return this->Pass;
}

//------------------------------------------------------------------------------
void vtkIBLRenderView::Update()
{
  if (this->FileIsNew)
  {
    this->FileIsNew = false;
    if (!this->FileName.empty()) // else see UpdateBackground()
    {
      this->TakeFile();
    }
  }
  this->Superclass::Update();
}

// Whether this process is all there is.
bool vtkIBLRenderView::IsAlone()
{
  vtkPVSession* session = this->GetSession();
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  return !session->GetController(vtkPVSession::RENDER_SERVER) && !session->GetController(vtkPVSession::CLIENT) &&
    (!ranks || ranks->GetNumberOfProcesses() == 1);
}

// Whether this process reads the file and shows the picture.
bool vtkIBLRenderView::IsClient()
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  return (this->GetSession()->GetProcessRoles() & vtkPVSession::CLIENT) != 0 &&
    (!ranks || ranks->GetLocalProcessId() == 0);
}

// As vtkNetworkImageSource does with ParaView's textures. What can't be read is sent as an empty picture, for nobody
// may wait in vain; the last good light stays.
void vtkIBLRenderView::TakeFile()
{
  vtkPVSession* session = this->GetSession();
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  vtkMultiProcessController* server = session->GetController(vtkPVSession::RENDER_SERVER);
  vtkMultiProcessController* client = session->GetController(vtkPVSession::CLIENT);
  const bool hasRanks = ranks && ranks->GetNumberOfProcesses() > 1;
  if (this->IsAlone())
  {
    this->Environment->SetFileName(this->FileName.c_str());
    return;
  }
  vtkSmartPointer<vtkImageData> image = vtkSmartPointer<vtkImageData>::New();
  if (this->IsClient())
  {
    vtkNew<vtkIBLImageReader> reader;
    reader->SetFileName(this->FileName.c_str());
    reader->SetMaximumWidth(this->Environment->GetMaximumWidth());
    reader->Update();
    image = reader->GetOutput();
  }
  int size[3];
  image->GetDimensions(size);
  const auto pass = [&size, &image](const auto& passInts, const auto& passFloats)
  {
    passInts(size, 3);
    const vtkIdType floats = vtkIdType(3) * size[0] * size[1] * size[2];
    if (floats == 0)
    {
      return;
    }
    if (image->GetNumberOfPoints() == 0)
    {
      image->SetDimensions(size);
      image->AllocateScalars(VTK_FLOAT, 3);
    }
    passFloats(static_cast<float*>(image->GetScalarPointer()), floats);
  };
  if (server)
  {
    pass([&](int* data, vtkIdType n) { server->Send(data, n, 1, FileTag); },
      [&](float* data, vtkIdType n) { server->Send(data, n, 1, FileTag); });
  }
  if (client)
  {
    pass([&](int* data, vtkIdType n) { client->Receive(data, n, 1, FileTag); },
      [&](float* data, vtkIdType n) { client->Receive(data, n, 1, FileTag); });
  }
  if (hasRanks)
  {
    pass([&](int* data, vtkIdType n) { ranks->Broadcast(data, n, 0); },
      [&](float* data, vtkIdType n) { ranks->Broadcast(data, n, 0); });
  }
  if (image->GetNumberOfPoints() > 0)
  {
    this->Environment->SetInputData(image);
  }
}

void vtkIBLRenderView::UpdateBackground(vtkRenderer* renderer)
{
  this->Superclass::UpdateBackground(renderer);
  if (!this->EnvironmentLighting || (renderer && renderer != this->GetRenderer()))
  {
    return;
  }
  renderer = this->GetRenderer();
  vtkTexture* texture = renderer->GetUseImageBasedLighting() ? renderer->GetEnvironmentTexture() : nullptr;
  renderer->SetUseImageBasedLighting(false); // else surfaces get it twice
  if (this->EnvironmentVisible)
  {
    renderer->SetTexturedBackground(false);
    renderer->SetGradientBackground(false);
    renderer->SetBackground(0.0, 0.0, 0.0); // OnSceneRendered() adds to it
  }
  if (this->FileName.empty())
  {
    this->Environment->SetInputConnection(texture ? texture->GetInputConnection(0, 0) : nullptr);
  }
}

// Whether the picture is put together of those of other processes, which then must have no background.
bool vtkIBLRenderView::IsComposited()
{
  return this->SynchronizedRenderers->GetEnabled() && !this->IsAlone();
}

// Where the visible data is, and its age: seven numbers a prop. Colours are not in it.
std::vector<double> vtkIBLRenderView::GetShownData()
{
  std::vector<double> shown;
  vtkCollectionSimpleIterator it;
  vtkPropCollection* props = this->GetRenderer()->GetViewProps();
  props->InitTraversal(it);
  while (vtkProp* prop = props->GetNextProp(it))
  {
    if (IsOrnament(prop))
    {
      vtkIBLProbe::SetCaptured(prop, false);
      continue;
    }
    const double* bounds = prop->GetVisibility() && prop->GetUseBounds() ? prop->GetBounds() : nullptr;
    if (bounds && vtkMath::AreBoundsInitialized(bounds))
    {
      vtkActor* actor = vtkActor::SafeDownCast(prop);
      vtkDataObject* data = actor && actor->GetMapper() ? actor->GetMapper()->GetInputDataObject(0, 0) : nullptr;
      shown.insert(shown.end(), bounds, bounds + 6);
      shown.push_back(data ? double(data->GetMTime()) : 0.0);
    }
  }
  return shown;
}

void vtkIBLRenderView::UpdateProbe()
{
  const bool isPiece = this->GetUseDistributedRenderingForRender() &&
    this->GetSession()->GetServerInformation()->GetNumberOfProcesses() > 1;
  if (isPiece && this->ProbeMode != NoProbe && this->IsClient() && !this->SaidNoProbe)
  {
    this->SaidNoProbe = true;
    vtkWarningMacro("ProbeMode is without effect: several processes draw this view, a piece of the scene each. Raise "
                    "RemoteRenderThreshold, or use one process.");
  }
  vtkIBLProbeCollection* probes = this->Pass->GetProbes();
  std::vector<double> shown;
  if (this->ProbeMode != NoProbe && !isPiece)
  {
    shown = this->GetShownData();
  }
  if (shown.empty())
  {
    probes->RemoveItem(this->Probe);
    return;
  }
  if (!probes->IsItemPresent(this->Probe))
  {
    probes->AddItem(this->Probe);
  }
  if (!this->ProbeIsNew && shown == this->ShownData)
  {
    return;
  }
  this->ProbeIsNew = false;
  this->ShownData = std::move(shown);
  if (this->ProbeFitsData)
  {
    this->Probe->FitToScene(this->GetRenderer());
  }
  else
  {
    this->Probe->SetBounds(this->ProbeBounds);
    this->Probe->SetPosition(this->ProbePosition[0], this->ProbePosition[1], this->ProbePosition[2]);
  }
  if (this->ProbeMode == StaticProbe)
  {
    this->Probe->Capture();
  }
}

void vtkIBLRenderView::AboutToRenderOnLocalProcess(bool interactive)
{
  // Coarser data, while somebody drags, is no news: the probe stays as it is, and need not change back.
  const bool isCoarse = interactive && this->GetUseLODForInteractiveRender();
  this->Probe->SetUpdateMode(isCoarse || this->ProbeMode == StaticProbe ? vtkIBLProbe::Once : vtkIBLProbe::OnChange);
  if (!isCoarse && !this->GetMakingSelection())
  {
    this->UpdateProbe();
  }
  const bool visible = this->EnvironmentLighting && this->EnvironmentVisible && !this->GetMakingSelection();
  this->AddsBackground = visible && this->IsComposited() && this->IsClient();
  this->Pass->SetBackgroundVisible(this->EnvironmentVisible && !this->IsComposited());
  vtkRenderer* renderer = this->GetRenderer();
  this->AddsFXAA = this->AddsBackground && renderer->GetUseFXAA();
  if (this->AddsFXAA)
  {
    renderer->SetUseFXAA(false); // it would make edges against the black that is there before the background
  }
  this->Superclass::AboutToRenderOnLocalProcess(interactive);
}

void vtkIBLRenderView::OnSceneRendered()
{
  if (this->AddsBackground)
  {
    this->Pass->RenderBackgroundBehind(this->GetRenderer());
  }
  if (this->AddsFXAA)
  {
    this->FXAA->UpdateConfiguration(this->GetRenderer()->GetFXAAOptions());
    this->FXAA->Execute(static_cast<vtkOpenGLRenderer*>(this->GetRenderer()));
  }
}
