// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLEnvironment
 * @brief light from all directions: where it comes from, which way it is turned, how strong it is
 *
 * The light is read from an image file, taken from a pipeline or an image, or, with neither, that of a built-in
 * procedural studio. It is checked and cleaned once: NaN, infinite, absurdly large (above 1e10) and negative texels are
 * counted, reported and replaced. A source that can't be read reports an error, and the last good light stays.
 *
 * Orientation, intensity and tint enter when light is looked up; changing them costs nothing. One environment can serve
 * any number of render passes and windows.
 *
 * A lat-long image has the direction d at u = atan(d.z, d.x)/2pi + 1/2, v = asin(d.y)/pi + 1/2, as
 * vtkRenderer::SetEnvironmentTexture has it; all conventions are in docs/conventions.md.
 */
#ifndef vtkIBLEnvironment_h
#define vtkIBLEnvironment_h

#include "vtkIBLModule.h" // For export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <future> // For std::future
#include <memory> // For std::shared_ptr
#include <string> // For std::string

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkIBLStatistics;
class vtkIBLStopwatch;
class vtkImageData;
class vtkIBLSpectrum;
struct vtkIBLRadianceImage;
struct vtkIBLStoredLight;

class VTKIBL_EXPORT vtkIBLEnvironment : public vtkObject
{
public:
  static vtkIBLEnvironment* New();
  vtkTypeMacro(vtkIBLEnvironment, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The image file to read: any that OpenImageIO reads (.exr .hdr .tif .png .jpg …), lat-long or a cube layout, see
   * vtkIBLImageReader. Setting a file name drops an input connection. Setting the same again, or Modified(), looks
   * whether the file is another by now. Null or empty, the default: no file.
   */
  void SetFileName(const char* fileName);
  const char* GetFileName() const;
  void Modified() override;
  ///@}

  ///@{
  /**
   * Light from a pipeline or an image: 1 to 4 components of any type; W x H x 1 with W = 2 H, row 0 straight down, or n
   * x n x 6, faces in GL's order, row 0 at t = -1. Setting an input drops the file name; null goes back to the studio.
   */
  void SetInputConnection(vtkAlgorithmOutput* output);
  void SetInputData(vtkImageData* image);
  ///@}

  ///@{
  /**
   * How the source's numbers mean light; vtkIBLImageReader's ColorSpaceAuto (the default: sRGB for 8- and 16-bit
   * integers, linear for the rest), ColorSpaceLinear or ColorSpaceSRGB. An sRGB picture taken as linear looks washed
   * out and too bright.
   */
  void SetColorSpace(int colorSpace);
  vtkGetMacro(ColorSpace, int);
  ///@}

  ///@{
  /**
   * A wider file is box-reduced to this width while it is read. Default 4096, enough for a background at 4k; 0, and
   * below: never.
   */
  void SetMaximumWidth(int width);
  vtkGetMacro(MaximumWidth, int);
  ///@}

  ///@{
  /**
   * Which world direction the environment's +y points to, and which its +x, as in vtkRenderer. `Right` is made
   * perpendicular to `Up`. Default (0, 1, 0) and (1, 0, 0); for data whose z is up, SetUp(0, 0, 1). Zero or not finite:
   * an error, and the old value stays.
   */
  void SetUp(double x, double y, double z);
  vtkGetVector3Macro(Up, double);
  void SetRight(double x, double y, double z);
  vtkGetVector3Macro(Right, double);
  ///@}

  ///@{
  /**
   * Turns the environment about `Up`, in degrees, counterclockwise as seen from above. Default 0.
   */
  void SetRotation(double degrees);
  vtkGetMacro(Rotation, double);
  ///@}

  ///@{
  /**
   * Factor on all light, [0, inf). Default 1. And a colour to filter it with, each in [0, inf); default white. From a
   * mean of 1e28 on it gets no brighter.
   */
  void SetIntensity(double intensity);
  vtkGetMacro(Intensity, double);
  void SetTint(double red, double green, double blue);
  vtkGetVector3Macro(Tint, double);
  ///@}

  ///@{
  /**
   * Scale the light so that its mean luminance is 1: a white matt surface then averages 1, and colours of a colour map
   * stay what they are, whatever the exposure of the image. Default off: radiance as the file has it.
   */
  void SetNormalizeExposure(bool normalize);
  vtkGetMacro(NormalizeExposure, bool);
  vtkBooleanMacro(NormalizeExposure, bool);
  ///@}

  ///@{
  /**
   * Read a file on a thread of its own, and make there what lighting with it takes: Update() returns at once, frames go
   * on with the last light, or without any when there is none yet, and a later Update() takes the new one. IsBusy()
   * tells whether one is under way; a viewer renders again when it no longer is. Default off: Update() waits.
   */
  void SetAsynchronous(bool asynchronous) { this->Asynchronous = asynchronous; }
  vtkGetMacro(Asynchronous, bool);
  vtkBooleanMacro(Asynchronous, bool);
  bool IsBusy() const;
  ///@}

  ///@{
  /**
   * Set from an observer of this object's ProgressEvent, which reading a file sends (call data: double in [0, 1]), or
   * while one is read on a thread, which sends none, it calls the reading off: the last good light stays, until the
   * source is changed or set again. It is cleared when a reading begins.
   */
  void SetAbortExecute(bool abort);
  vtkGetMacro(AbortExecute, bool);
  ///@}

  /**
   * Brings the light up to date if the source changed: out of the cache, see vtkIBLCache, or by reading and cleaning
   * it. Returns whether there is light; false when memory ran out, or while the first is read on a thread.
   */
  bool Update();

  ///@{
  /**
   * The light as of the last Update(): linear, finite, non-negative float RGB, W x H x 1 or n x n x 6. Not to be
   * changed. A source that came out of the cache is read when this is first called; null, with an error, when that
   * can't be done any more. And when the light last changed.
   */
  vtkImageData* GetRadianceImage();
  vtkMTimeType GetRadianceTime() const;
  ///@}

  ///@{
  /**
   * What the image of the last Update() is, be it read or out of the cache: width and height of a lat-long image (1
   * face) or of one of 6 faces.
   */
  int GetNumberOfFaces() const;
  int GetWidth() const;
  int GetHeight() const;
  vtkIdType GetNumberOfTexels() const;
  ///@}

#ifndef __VTK_WRAP__
  ///@{
  /**
   * For the stages: radiance, harmonics of a lat-long environment, of at least that order, and the radiance cube's
   * faces (6 x n x n x 3, GL's order; good until the next call). Made when first asked for, kept while the light stays,
   * shared by all windows, and put in the cache by KeepLight(). Each throws std::runtime_error when pixels are needed
   * that can't be read any more.
   */
  vtkIBLRadianceImage GetRadiance();
  std::shared_ptr<const vtkIBLSpectrum> GetSpectrum(int order);
  const float* GetCube(int faceSize);
  void KeepLight();
  ///@}
#endif

  /**
   * What was read, found in the cache, analysed and turned into faces, for all who share this environment.
   */
  vtkIBLStatistics* GetStatistics() const;

  ///@{
  /**
   * What the last Update() found: mean luminance (Rec. 709) over the sphere, and texels that it cleaned.
   */
  double GetMeanLuminance() const;
  vtkIdType GetNumberOfNotFiniteTexels() const;
  vtkIdType GetNumberOfTooLargeTexels() const;
  vtkIdType GetNumberOfNegativeTexels() const;
  ///@}

  /**
   * Rotation from world space to the environment's own, row by row; orthonormal.
   */
  void GetEnvironmentFromWorld(double rows[9]) const;

  /**
   * What the source's radiance is multiplied by: intensity, tint and exposure.
   */
  void GetRadianceScale(double rgb[3]) const;

protected:
  vtkIBLEnvironment();
  ~vtkIBLEnvironment() override;

private:
  vtkIBLEnvironment(const vtkIBLEnvironment&) = delete;
  void operator=(const vtkIBLEnvironment&) = delete;

  void SetSource(const char* fileName, vtkAlgorithm* producer, int port);
  struct File;
  struct Reading;
  vtkMTimeType UpdateSource();
  vtkSmartPointer<vtkImageData> LoadInput();
  void Take(const Reading& reading);
  void TakePixels(vtkImageData* radiance, const vtkIBLStopwatch& stopwatch);
  void Adopt(std::shared_ptr<const vtkIBLStoredLight> light, vtkImageData* radiance);
  vtkIBLStoredLight& GetOwnLight();
  void Report();
  bool SetAxis(const char* name, double axis[3], double x, double y, double z);

  std::string FileName;
  vtkSmartPointer<vtkAlgorithm> Producer;
  int ProducerPort = 0;
  int ColorSpace = 0; // vtkIBLImageReader::ColorSpaceAuto
  int MaximumWidth = 4096;
  vtkTimeStamp SourceTime;
  vtkTimeStamp AttemptTime;

  double Up[3] = { 0.0, 1.0, 0.0 };
  double Right[3] = { 1.0, 0.0, 0.0 };
  double Rotation = 0.0;
  double Intensity = 1.0;
  double Tint[3] = { 1.0, 1.0, 1.0 };
  bool NormalizeExposure = false;

  bool Asynchronous = false;
  bool AbortExecute = false;

  std::unique_ptr<Reading> Pending;               // on a thread
  std::future<void> Keeping;                      // a write to the cache
  std::unique_ptr<File> Origin;                   // of the light; null: not a file
  std::string Key;                                // of the light in the cache; empty: not a file's
  bool IsKept = false;                            // the cache has all of it, and so nobody may write to it
  std::shared_ptr<const vtkIBLStoredLight> Light; // all that is known of it but its pixels
  std::shared_ptr<const vtkIBLSpectrum> Spectrum; // that of Light, once asked for
  vtkSmartPointer<vtkImageData> Radiance;         // null: not read, as Light came out of the cache
  vtkTimeStamp RadianceTime;
  vtkSmartPointer<vtkIBLStatistics> Statistics;
};

#endif
