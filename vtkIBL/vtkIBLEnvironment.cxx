// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLEnvironment.h"

#include "vtkIBLCache.h"
#include "vtkIBLCubeConversion.h"
#include "vtkIBLImageReader.h"
#include "vtkIBLRadianceImage.h"
#include "vtkIBLSpectrum.h"
#include "vtkIBLStatistics.h"
#include "vtkIBLStopwatch.h"
#include "vtkIBLStoredLight.h"
#include "vtkIBLStudio.h"
#include "vtkIBLThreads.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

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

// What a file or an input turned out to be.
struct Source
{
  std::shared_ptr<const vtkIBLStoredLight> Light;
  vtkSmartPointer<vtkImageData> Radiance;
};

Source Clean(vtkImageData* radiance)
{
  vtkIBLRadianceImage view = View(radiance);
  auto light = std::make_shared<vtkIBLStoredLight>();
  light->Faults = vtkIBLCleanRadiance(view);
  light->MeanLuminance = vtkIBLMeanLuminance(view);
  light->SourceWidth = view.Width;
  light->SourceHeight = view.Height;
  light->SourceFaces = view.Faces;
  return { light, radiance };
}

void AddSpectrum(vtkIBLStoredLight& light, const vtkIBLSpectrum& spectrum)
{
  light.SpectrumOrder = spectrum.GetOrder();
  light.Coefficients = spectrum.GetCoefficients();
  light.BrightTexels = spectrum.GetBrightTexels();
}

vtkIBLStatistics::Work CountRead(vtkImageData* radiance, const vtkIBLStopwatch& stopwatch)
{
  const vtkTypeInt64 texels = radiance->GetNumberOfPoints();
  return { vtkIBLStatistics::Read, 1, texels, 12 * texels, stopwatch.GetSeconds() };
}

vtkIBLStatistics::Work CountHarmonics(const vtkIBLStoredLight& light, const vtkIBLStopwatch& stopwatch)
{
  const auto texels = vtkTypeInt64(light.SourceFaces) * light.SourceWidth * light.SourceHeight;
  return { vtkIBLStatistics::Harmonics, 1, texels, 12 * texels, stopwatch.GetSeconds() };
}
}

// A file and how it is read: all that its light depends on but its content.
struct vtkIBLEnvironment::File
{
  std::string Name;
  int ColorSpace;
  int MaximumWidth;

  std::string MakeKey() const
  {
    return vtkIBLCache::MakeFileKey(
      this->Name, "environment " + std::to_string(this->ColorSpace) + " " + std::to_string(this->MaximumWidth));
  }
};

// A file on its way to light: out of the cache, or read and cleaned, on the caller's thread or on one of its own, which
// alone has all but Abort until it ends.
struct vtkIBLEnvironment::Reading
{
  File Origin;
  std::string Key;     // first that of the light that there is
  bool IsSame = false; // as there is
  bool IsFound = false;
  std::string Error;
  Source Result;
  std::vector<vtkIBLStatistics::Work> Done;

  // Asked on the thread that reads; false calls it off.
  using GoOn = std::function<bool(double)>;

  Reading(const File& file, const std::string& key)
    : Origin(file)
    , Key(key)
  {
  }
  ~Reading() { this->CallOff(); }

  // Words are the main thread's matter: what goes wrong is in Error.
  void Run(const GoOn& goOn, const vtkIBLParallelFor* ahead)
  {
    try
    {
      const vtkIBLStopwatch stopwatch;
      const std::string key = this->Origin.MakeKey();
      this->IsSame = !key.empty() && key == this->Key;
      this->Key = key;
      if (this->IsSame)
      {
        return;
      }
      if (std::shared_ptr<const vtkIBLStoredLight> found = vtkIBLCache::Find(key))
      {
        const auto bytes = vtkTypeInt64(found->GetNumberOfBytes());
        this->Result.Light = std::move(found);
        this->IsFound = true;
        this->Done.push_back({ vtkIBLStatistics::CacheHit, 1, 0, bytes, stopwatch.GetSeconds() });
        return;
      }
      this->ReadPixels(goOn);
      if (ahead && this->Result.Light && this->Result.Light->SourceFaces == 1)
      {
        this->Analyse(*ahead);
      }
    }
    catch (const vtkIBLAborted&)
    {
      this->Result = Source();
    }
    catch (const std::exception& error)
    {
      this->Result = Source();
      this->Error = "Cannot make light of '" + this->Origin.Name + "': " + error.what() + ".";
    }
  }
  void RunOnThread()
  {
    this->Thread = std::async(std::launch::async,
      [this]
      {
        std::atomic<int> finished{ 0 };
        const vtkIBLParallelFor ahead = vtkIBLMakeAbortable(vtkIBLRunOnThreads, this->Abort, finished);
        this->Run([this](double) { return !this->Abort; }, &ahead);
      });
  }
  void CallOff() { this->Abort = true; }
  bool IsDone() const { return this->Thread.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }

