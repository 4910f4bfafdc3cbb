// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLEnvironment.h"

#include "vtkIBLImageReader.h"
#include "vtkIBLRadianceImage.h"
#include "vtkIBLStudio.h"

#include "vtkAlgorithmOutput.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkIBLEnvironment);

namespace
{
constexpr int StudioWidth = 512;

vtkIBLRadianceImage View(vtkImageData* image)
{
  vtkIBLRadianceImage view;
  if (image)
  {
    int dimensions[3];
    image->GetDimensions(dimensions);
    view.RGB = static_cast<float*>(image->GetScalarPointer());
    view.Width = dimensions[0];
    view.Height = dimensions[1];
    view.Faces = dimensions[2];
  }
  return view;
}

vtkSmartPointer<vtkImageData> MakeImage(int width, int height, int faces)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, faces);
  image->AllocateScalars(VTK_FLOAT, 3);
  return image;
}

vtkSmartPointer<vtkImageData> MakeStudio()
{
  auto studio = MakeImage(StudioWidth, StudioWidth / 2, 1);
  vtkIBLMakeStudio(View(studio));
  return studio;
}

// IEC 61966-2-1.
double LinearFromSRGB(double x)
{
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}
}

vtkIBLEnvironment::vtkIBLEnvironment()
{
  this->Reader->SetMaximumWidth(4096);
  this->SourceTime.Modified();
}

vtkIBLEnvironment::~vtkIBLEnvironment() = default;

void vtkIBLEnvironment::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName.empty() ? "(none)" : this->FileName) << "\n"
     << indent << "Producer: " << this->Producer.Get() << "\n"
     << indent << "Up: " << this->Up[0] << " " << this->Up[1] << " " << this->Up[2] << "\n"
     << indent << "Right: " << this->Right[0] << " " << this->Right[1] << " " << this->Right[2] << "\n"
     << indent << "Rotation: " << this->Rotation << "\n"
     << indent << "Intensity: " << this->Intensity << "\n"
     << indent << "Tint: " << this->Tint[0] << " " << this->Tint[1] << " " << this->Tint[2] << "\n"
     << indent << "NormalizeExposure: " << this->NormalizeExposure << "\n"
     << indent << "MeanLuminance: " << this->MeanLuminance << "\n"
     << indent << "NumberOfNotFiniteTexels: " << this->NumberOfNotFiniteTexels << "\n"
     << indent << "NumberOfTooLargeTexels: " << this->NumberOfTooLargeTexels << "\n"
     << indent << "NumberOfNegativeTexels: " << this->NumberOfNegativeTexels << "\n";
}

//------------------------------------------------------------------------------
void vtkIBLEnvironment::SourceModified()
{
  this->SourceTime.Modified();
  this->Modified();
}

void vtkIBLEnvironment::SetSource(const char* fileName, vtkAlgorithm* producer, int port)
{
  const std::string name = fileName ? fileName : "";
  if (name != this->FileName || producer != this->Producer || port != this->ProducerPort)
  {
    this->FileName = name;
    this->Producer = producer;
    this->ProducerPort = port;
    this->SourceModified();
  }
}

void vtkIBLEnvironment::SetFileName(const char* fileName)
{
  this->SetSource(fileName, nullptr, 0);
}

const char* vtkIBLEnvironment::GetFileName() const
{
  return this->FileName.empty() ? nullptr : this->FileName.c_str();
}

void vtkIBLEnvironment::SetInputConnection(vtkAlgorithmOutput* output)
{
  this->SetSource(nullptr, output ? output->GetProducer() : nullptr, output ? output->GetIndex() : 0);
}

void vtkIBLEnvironment::SetInputData(vtkImageData* image)
{
  vtkSmartPointer<vtkTrivialProducer> producer;
  if (image)
  {
    producer = vtkSmartPointer<vtkTrivialProducer>::New();
    producer->SetOutput(image);
  }
  this->SetSource(nullptr, producer, 0);
}

void vtkIBLEnvironment::SetColorSpace(int colorSpace)
{
  if (colorSpace != this->Reader->GetColorSpace())
  {
    this->Reader->SetColorSpace(colorSpace);
    this->SourceModified();
  }
}

int vtkIBLEnvironment::GetColorSpace() const
{
  return this->Reader->GetColorSpace();
}

void vtkIBLEnvironment::SetMaximumWidth(int width)
{
  if (width != this->Reader->GetMaximumWidth())
  {
    this->Reader->SetMaximumWidth(width);
    this->SourceModified();
  }
}

int vtkIBLEnvironment::GetMaximumWidth() const
{
  return this->Reader->GetMaximumWidth();
}

