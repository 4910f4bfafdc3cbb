// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLProbe.h"

#include "vtkIBLEnvironment.h"
#include "vtkIBLProbeFile.h"

#include "vtkBoundingBox.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

vtkStandardNewMacro(vtkIBLProbe);

namespace
{
vtkInformationIntegerKey* NotCaptured()
{
  static vtkInformationIntegerKey* const key = vtkInformationIntegerKey::MakeKey("NotCaptured", "vtkIBLProbe");
  return key;
}
}

vtkIBLProbe::vtkIBLProbe() = default;
vtkIBLProbe::~vtkIBLProbe() = default;

void vtkIBLProbe::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const double* numbers, int count)
  {
    os << indent << name << ":";
    for (int i = 0; i < count; ++i)
    {
      os << " " << numbers[i];
    }
    os << "\n";
  };
  const char* const proxies[] = { "Infinite", "Box", "Ellipsoid" };
  const char* const modes[] = { "Once", "OnChange", "Interval", "EveryFrame" };
  print("Position", this->Position, 3);
  os << indent << "Proxy: " << proxies[this->Proxy] << "\n";
  print("Bounds", this->Bounds, 6);
  print("Orientation", this->Orientation, 3);
  if (this->OwnInfluence)
  {
    print("InfluenceBounds", this->InfluenceBounds, 6);
  }
  os << indent << "BlendDistance: " << this->GetBlendDistance() << "\n"
     << indent << "Intensity: " << this->Intensity << "\n"
     << indent << "Environment: " << this->Environment.Get() << "\n"
     << indent << "UpdateMode: " << modes[this->UpdateMode] << "\n"
     << indent << "UpdateInterval: " << this->UpdateInterval << "\n"
     << indent << "TimeBudget: " << this->TimeBudget << "\n"
     << indent << "FadeFrames: " << this->FadeFrames << "\n"
     << indent << "Bounces: " << this->Bounces << "\n"
     << indent << "NumberOfCapturedFaces: " << this->NumberOfCapturedFaces << "\n"
     << indent << "NumberOfUpdates: " << this->NumberOfUpdates << "\n";
}

//------------------------------------------------------------------------------
void vtkIBLProbe::SetPosition(double x, double y, double z)
{
  const double position[3] = { x, y, z };
  if (!std::all_of(position, position + 3, [](double value) { return std::isfinite(value); }))
  {
    vtkErrorMacro("Position is " << x << " " << y << " " << z << "; it takes finite numbers. The old one stays.");
  }
  else if (!std::equal(position, position + 3, this->Position))
  {
    std::copy(position, position + 3, this->Position);
    this->Modified();
  }
}

bool vtkIBLProbe::SetBox(const char* name, double target[6], const double bounds[6])
{
  for (int i = 0; i < 3; ++i)
  {
    const double low = bounds[2 * i];
    const double high = bounds[2 * i + 1];
    if (!(high > low) || !std::isfinite(high - low))
    {
      vtkErrorMacro(<< name << " go from " << low << " to " << high << " along "
                    << "xyz"[i] << "; they take finite numbers, the second above the first. The old ones stay.");
      return false;
    }
  }
  if (!std::equal(bounds, bounds + 6, target))
  {
    std::copy(bounds, bounds + 6, target);
    this->Modified();
  }
  return true;
}

void vtkIBLProbe::SetBounds(const double bounds[6])
{
  this->SetBox("Bounds", this->Bounds, bounds);
}

void vtkIBLProbe::SetBounds(double xmin, double xmax, double ymin, double ymax, double zmin, double zmax)
{
  const double bounds[6] = { xmin, xmax, ymin, ymax, zmin, zmax };
  this->SetBounds(bounds);
}

void vtkIBLProbe::SetOrientation(double x, double y, double z)
{
  const double orientation[3] = { x, y, z };
  if (!std::all_of(orientation, orientation + 3, [](double value) { return std::isfinite(value); }))
  {
    vtkErrorMacro("Orientation is " << x << " " << y << " " << z << "; it takes finite degrees. The old one stays.");
  }
  else if (!std::equal(orientation, orientation + 3, this->Orientation))
  {
    std::copy(orientation, orientation + 3, this->Orientation);
    this->Modified();
  }
}

void vtkIBLProbe::SetInfluenceBounds(const double bounds[6])
{
  if (this->SetBox("InfluenceBounds", this->InfluenceBounds, bounds) && !this->OwnInfluence)
  {
    this->OwnInfluence = true;
    this->Modified();
  }
}

void vtkIBLProbe::SetInfluenceBounds(double xmin, double xmax, double ymin, double ymax, double zmin, double zmax)
{
  const double bounds[6] = { xmin, xmax, ymin, ymax, zmin, zmax };
  this->SetInfluenceBounds(bounds);
}