  void ReadPixels(const GoOn& goOn)
  {
    const vtkIBLStopwatch stopwatch;
    vtkNew<vtkIBLImageReader> reader;
    reader->SetFileName(this->Origin.Name.c_str());
    reader->SetColorSpace(this->Origin.ColorSpace);
    reader->SetMaximumWidth(this->Origin.MaximumWidth);
    const auto observe =
      [](vtkObject* who, unsigned long event, void (*call)(vtkObject*, unsigned long, void*, void*), const void* data)
    {
      vtkNew<vtkCallbackCommand> command;
      command->SetClientData(const_cast<void*>(data));
      command->SetCallback(call);
      who->AddObserver(event, command);
    };
    observe(
      reader, vtkCommand::ProgressEvent,
      [](vtkObject* who, unsigned long, void* go, void* progress)
      {
        const bool goes = (*static_cast<const GoOn*>(go))(*static_cast<double*>(progress));
        static_cast<vtkIBLImageReader*>(who)->SetAbortExecute(!goes);
      },
      &goOn);
    const auto keep = [](vtkObject*, unsigned long, void* error, void* words)
    {
      auto& text = *static_cast<std::string*>(error);
      if (text.empty()) // the executive says once more that it failed
      {
        text = static_cast<const char*>(words);
        text.erase(0, text.find("Cannot read")); // before it: which line of ours says so
        text.erase(text.find_last_not_of('\n') + 1);
      }
    };
    observe(reader, vtkCommand::ErrorEvent, keep, &this->Error);
    observe(reader->GetExecutive(), vtkCommand::ErrorEvent, keep, &this->Error);
    reader->Update();
    vtkImageData* output = reader->GetOutput();
    if (reader->GetErrorCode() != 0 || !output || output->GetNumberOfPoints() == 0)
    {
      return;
    }
    auto radiance = vtkSmartPointer<vtkImageData>::New();
    radiance->ShallowCopy(output);
    output->ReleaseData(); // one owner: it is cleaned in place
    this->Result = Clean(radiance);
    this->Done.push_back(CountRead(radiance, stopwatch));
  }
  void Analyse(const vtkIBLParallelFor& parallelFor)
  {
    const vtkIBLStopwatch stopwatch;
    auto more = std::make_shared<vtkIBLStoredLight>(*this->Result.Light);
    AddSpectrum(*more, vtkIBLSpectrum(View(this->Result.Radiance), vtkIBLSpectrum::MaximumOrder, parallelFor));
    this->Done.push_back(CountHarmonics(*more, stopwatch));
    this->Result.Light = more;
  }

private:
  std::atomic<bool> Abort{ false };
  std::future<void> Thread; // the last member: going, it waits, and all else is still there
};

vtkIBLEnvironment::vtkIBLEnvironment()
  : Statistics(vtkSmartPointer<vtkIBLStatistics>::New())
{
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
     << indent << "Asynchronous: " << this->Asynchronous << "\n"
     << indent << "MeanLuminance: " << this->GetMeanLuminance() << "\n"
     << indent << "NumberOfNotFiniteTexels: " << this->GetNumberOfNotFiniteTexels() << "\n"
     << indent << "NumberOfTooLargeTexels: " << this->GetNumberOfTooLargeTexels() << "\n"
     << indent << "NumberOfNegativeTexels: " << this->GetNumberOfNegativeTexels() << "\n"
     << indent << "Statistics:\n";
  this->Statistics->PrintSelf(os, indent.GetNextIndent());
}

