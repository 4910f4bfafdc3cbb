// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLProbeLight.h"

#include "vtkIBLCubeMap.h"
#include "vtkIBLEnvironment.h"
#include "vtkIBLProbe.h"
#include "vtkIBLProbeCollection.h"
#include "vtkIBLShaderFunctions.h"
#include "vtkIBLStatistics.h"
#include "vtkIBLStopwatch.h"

#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkProp.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace
{
constexpr int AllFaces = 63;
// From a room's far corner to what stands right beside the probe.
constexpr double NearOverFar = 1e-4;
constexpr double SharpestEdge = 1e6; // steepness of a volume without blending

// Which way a face looks, and where its s and t go (docs/conventions.md).
std::array<glm::dvec3, 3> GetFaceAxes(int face)
{
  vtkIBLCore::ShaderFunctions<double> shader;
  const glm::dvec3 forward = shader.iblCubeDirection(face, 0.0, 0.0);
  return { forward, shader.iblCubeDirection(face, 1.0, 0.0) - forward,
    shader.iblCubeDirection(face, 0.0, 1.0) - forward };
}

// In which faces of a cube around `position` something in those bounds may be seen: bits. Of each it's enough that no
// side plane has all of the box behind it.
int FindFaces(const double position[3], const double bounds[6])
{
  glm::dvec3 middle;
  glm::dvec3 half;
  for (int i = 0; i < 3; ++i)
  {
    middle[i] = 0.5 * (bounds[2 * i] + bounds[2 * i + 1]) - position[i];
    half[i] = 0.5 * (bounds[2 * i + 1] - bounds[2 * i]);
  }
  int faces = 0;
  for (int face = 0; face < 6; ++face)
  {
    const std::array<glm::dvec3, 3> axes = GetFaceAxes(face);
    bool isSeen = true;
    for (const glm::dvec3& normal : { axes[0] + axes[1], axes[0] - axes[1], axes[0] + axes[2], axes[0] - axes[2] })
    {
      isSeen = isSeen && glm::dot(normal, middle) + glm::dot(glm::abs(normal), half) >= 0.0;
    }
    faces |= isSeen ? 1 << face : 0;
  }
  return faces;
}

int FindFaces(vtkIBLProbe* probe, vtkProp* prop)
{
  const double* bounds = prop->GetBounds();
  return bounds && vtkMath::AreBoundsInitialized(bounds) ? FindFaces(probe->GetPosition(), bounds) : AllFaces;
}
}

struct vtkIBLProbeLight::Entry
{
  vtkSmartPointer<vtkIBLProbe> Probe;
  int Front = -1; // element that is read
  int Back = -1;  // that is being made
  int Old = -1;   // that fades
  int FramesToFade = 0;
  bool IsSeen = false;

  vtkSmartPointer<vtkIBLCubeMap> Source; // of an environment...
  vtkMTimeType SourceTime = 0;           // ... or a capture on demand: of the light in Front
  std::array<vtkIBLStamp, 6> Stamps;     // of the newest capture
  double StartSeconds = 0.0;             // of it
  int FacesToCapture = 0;                // into Back
  bool HasLevels = false;                // Back
  int LayersToMake = 0;                  // in it: 1 up to this one
  int Bounce = 0;
};

struct vtkIBLProbeLight::Use
{
  const Entry* Of;
  int Element;
  double Most;  // what it counts at most
  double Newer; // and what the newer light of that probe does
};

vtkIBLProbeLight::vtkIBLProbeLight() = default;
vtkIBLProbeLight::~vtkIBLProbeLight() = default;

void vtkIBLProbeLight::Prepare(vtkOpenGLRenderWindow* window, vtkIBLProbeCollection* probes)
{
  const bool isNew = this->Atlas.Prepare(window, probes->GetFaceSize(), probes->GetNumberOfSamples());
  if (isNew)
  {
    this->Entries.clear();
  }
  if (!isNew && probes->GetMTime() == this->CollectionTime)
  {
    return;
  }
  this->CollectionTime = probes->GetMTime();
  std::vector<Entry> entries;
  vtkCollectionSimpleIterator it;
  probes->InitTraversal(it);
  while (vtkIBLProbe* probe = probes->GetNextProbe(it))
  {
    const auto isOfProbe = [probe](const Entry& entry) { return entry.Probe == probe; };
    if (std::none_of(entries.begin(), entries.end(), isOfProbe)) // it can be in there twice
    {
      const auto known = std::find_if(this->Entries.begin(), this->Entries.end(), isOfProbe);
      entries.push_back(known != this->Entries.end() ? std::exchange(*known, Entry()) : Entry());
      entries.back().Probe = probe;
    }
  }
  for (Entry& gone : this->Entries)
  {
    this->Forget(gone);
  }
  this->Entries = std::move(entries);
}