void vtkIBLProbe::SetInfluenceToBounds()
{
  if (this->OwnInfluence)
  {
    this->OwnInfluence = false;
    this->Modified();
  }
}

void vtkIBLProbe::GetInfluenceBounds(double bounds[6]) const
{
  const double* own = this->OwnInfluence ? this->InfluenceBounds : this->Bounds;
  const double further = this->OwnInfluence ? 0.0 : this->GetBlendDistance();
  for (int i = 0; i < 6; ++i)
  {
    bounds[i] = own[i] + (i % 2 == 0 ? -further : further);
  }
}

void vtkIBLProbe::SetBlendDistance(double distance)
{
  if (std::isnan(distance))
  {
    vtkErrorMacro("BlendDistance is not a number; the old one, " << this->BlendDistance << ", stays.");
  }
  else if (distance != this->BlendDistance)
  {
    this->BlendDistance = distance;
    this->Modified();
  }
}

double vtkIBLProbe::GetBlendDistance() const
{
  const double* bounds = this->OwnInfluence ? this->InfluenceBounds : this->Bounds;
  const double shortest = std::min({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  return this->BlendDistance < 0.0 ? 0.1 * shortest
    : this->OwnInfluence           ? std::min(this->BlendDistance, 0.5 * shortest)
                                   : this->BlendDistance;
}

void vtkIBLProbe::SetIntensity(double intensity)
{
  if (!(intensity >= 0.0) || !std::isfinite(intensity))
  {
    vtkErrorMacro("Intensity is " << intensity << "; it takes a finite number from 0 up. The old one, "
                                  << this->Intensity << ", stays.");
  }
  else if (intensity != this->Intensity)
  {
    this->Intensity = intensity;
    this->Modified();
  }
}

void vtkIBLProbe::FitToScene(vtkRenderer* renderer)
{
  vtkBoundingBox box;
  vtkCollectionSimpleIterator it;
  vtkPropCollection* props = renderer->GetViewProps();
  props->InitTraversal(it);
  while (vtkProp* prop = props->GetNextProp(it))
  {
    const double* bounds =
      prop->GetVisibility() && prop->GetUseBounds() && IsCaptured(prop) ? prop->GetBounds() : nullptr;
    if (bounds && vtkMath::AreBoundsInitialized(bounds))
    {
      box.AddBounds(bounds);
    }
  }
  if (!box.IsValid())
  {
    vtkErrorMacro("There is nothing visible in the scene to fit the probe to; its bounds stay.");
    return;
  }
  // A plane has no thickness, and a proxy must.
  double bounds[6];
  const double thickness = 1e-3 * std::max(box.GetMaxLength(), 1e-3);
  for (int i = 0; i < 3; ++i)
  {
    if (box.GetLength(i) < thickness)
    {
      box.Inflate(i == 0 ? thickness : 0.0, i == 1 ? thickness : 0.0, i == 2 ? thickness : 0.0);
    }
  }
  box.GetBounds(bounds);
  this->SetOrientation(0.0, 0.0, 0.0);
  this->SetBounds(bounds);
  double middle[3];
  box.GetCenter(middle);
  this->SetPosition(middle[0], middle[1], middle[2]);
}

void vtkIBLProbe::SetEnvironment(vtkIBLEnvironment* environment)
{
  if (this->Environment != environment)
  {
    this->Environment = environment;
    this->Modified();
  }
}

vtkIBLEnvironment* vtkIBLProbe::GetEnvironment() const
{
  return this->Environment;
}

void vtkIBLProbe::Capture()
{
  this->CaptureTime.Modified();
}

void vtkIBLProbe::SetCaptured(vtkProp* prop, bool captured)
{
  if (captured == IsCaptured(prop))
  {
    return;
  }
  if (captured)
  {
    prop->GetPropertyKeys()->Remove(NotCaptured());
  }
  else
  {
    if (!prop->GetPropertyKeys())
    {
      vtkNew<vtkInformation> keys;
      prop->SetPropertyKeys(keys);
    }
    prop->GetPropertyKeys()->Set(NotCaptured(), 1);
  }
  prop->Modified();
}

bool vtkIBLProbe::IsCaptured(vtkProp* prop)
{
  vtkInformation* keys = prop->GetPropertyKeys();
  return !keys || !keys->Has(NotCaptured());
}

//------------------------------------------------------------------------------
std::array<std::array<double, 3>, 3> vtkIBLProbe::GetAxes() const
{
  double c[3];
  double s[3];
  for (int i = 0; i < 3; ++i)
  {
    const double angle = vtkMath::RadiansFromDegrees(this->Orientation[i]);
    c[i] = std::cos(angle);
    s[i] = std::sin(angle);
  }
  // Columns of RotateZ RotateX RotateY.
  return { { { c[2] * c[1] - s[2] * s[0] * s[1], s[2] * c[1] + c[2] * s[0] * s[1], -c[0] * s[1] },
    { -s[2] * c[0], c[2] * c[0], s[0] },
    { c[2] * s[1] + s[2] * s[0] * c[1], s[2] * s[1] - c[2] * s[0] * c[1], c[0] * c[1] } } };
}

// Without a proxy its coordinates are those of the influence volume; or, without that, the world's about Position.
void vtkIBLProbe::GetUnitLengths(double lengths[3]) const
{
  const double* bounds = this->Proxy == Infinite ? this->InfluenceBounds : this->Bounds;
  const bool everywhere = this->Proxy == Infinite && !this->OwnInfluence;
  for (int i = 0; i < 3; ++i)
  {
    lengths[i] = everywhere ? 1.0 : 0.5 * (bounds[2 * i + 1] - bounds[2 * i]);
  }
}

void vtkIBLProbe::GetWorldFromUnit(double rows[3][4]) const
{
  const double* bounds = this->Proxy == Infinite ? this->InfluenceBounds : this->Bounds;
  const bool everywhere = this->Proxy == Infinite && !this->OwnInfluence;
  const auto axes = this->GetAxes();
  double lengths[3];
  this->GetUnitLengths(lengths);
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      rows[i][j] = axes[j][i] * lengths[j];
    }
    rows[i][3] = everywhere ? this->Position[i] : 0.5 * (bounds[2 * i] + bounds[2 * i + 1]);
  }
}