//------------------------------------------------------------------------------
void vtkIBLEnvironment::Modified()
{
  this->SourceTime.Modified();
  this->Superclass::Modified();
}

void vtkIBLEnvironment::SetSource(const char* fileName, vtkAlgorithm* producer, int port)
{
  const std::string name = fileName ? fileName : "";
  const bool isOld = name == this->FileName && producer == this->Producer && port == this->ProducerPort;
  this->FileName = name;
  this->Producer = producer;
  this->ProducerPort = port;
  if (!isOld || !name.empty()) // a file may have changed
  {
    this->Modified();
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
  colorSpace = std::clamp(colorSpace, int(vtkIBLImageReader::ColorSpaceAuto), int(vtkIBLImageReader::ColorSpaceSRGB));
  if (colorSpace != this->ColorSpace)
  {
    this->ColorSpace = colorSpace;
    this->Modified();
  }
}

void vtkIBLEnvironment::SetMaximumWidth(int width)
{
  width = std::max(width, 0);
  if (width != this->MaximumWidth)
  {
    this->MaximumWidth = width;
    this->Modified();
  }
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
    this->Superclass::Modified(); // the source is as it was
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
    this->Superclass::Modified(); // the source is as it was
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
    this->Superclass::Modified(); // the source is as it was
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
    this->Superclass::Modified(); // the source is as it was
  }
}

void vtkIBLEnvironment::SetNormalizeExposure(bool normalize)
{
  if (normalize != this->NormalizeExposure)
  {
    this->NormalizeExposure = normalize;
    this->Superclass::Modified(); // the source is as it was
  }
}

//------------------------------------------------------------------------------
void vtkIBLEnvironment::SetAbortExecute(bool abort)
{
  this->AbortExecute = abort;
  if (abort && this->Pending)
  {
    this->Pending->CallOff();
  }
}

// When it last changed.
vtkMTimeType vtkIBLEnvironment::UpdateSource()
{
  vtkMTimeType time = this->SourceTime.GetMTime();
  if (this->Producer)
  {
    this->Producer->Update(this->ProducerPort);
    if (vtkDataObject* output = this->Producer->GetOutputDataObject(this->ProducerPort))
    {
      time = std::max(time, output->GetMTime());
    }
  }
  return time;
}

bool vtkIBLEnvironment::Update()
{
  if (this->UpdateSource() > this->AttemptTime.GetMTime())
  {
    this->AttemptTime.Modified(); // a source that failed is not read again until it changes
    this->Pending = nullptr;
    this->AbortExecute = false;
    if (this->FileName.empty())
    {
      const vtkIBLStopwatch stopwatch;
      if (const vtkSmartPointer<vtkImageData> radiance = this->Producer ? this->LoadInput() : MakeStudio())
      {
        this->TakePixels(radiance, stopwatch);
      }
    }
    else
    {
      auto reading = std::make_unique<Reading>(File{ this->FileName, this->ColorSpace, this->MaximumWidth }, this->Key);
      if (this->Asynchronous)
      {
        this->Pending = std::move(reading);
        this->Pending->RunOnThread();
      }
      else
      {
        reading->Run(
          [this](double progress)
          {
            this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
            return !this->AbortExecute;
          },
          nullptr);
        this->Take(*reading);
      }
    }
  }
  if (this->Pending && this->Pending->IsDone())
  {
    this->Take(*std::exchange(this->Pending, nullptr));
  }
  if (!this->Light && !this->Pending) // nothing good yet
  {
    const vtkIBLStopwatch stopwatch;
    this->TakePixels(MakeStudio(), stopwatch);
  }
  return this->Light != nullptr;
}

bool vtkIBLEnvironment::IsBusy() const
{
  return this->Pending && !this->Pending->IsDone();
}

void vtkIBLEnvironment::Take(const Reading& reading)
{
  for (const vtkIBLStatistics::Work& work : reading.Done)
  {
    this->Statistics->Add(work);
  }
  if (!reading.Error.empty())
  {
    vtkErrorMacro(<< reading.Error << " The last good light stays.");
  }
  if (reading.IsSame || reading.Result.Light)
  {
    this->Origin = std::make_unique<File>(reading.Origin);
    this->Key = reading.Key;
  }
  if (reading.Result.Light)
  {
    this->IsKept = reading.IsFound;
    this->Adopt(reading.Result.Light, reading.Result.Radiance);
  }
}