void vtkIBLProbeLight::Forget(Entry& entry)
{
  this->Atlas.Give(entry.Front);
  this->Atlas.Give(entry.Back);
  this->Atlas.Give(entry.Old);
  const vtkSmartPointer<vtkIBLProbe> probe = std::exchange(entry, Entry()).Probe;
  entry.Probe = probe;
}

void vtkIBLProbeLight::ReleaseGraphicsResources()
{
  this->Entries.clear();
  this->Atlas = vtkIBLProbeAtlas();
}

vtkSmartPointer<vtkImageData> vtkIBLProbeLight::Read(const vtkIBLProbe* probe) const
{
  const auto found = std::find_if(
    this->Entries.begin(), this->Entries.end(), [probe](const Entry& entry) { return entry.Probe == probe; });
  return found != this->Entries.end() && found->Front >= 0 ? this->Atlas.Read(found->Front) : nullptr;
}

//------------------------------------------------------------------------------
void vtkIBLProbeLight::Update(const Scene& scene, vtkIBLStatistics* statistics)
{
  this->Statistics = statistics;
  this->PropStamps.clear();
  for (Entry& entry : this->Entries)
  {
    entry.IsSeen = entry.Probe == this->Wanted ||
      std::any_of(scene.LitBounds.begin(), scene.LitBounds.end(),
        [&](const std::array<double, 6>& bounds) { return entry.Probe->GetReach(bounds.data()) > 0.0; });
  }
  for (Entry& entry : this->Entries)
  {
    if (!entry.IsSeen)
    {
      continue;
    }
    if (entry.Old >= 0)
    {
      this->Time.Modified();
      if (--entry.FramesToFade <= 0)
      {
        this->Atlas.Give(entry.Old);
      }
    }
    const vtkIBLStopwatch stopwatch;
    const double budget = entry.Front >= 0 && entry.Probe != this->Wanted ? 1e-3 * entry.Probe->GetTimeBudget() : 0.0;
    do
    {
      if (entry.Back < 0 && !this->Begin(scene, entry))
      {
        break;
      }
      this->Step(scene, entry, budget > 0.0);
      if (budget > 0.0)
      {
        glFinish(); // or all of it is still before the GPU
      }
    } while (budget == 0.0 ? entry.Back >= 0 || entry.Bounce > 0 : stopwatch.GetSeconds() < budget);
  }
  this->Statistics = nullptr;
}

// An element for new light. When there is none left, of a probe that nobody sees: its light will be made again.
bool vtkIBLProbeLight::Take(int& element)
{
  std::optional<int> taken = this->Atlas.Take();
  for (auto entry = this->Entries.begin(); !taken && entry != this->Entries.end(); ++entry)
  {
    if (!entry->IsSeen && entry->Front >= 0)
    {
      this->Forget(*entry);
      taken = this->Atlas.Take();
    }
  }
  if (!taken && !this->IsFull)
  {
    this->IsFull = true;
    vtkGenericWarningMacro("More than " << vtkIBLProbeAtlas::MostElements - 2
                                        << " probes light surfaces in sight; the sky stands in for the others.");
  }
  element = taken.value_or(-1);
  return taken.has_value();
}