//------------------------------------------------------------------------------
bool vtkIBLEnvironment::SetAxis(const char* name, double axis[3], double x, double y, double z)
{
  const double length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    vtkErrorMacro(<< name << " is (" << x << ", " << y << ", " << z
                  << "); a direction is finite and not zero. The old one stays.");
    return false;
  }
  if (axis[0] != x || axis[1] != y || axis[2] != z)
  {
    axis[0] = x;
    axis[1] = y;
    axis[2] = z;
    this->Modified();
  }
  return true;
}

void vtkIBLEnvironment::SetUp(double x, double y, double z)
{
  this->SetAxis("Up", this->Up, x, y, z);
}

void vtkIBLEnvironment::SetRight(double x, double y, double z)
{
  this->SetAxis("Right", this->Right, x, y, z);
}

void vtkIBLEnvironment::SetRotation(double degrees)
{
  if (!std::isfinite(degrees))
  {
    vtkErrorMacro("Rotation is " << degrees << "; it must be finite. The old one stays.");
  }
  else if (degrees != this->Rotation)
  {
    this->Rotation = degrees;
    this->Modified();
  }
}

void vtkIBLEnvironment::SetIntensity(double intensity)
{
  if (!(intensity >= 0.0) || !std::isfinite(intensity))
  {
    vtkErrorMacro("Intensity is " << intensity << "; it must be finite and not negative. The old one stays.");
  }
  else if (intensity != this->Intensity)
  {
    this->Intensity = intensity;
    this->Modified();
  }
}

void vtkIBLEnvironment::SetTint(double red, double green, double blue)
{
  const double least = std::min({ red, green, blue });
  if (!(least >= 0.0) || !std::isfinite(red + green + blue))
  {
    vtkErrorMacro("Tint is (" << red << ", " << green << ", " << blue
                              << "); each must be finite and not negative. The old one stays.");
  }
  else if (red != this->Tint[0] || green != this->Tint[1] || blue != this->Tint[2])
  {
    this->Tint[0] = red;
    this->Tint[1] = green;
    this->Tint[2] = blue;
    this->Modified();
  }
}