void vtkIBLEnvironment::TakePixels(vtkImageData* radiance, const vtkIBLStopwatch& stopwatch)
{
  this->Origin = nullptr;
  this->Key.clear();
  this->IsKept = false;
  this->Adopt(Clean(radiance).Light, radiance);
  this->Statistics->Add(CountRead(radiance, stopwatch));
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
  const int colorSpace = this->ColorSpace;
  const int type = array->GetDataType();
  const bool integer = type == VTK_UNSIGNED_CHAR || type == VTK_UNSIGNED_SHORT;
  const bool decode =
    colorSpace == vtkIBLImageReader::ColorSpaceSRGB || (colorSpace == vtkIBLImageReader::ColorSpaceAuto && integer);
  const double scale = integer ? 1.0 / (type == VTK_UNSIGNED_CHAR ? 255.0 : 65535.0) : 1.0;
  const int components = array->GetNumberOfComponents();

  auto radiance = MakeImage(dimensions[0], dimensions[1], dimensions[2]);
  auto* rgb = static_cast<float*>(radiance->GetScalarPointer());
  if (auto* floats = vtkFloatArray::SafeDownCast(array); floats && components == 3 && !decode)
  {
    std::copy_n(floats->GetPointer(0), floats->GetNumberOfValues(), rgb);
    return radiance;
  }
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

void vtkIBLEnvironment::Adopt(std::shared_ptr<const vtkIBLStoredLight> light, vtkImageData* radiance)
{
  this->Light = std::move(light);
  this->Spectrum = nullptr;
  this->Radiance = radiance;
  this->RadianceTime.Modified();
  this->Report();
}

void vtkIBLEnvironment::Report()
{
  // Lossy EXR compression leaves small negatives in most HDRIs: those are counted, and not worth a word each time.
  const vtkIBLRadianceFaults& faults = this->Light->Faults;
  const bool faint = faults.MostNegative > -0.1 * this->Light->MeanLuminance;
  if (faults.NotFinite > 0 || faults.TooLarge > 0 || (faults.Negative > 0 && !faint))
  {
    vtkWarningMacro("Environment '" << (this->Origin ? this->Origin->Name : "input") << "': replaced "
                                    << faults.NotFinite << " NaN or infinite and " << faults.TooLarge
                                    << " too large texels (above " << vtkIBLLargestRadiance
                                    << ") by the mean of their neighbours, and " << faults.Negative
                                    << " negative ones (down to " << faults.MostNegative << ") by 0.");
  }
}

//------------------------------------------------------------------------------
vtkImageData* vtkIBLEnvironment::GetRadianceImage()
{
  try
  {
    this->GetRadiance();
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  return this->Radiance;
}

vtkIBLRadianceImage vtkIBLEnvironment::GetRadiance()
{
  if (this->Light && !this->Radiance)
  {
    // The file may be another by now, or gone.
    Reading reading(*this->Origin, std::string());
    if (this->Origin->MakeKey() == this->Key)
    {
      reading.ReadPixels([](double) { return true; });
    }
    if (!reading.Result.Radiance)
    {
      throw std::runtime_error("The light of '" + this->Origin->Name +
        "' came out of the cache; now its pixels are needed, and the file is gone, or is another one. What was made of "
        "it stays. Call SetFileName() again, with a file that is there.");
    }
    this->Radiance = reading.Result.Radiance;
    this->Statistics->Add(reading.Done.front());
  }
  return View(this->Radiance);
}

vtkMTimeType vtkIBLEnvironment::GetRadianceTime() const
{
  return this->RadianceTime.GetMTime();
}

int vtkIBLEnvironment::GetNumberOfFaces() const
{
  return this->Light ? this->Light->SourceFaces : 0;
}

int vtkIBLEnvironment::GetWidth() const
{
  return this->Light ? this->Light->SourceWidth : 0;
}

int vtkIBLEnvironment::GetHeight() const
{
  return this->Light ? this->Light->SourceHeight : 0;
}

vtkIdType vtkIBLEnvironment::GetNumberOfTexels() const
{
  return vtkIdType(this->GetNumberOfFaces()) * this->GetWidth() * this->GetHeight();
}

vtkIBLStatistics* vtkIBLEnvironment::GetStatistics() const
{
  return this->Statistics;
}

double vtkIBLEnvironment::GetMeanLuminance() const
{
  return this->Light ? this->Light->MeanLuminance : 0.0;
}

vtkIdType vtkIBLEnvironment::GetNumberOfNotFiniteTexels() const
{
  return this->Light ? static_cast<vtkIdType>(this->Light->Faults.NotFinite) : 0;
}

vtkIdType vtkIBLEnvironment::GetNumberOfTooLargeTexels() const
{
  return this->Light ? static_cast<vtkIdType>(this->Light->Faults.TooLarge) : 0;
}

vtkIdType vtkIBLEnvironment::GetNumberOfNegativeTexels() const
{
  return this->Light ? static_cast<vtkIdType>(this->Light->Faults.Negative) : 0;
}

//------------------------------------------------------------------------------
// To add a part to. What is kept may be read by the cache's threads at this moment, so then it is a copy.
vtkIBLStoredLight& vtkIBLEnvironment::GetOwnLight()
{
  if (std::exchange(this->IsKept, false))
  {
    this->Light = std::make_shared<vtkIBLStoredLight>(*this->Light);
  }
  return const_cast<vtkIBLStoredLight&>(*this->Light);
}

std::shared_ptr<const vtkIBLSpectrum> vtkIBLEnvironment::GetSpectrum(int order)
{
  if (this->Light->SpectrumOrder < order)
  {
    const vtkIBLRadianceImage radiance = this->GetRadiance();
    const vtkIBLStopwatch stopwatch;
    this->Spectrum = std::make_shared<vtkIBLSpectrum>(radiance, order, vtkIBLRunOnThreads);
    AddSpectrum(this->GetOwnLight(), *this->Spectrum);
    this->Statistics->Add(CountHarmonics(*this->Light, stopwatch));
  }
  else if (!this->Spectrum)
  {
    this->Spectrum = std::make_shared<vtkIBLSpectrum>(
      this->Light->SpectrumOrder, this->Light->Coefficients, this->Light->BrightTexels);
  }
  return this->Spectrum;
}

const float* vtkIBLEnvironment::GetCube(int faceSize)
{
  if (this->Light->CubeFaceSize != faceSize)
  {
    const vtkIBLRadianceImage radiance = this->GetRadiance();
    const vtkIBLStopwatch stopwatch;
    std::vector<float> cube(vtkIBLStoredLight::GetCubeLength(faceSize));
    vtkIBLConvertToCube(radiance, faceSize, cube.data(), vtkIBLRunOnThreads);
    vtkIBLStoredLight& light = this->GetOwnLight();
    light.CubeFaceSize = faceSize;
    light.Cube = std::move(cube);
    this->Statistics->Add({ vtkIBLStatistics::CubeFaces, 1, vtkTypeInt64(light.Cube.size() / 3),
      vtkTypeInt64(light.Cube.size() * sizeof(float)), stopwatch.GetSeconds() });
  }
  return this->Light->Cube.data();
}

void vtkIBLEnvironment::KeepLight()
{
  if (this->Light && !this->IsKept && !this->Key.empty() && vtkIBLCache::GetEnabled())
  {
    // Writing takes longer than lighting: it goes on beside the frames.
    this->Keeping =
      std::async(std::launch::async, [key = this->Key, light = this->Light] { vtkIBLCache::Store(key, light); });
    this->Statistics->Add({ vtkIBLStatistics::CacheWrite, 1, 0, vtkTypeInt64(this->Light->GetNumberOfBytes()) });
    this->IsKept = true;
  }
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
  const double mean = this->GetMeanLuminance();
  const double exposure = this->NormalizeExposure && mean > 0.0 ? 1.0 / mean : 1.0;
  // Shaders have floats: neither it nor the brightest light may become infinite, for infinity times black is NaN.
  const double largest = 1e28 / std::max(mean, 1e-10);
  for (int k = 0; k < 3; ++k)
  {
    rgb[k] = std::min(exposure * this->Intensity * this->Tint[k], largest);
  }
}