// Whether there is new light to be made, with an element for it.
bool vtkIBLProbeLight::Begin(const Scene& scene, Entry& entry)
{
  vtkIBLProbe* probe = entry.Probe;
  if (vtkIBLEnvironment* environment = probe->GetEnvironment())
  {
    if (!entry.Source || entry.Source->GetEnvironment() != environment)
    {
      entry.Source = vtkSmartPointer<vtkIBLCubeMap>::New();
      entry.Source->SetEnvironment(environment);
      entry.Source->SetFaceSize(this->Atlas.GetFaceSize());
      entry.SourceTime = 0;
    }
    if (!environment->Update() || environment->GetRadianceTime() == entry.SourceTime ||
      !entry.Source->Update(scene.Window) || !this->Take(entry.Back))
    {
      return false;
    }
    entry.SourceTime = environment->GetRadianceTime();
    entry.Stamps = {};
    entry.HasLevels = true;
    entry.LayersToMake = this->Atlas.GetNumberOfLayers();
    this->Atlas.CopyLevels(entry.Source->GetTexture(), entry.Back);
    entry.Source->ReleaseGraphicsResources(scene.Window);
    return true;
  }

  entry.Source = nullptr;
  const double now = vtkTimerLog::GetUniversalTime();
  const bool isFirst = entry.Front < 0 || entry.Stamps == std::array<vtkIBLStamp, 6>();
  int faces = 0;
  if (isFirst || entry.Bounce > 0 || probe->GetUpdateMode() == vtkIBLProbe::EveryFrame ||
    probe->GetCaptureTime() > entry.SourceTime ||
    (probe->GetUpdateMode() == vtkIBLProbe::Interval && now - entry.StartSeconds >= 1e-3 * probe->GetUpdateInterval()))
  {
    faces = AllFaces;
  }
  else if (probe->GetUpdateMode() == vtkIBLProbe::OnChange)
  {
    const std::array<vtkIBLStamp, 6> stamps = this->StampFaces(scene, probe);
    for (int face = 0; face < 6; ++face)
    {
      faces |= stamps[face] == entry.Stamps[face] ? 0 : 1 << face;
    }
    if (probe->GetBounces() > 0 && faces != 0)
    {
      faces = AllFaces; // what moved lights what it doesn't hide
    }
  }
  if (faces == 0 || !this->Take(entry.Back))
  {
    return false;
  }
  entry.StartSeconds = now;
  entry.SourceTime = probe->GetCaptureTime();
  entry.FacesToCapture = faces;
  entry.HasLevels = false;
  entry.LayersToMake = this->Atlas.GetNumberOfLayers();
  if (faces != AllFaces)
  {
    this->Atlas.CopyFaces(entry.Front, entry.Back);
  }
  return true;
}

// What each face shows.
std::array<vtkIBLStamp, 6> vtkIBLProbeLight::StampFaces(const Scene& scene, vtkIBLProbe* probe)
{
  if (this->PropStamps.empty())
  {
    for (vtkProp* prop : scene.Captured)
    {
      this->PropStamps.emplace_back();
      this->PropStamps.back().AddPropWithParts(prop);
    }
  }
  std::array<vtkIBLStamp, 6> stamps;
  for (vtkIBLStamp& stamp : stamps)
  {
    stamp.Add(probe->GetPosition(), 3);
    stamp.Add(std::uint64_t(probe->GetBounces()));
    stamp.Add(scene.Light);
  }
  for (std::size_t i = 0; i < scene.Captured.size(); ++i)
  {
    const int faces = FindFaces(probe, scene.Captured[i]);
    for (int face = 0; face < 6; ++face)
    {
      if (faces >> face & 1)
      {
        stamps[face].Add(this->PropStamps[i]);
      }
    }
  }
  return stamps;
}

// A face, mip levels, a layer; or, not cut up, all of either.
void vtkIBLProbeLight::Step(const Scene& scene, Entry& entry, bool cutUp)
{
  const vtkIBLStopwatch stopwatch;
  const vtkTypeInt64 face = vtkTypeInt64(this->Atlas.GetFaceSize()) * this->Atlas.GetFaceSize();
  if (entry.FacesToCapture != 0)
  {
    int count = 0;
    int captured = 0; // bits
    do
    {
      int next = 0;
      while (!(entry.FacesToCapture >> next & 1))
      {
        ++next;
      }
      this->CaptureFace(scene, entry, next);
      entry.FacesToCapture &= ~(1 << next);
      captured |= 1 << next;
      ++count;
    } while (!cutUp && entry.FacesToCapture != 0);
    // Now, since drawing makes buffers and computes matrices, which changes what was drawn.
    this->PropStamps.clear();
    const std::array<vtkIBLStamp, 6> stamps = this->StampFaces(scene, entry.Probe);
    for (int i = 0; i < 6; ++i)
    {
      if (captured >> i & 1)
      {
        entry.Stamps[i] = stamps[i];
      }
    }
    entry.Probe->Count(count, 0);
    this->Statistics->Add(
      { vtkIBLStatistics::ProbeFaces, count, count * face, 16 * count * face, stopwatch.GetSeconds() });
    return;
  }
  if (!entry.HasLevels)
  {
    this->Atlas.MakeLevels(entry.Back);
    entry.HasLevels = true;
    if (cutUp)
    {
      return;
    }
  }
  const int last = entry.LayersToMake;
  const int first = cutUp ? last : 1;
  const double scale =
    entry.Probe->GetEnvironment() ? entry.Probe->GetEnvironment()->GetMeanLuminance() : scene.StoredScale;
  this->Atlas.MakeLayers(entry.Back, first, last, scale > 0.0 ? scale : 1.0);
  entry.LayersToMake = first - 1;
  const vtkTypeInt64 texels = this->Atlas.CountTexels(first, last);
  this->Statistics->Add(
    { vtkIBLStatistics::ProbeLayers, last - first + 1, texels, 8 * texels, stopwatch.GetSeconds() });
  if (entry.LayersToMake == 0)
  {
    this->Finish(entry);
  }
}