void vtkIBLProbe::GetUnitInfluence(double middle[3], double half[3]) const
{
  double outer[6];
  this->GetInfluenceBounds(outer);
  for (int i = 0; i < 3; ++i)
  {
    const double* own = this->Bounds + 2 * i;
    const double size = 0.5 * (own[1] - own[0]);
    middle[i] = this->Proxy == Infinite ? 0.0 : 0.5 * (outer[2 * i] + outer[2 * i + 1] - own[0] - own[1]) / size;
    half[i] = this->Proxy != Infinite ? 0.5 * (outer[2 * i + 1] - outer[2 * i]) / size
      : this->OwnInfluence            ? 1.0
                                      : std::numeric_limits<double>::infinity();
  }
}

double vtkIBLProbe::GetVolume() const
{
  double bounds[6];
  this->GetInfluenceBounds(bounds);
  return this->Proxy == Infinite && !this->OwnInfluence
    ? std::numeric_limits<double>::infinity()
    : (bounds[1] - bounds[0]) * (bounds[3] - bounds[2]) * (bounds[5] - bounds[4]);
}

double vtkIBLProbe::GetReach(const double bounds[6]) const
{
  double rows[3][4];
  double middle[3];
  double half[3];
  this->GetWorldFromUnit(rows);
  this->GetUnitInfluence(middle, half);
  double unit[3];
  this->GetUnitLengths(unit);
  double reach = 1.0;
  for (int j = 0; j < 3; ++j)
  {
    if (std::isinf(half[j]))
    {
      return 1.0;
    }
    // Along the volume's axis j: from where to where the bounds reach, as a projection of their box.
    const double length2 = unit[j] * unit[j];
    double centre = 0.0;
    double extent = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      centre += rows[i][j] * (0.5 * (bounds[2 * i] + bounds[2 * i + 1]) - rows[i][3]);
      extent += std::abs(rows[i][j]) * 0.5 * (bounds[2 * i + 1] - bounds[2 * i]);
    }
    centre = centre / length2 - middle[j];
    extent /= length2;
    // Where volumes only touch, the probe counts nothing; a plane, which has no extent, may well be inside.
    const double edge = half[j] * (1.0 - 1e-9);
    if (centre - extent >= edge || centre + extent <= -edge)
    {
      return 0.0;
    }
    const double overlap = std::min(centre + extent, half[j]) - std::max(centre - extent, -half[j]);
    reach *= extent > 0.0 ? std::max(overlap / (2.0 * extent), 1e-6) : 1.0;
  }
  return reach;
}

//------------------------------------------------------------------------------
bool vtkIBLProbe::WriteFile(const char* fileName, vtkImageData* radiance)
{
  try
  {
    vtkIBLWriteProbeFile(fileName, *this, radiance);
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
}

bool vtkIBLProbe::ReadFile(const char* fileName)
{
  try
  {
    vtkIBLReadProbeFile(fileName, *this);
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
}

bool vtkIBLProbe::CanReadFile(const char* fileName)
{
  return vtkIBLIsProbeFile(fileName);
}