void vtkIBLEnvironment::SetNormalizeExposure(bool normalize)
{
  if (normalize != this->NormalizeExposure)
  {
    this->NormalizeExposure = normalize;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
bool vtkIBLEnvironment::Update()
{
  vtkMTimeType sourceTime = this->SourceTime.GetMTime();
  if (this->Producer)
  {
    this->Producer->Update(this->ProducerPort);
    if (vtkDataObject* output = this->Producer->GetOutputDataObject(this->ProducerPort))
    {
      sourceTime = std::max(sourceTime, output->GetMTime());
    }
  }
  if (sourceTime > this->AttemptTime.GetMTime())
  {
    this->AttemptTime.Modified(); // a source that failed is not read again until it changes
    vtkSmartPointer<vtkImageData> radiance = this->Load();
    if (!radiance && !this->Radiance)
    {
      radiance = MakeStudio();
    }
    if (radiance)
    {
      this->Adopt(radiance);
    }
  }
  return this->Radiance != nullptr;
}

vtkSmartPointer<vtkImageData> vtkIBLEnvironment::Load()
{
  if (this->Producer)
  {
    return this->LoadInput();
  }
  if (!this->FileName.empty())
  {
    return this->LoadFile();
  }
  return MakeStudio();
}

vtkSmartPointer<vtkImageData> vtkIBLEnvironment::LoadFile()
{
  this->Reader->SetFileName(this->FileName.c_str());
  this->Reader->Modified(); // the file may have changed
  this->Reader->Update();   // reports its own errors
  vtkImageData* output = this->Reader->GetOutput();
  if (this->Reader->GetErrorCode() != 0 || !output || output->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  auto radiance = vtkSmartPointer<vtkImageData>::New();
  radiance->ShallowCopy(output);
  output->ReleaseData(); // one owner: it is cleaned in place
  return radiance;
}

vtkSmartPointer<vtkImageData> vtkIBLEnvironment::LoadInput()
{
  auto* image = vtkImageData::SafeDownCast(this->Producer->GetOutputDataObject(this->ProducerPort));
  vtkDataArray* array = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!array || array->GetNumberOfTuples() == 0)
  {
    vtkErrorMacro("The input has no image with scalars; connect one, or give a file name. The last good light stays.");
    return nullptr;
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  const bool latLong = dimensions[2] == 1 && std::abs(dimensions[0] - 2 * dimensions[1]) <= 1;
  const bool cube = dimensions[2] == 6 && dimensions[0] == dimensions[1];
  if (!latLong && !cube)
  {
    vtkErrorMacro(
      "The input is " << dimensions[0] << "x" << dimensions[1] << "x" << dimensions[2]
                      << "; an environment is 2n x n x 1 (lat-long) or n x n x 6 (faces). The last good light stays.");
    return nullptr;
  }
  const int colorSpace = this->GetColorSpace();
  const int type = array->GetDataType();
  const bool integer = type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT;
  const bool decode =
    colorSpace == vtkIBLImageReader::ColorSpaceSRGB || (colorSpace == vtkIBLImageReader::ColorSpaceAuto && integer);
  const double scale = integer ? 1.0 / (type == VTK_UNSIGNED_CHAR ? 255.0 : 65535.0) : 1.0;
  const int components = array->GetNumberOfComponents();

  auto radiance = MakeImage(dimensions[0], dimensions[1], dimensions[2]);
  auto* rgb = static_cast<float*>(radiance->GetScalarPointer());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double value = array->GetComponent(i, components < 3 ? 0 : k) * scale;
      *rgb++ = static_cast<float>(decode ? LinearFromSRGB(value) : value);
    }
  }
  return radiance;
}

void vtkIBLEnvironment::Adopt(vtkImageData* radiance)
{
  vtkIBLRadianceImage view = View(radiance);
  const vtkIBLRadianceFaults faults = vtkIBLCleanRadiance(view);
  this->Radiance = radiance;
  this->RadianceTime.Modified();
  this->MeanLuminance = vtkIBLMeanLuminance(view);
  this->NumberOfNotFiniteTexels = static_cast<vtkIdType>(faults.NotFinite);
  this->NumberOfTooLargeTexels = static_cast<vtkIdType>(faults.TooLarge);
  this->NumberOfNegativeTexels = static_cast<vtkIdType>(faults.Negative);

  // Lossy EXR compression leaves small negatives in most HDRIs: those are counted, and not worth a word each time.
  const bool faint = faults.MostNegative > -0.1 * this->MeanLuminance;
  if (faults.NotFinite > 0 || faults.TooLarge > 0 || (faults.Negative > 0 && !faint))
  {
    vtkWarningMacro("Environment '" << (this->FileName.empty() ? "input" : this->FileName) << "': replaced "
                                    << faults.NotFinite << " NaN or infinite and " << faults.TooLarge
                                    << " too large texels (above " << vtkIBLLargestRadiance
                                    << ") by the mean of their neighbours, and " << faults.Negative
                                    << " negative ones (down to " << faults.MostNegative << ") by 0.");
  }
}

vtkImageData* vtkIBLEnvironment::GetRadianceImage() const
{
  return this->Radiance;
}

vtkIBLRadianceImage vtkIBLEnvironment::GetRadiance() const
{
  return View(this->Radiance);
}

vtkMTimeType vtkIBLEnvironment::GetRadianceTime() const
{
  return this->RadianceTime.GetMTime();
}

//------------------------------------------------------------------------------
void vtkIBLEnvironment::GetEnvironmentFromWorld(double rows[9]) const
{
  double up[3] = { this->Up[0], this->Up[1], this->Up[2] };
  vtkMath::Normalize(up);
  // The part of Right that is perpendicular to Up; if none is left, any direction that is.
  const double along = vtkMath::Dot(this->Right, up);
  double right[3];
  for (int k = 0; k < 3; ++k)
  {
    right[k] = this->Right[k] - along * up[k];
  }
  if (vtkMath::Normalize(right) <= 1e-9 * vtkMath::Norm(this->Right))
  {
    double other[3];
    vtkMath::Perpendiculars(up, right, other, 0.0);
  }
  double front[3];
  vtkMath::Cross(right, up, front);
  // Turning by the angle a about Up takes right to cos(a) right + sin(a) (up x right), and up x right = -front.
  const double angle = vtkMath::RadiansFromDegrees(std::fmod(this->Rotation, 360.0));
  for (int k = 0; k < 3; ++k)
  {
    rows[k] = std::cos(angle) * right[k] - std::sin(angle) * front[k];
    rows[3 + k] = up[k];
    rows[6 + k] = std::sin(angle) * right[k] + std::cos(angle) * front[k];
  }
}

void vtkIBLEnvironment::GetRadianceScale(double rgb[3]) const
{
  const double exposure = this->NormalizeExposure && this->MeanLuminance > 0.0 ? 1.0 / this->MeanLuminance : 1.0;
  for (int k = 0; k < 3; ++k)
  {
    rgb[k] = exposure * this->Intensity * this->Tint[k];
  }
}