void vtkIBLProbeLight::Finish(Entry& entry)
{
  std::swap(entry.Front, entry.Back);
  // A further bounce goes on with the fade that the first began.
  if (entry.Probe->GetFadeFrames() > 0 && entry.Back >= 0 && entry.Bounce == 0)
  {
    std::swap(entry.Old, entry.Back);
    entry.FramesToFade = entry.Probe->GetFadeFrames();
  }
  this->Atlas.Give(entry.Back);
  const bool isCapture = !entry.Probe->GetEnvironment();
  entry.Bounce = isCapture && entry.Bounce < entry.Probe->GetBounces() ? entry.Bounce + 1 : 0;
  entry.Probe->Count(0, entry.Bounce == 0 ? 1 : 0);
  this->Time.Modified();
}

void vtkIBLProbeLight::CaptureFace(const Scene& scene, Entry& entry, int face)
{
  const double* position = entry.Probe->GetPosition();
  double farthest2 = 0.0;
  std::vector<vtkProp*> props;
  for (vtkProp* prop : scene.Captured)
  {
    if (FindFaces(entry.Probe, prop) >> face & 1)
    {
      props.push_back(prop);
      const double* bounds = prop->GetBounds();
      double distance2 = 0.0;
      for (int i = 0; bounds && i < 3; ++i)
      {
        const double reach = std::max(std::abs(bounds[2 * i] - position[i]), std::abs(bounds[2 * i + 1] - position[i]));
        distance2 += reach * reach;
      }
      farthest2 = std::max(farthest2, distance2);
    }
  }
  const double farthest = farthest2 > 0.0 ? 1.001 * std::sqrt(farthest2) : 1.0;
  const double nearest = NearOverFar * farthest;
  const std::array<glm::dvec3, 3> axes = GetFaceAxes(face);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(position);
  // Far enough off for the direction to have digits where coordinates are huge.
  const double reach = farthest + vtkMath::Norm(position);
  camera->SetFocalPoint(
    position[0] + reach * axes[0].x, position[1] + reach * axes[0].y, position[2] + reach * axes[0].z);
  camera->SetViewUp(axes[2].x, axes[2].y, axes[2].z); // row 0 is at t = -1
  camera->SetClippingRange(nearest, farthest);
  // 90 degrees, whatever the shape of the window.
  vtkNew<vtkMatrix4x4> projection;
  projection->SetElement(2, 2, -(farthest + nearest) / (farthest - nearest));
  projection->SetElement(2, 3, -2.0 * farthest * nearest / (farthest - nearest));
  projection->SetElement(3, 2, -1.0);
  projection->SetElement(3, 3, 0.0);
  camera->SetExplicitProjectionTransformMatrix(projection);
  camera->UseExplicitProjectionTransformMatrixOn();
  scene.Draw(camera, this->Atlas.AttachFace(entry.Back, face), this->Atlas.GetFaceSize(), props, entry.Bounce > 0);
}

//------------------------------------------------------------------------------
// What lights an actor: of the probes that reach into it most those on top first, small ones.
std::vector<vtkIBLProbeLight::Use> vtkIBLProbeLight::Choose(const double bounds[6]) const
{
  struct Candidate
  {
    const Entry* Of;
    double Reach, Volume;
  };
  std::vector<Candidate> candidates;
  for (const Entry& entry : this->Entries)
  {
    const double reach = entry.Front >= 0 ? entry.Probe->GetReach(bounds) : 0.0;
    if (reach > 0.0)
    {
      candidates.push_back({ &entry, reach, entry.Probe->GetVolume() });
    }
  }
  const auto byReach = [](const Candidate& a, const Candidate& b)
  { return std::tie(b.Reach, a.Volume) < std::tie(a.Reach, b.Volume); };
  std::stable_sort(candidates.begin(), candidates.end(), byReach);
  candidates.resize(std::min<std::size_t>(candidates.size(), IBL_MAXIMUM_PROBES));
  std::stable_sort(
    candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.Volume < b.Volume; });
  std::vector<Use> uses;
  for (const Candidate& candidate : candidates)
  {
    const Entry& entry = *candidate.Of;
    const double newer = entry.Old < 0 ? 1.0 : 1.0 - double(entry.FramesToFade) / (entry.Probe->GetFadeFrames() + 1);
    uses.push_back({ &entry, entry.Front, newer, 0.0 });
    if (entry.Old >= 0)
    {
      uses.push_back({ &entry, entry.Old, 1.0 - newer, newer });
    }
  }
  uses.resize(std::min<std::size_t>(uses.size(), IBL_MAXIMUM_PROBES));
  return uses;
}

void vtkIBLProbeLight::SetShaderParameters(vtkShaderProgram* program, vtkRenderer* renderer, const double* bounds) const
{
  program->SetUniformi("iblProbeRadiance", this->Atlas.GetRadianceUnit());
  program->SetUniformi("iblProbeOddLayers", this->Atlas.GetOddUnit());
  program->SetUniformi("iblProbeEvenLayers", this->Atlas.GetEvenUnit());
  program->SetUniformf("iblProbeLayers", float(this->Atlas.GetNumberOfLayers()));
  const std::vector<Use> uses = bounds ? this->Choose(bounds) : std::vector<Use>();
  program->SetUniformi("iblProbeCount", int(uses.size()));
  if (uses.empty())
  {
    return;
  }
  float numbers[IBL_MAXIMUM_PROBES * IBL_PROBE_NUMBERS][4] = {};
  auto* row = numbers;
  const auto put = [&row](double x, double y, double z, double w)
  {
    const double values[4] = { x, y, z, w };
    std::copy(values, values + 4, *row++);
  };
  for (const Use& use : uses)
  {
    vtkIBLProbe* probe = use.Of->Probe;
    double rows[3][4];
    probe->GetWorldFromUnit(rows);
    vtkNew<vtkMatrix4x4> worldFromUnit;
    for (int i = 0; i < 3; ++i)
    {
      std::copy(rows[i], rows[i] + 4, worldFromUnit->Element[i]);
    }
    // In double, up to here: what is far from the origin is near the camera.
    vtkNew<vtkMatrix4x4> viewFromUnit;
    vtkMatrix4x4::Multiply4x4(renderer->GetActiveCamera()->GetModelViewTransformMatrix(), worldFromUnit, viewFromUnit);
    vtkNew<vtkMatrix4x4> unitFromView;
    vtkMatrix4x4::Invert(viewFromUnit, unitFromView);
    for (int i = 0; i < 3; ++i)
    {
      const double* element = unitFromView->Element[i];
      put(element[0], element[1], element[2], element[3]);
    }
    double cubeFromWorld[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    double scale[3] = { 1, 1, 1 };
    if (vtkIBLEnvironment* environment = probe->GetEnvironment())
    {
      environment->GetEnvironmentFromWorld(&cubeFromWorld[0][0]);
      environment->GetRadianceScale(scale);
    }
    const double* position = probe->GetPosition();
    for (int i = 0; i < 3; ++i)
    {
      double cubeFromUnit[4] = {};
      for (int j = 0; j < 4; ++j)
      {
        for (int k = 0; k < 3; ++k)
        {
          cubeFromUnit[j] += cubeFromWorld[i][k] * (rows[k][j] - (j == 3 ? position[k] : 0.0));
        }
      }
      put(cubeFromUnit[0], cubeFromUnit[1], cubeFromUnit[2], cubeFromUnit[3]);
    }
    double middle[3];
    double half[3];
    probe->GetUnitInfluence(middle, half);
    const double shape = probe->GetProxy() == vtkIBLProbe::Infinite ? IBL_PROXY_NONE
      : probe->GetProxy() == vtkIBLProbe::Box                       ? IBL_PROXY_BOX
                                                                    : IBL_PROXY_BALL;
    put(middle[0], middle[1], middle[2], shape);
    put(1.0 / half[0], 1.0 / half[1], 1.0 / half[2], 0.0);
    double unit[3];
    probe->GetUnitLengths(unit);
    double steepness[3];
    double steepest = 0.0; // so that an ellipsoid's blend is nowhere wider than asked
    for (int j = 0; j < 3; ++j)
    {
      steepness[j] = std::min(half[j] * unit[j] / probe->GetBlendDistance(), SharpestEdge);
      steepest = std::max(steepest, steepness[j]);
    }
    const bool isBall = shape == IBL_PROXY_BALL;
    put(isBall ? steepest : steepness[0], steepness[1], steepness[2], 0.0);
    const double stored = this->Atlas.GetStoredScale(use.Element);
    const double factor = probe->GetIntensity() * stored;
    put(factor * scale[0], factor * scale[1], factor * scale[2], stored);
    put(use.Element, use.Most, use.Newer, double(use.Of - this->Entries.data()));
  }
  program->SetUniform4fv("iblProbeNumbers", int(uses.size()) * IBL_PROBE_NUMBERS, numbers);
}
