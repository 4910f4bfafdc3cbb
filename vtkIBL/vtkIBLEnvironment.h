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
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <string> // For std::string

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkIBLImageReader;
class vtkImageData;
struct vtkIBLRadianceImage;

class VTKIBL_EXPORT vtkIBLEnvironment : public vtkObject
{
public:
  static vtkIBLEnvironment* New();
  vtkTypeMacro(vtkIBLEnvironment, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The image file to read: any that OpenImageIO reads (.exr .hdr .tif .png .jpg …), lat-long or a cube layout, see
   * vtkIBLImageReader. Setting a file name drops an input connection. Null or empty, the default: no file.
   */
  void SetFileName(const char* fileName);
  const char* GetFileName() const;
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
  int GetColorSpace() const;
  ///@}

  ///@{
  /**
   * A wider file is box-reduced to this width while it is read. Default 4096, enough for a background at 4k; 0: never.
   */
  void SetMaximumWidth(int width);
  int GetMaximumWidth() const;
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
   * Factor on all light, [0, inf). Default 1. And a colour to filter it with, each in [0, inf); default white.
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

  /**
   * Reads and cleans the source if it changed. Returns whether there is light; false only when memory ran out.
   */
  bool Update();

  ///@{
  /**
   * The light as of the last Update(): linear, finite, non-negative float RGB, W x H x 1 or n x n x 6. Not to be
   * changed.
   */
  vtkImageData* GetRadianceImage() const;
  vtkIBLRadianceImage GetRadiance() const;
  vtkMTimeType GetRadianceTime() const;
  ///@}

  ///@{
  /**
   * What the last Update() found: mean luminance (Rec. 709) over the sphere, and texels that it cleaned.
   */
  vtkGetMacro(MeanLuminance, double);
  vtkGetMacro(NumberOfNotFiniteTexels, vtkIdType);
  vtkGetMacro(NumberOfTooLargeTexels, vtkIdType);
  vtkGetMacro(NumberOfNegativeTexels, vtkIdType);
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
  void SourceModified();
  vtkSmartPointer<vtkImageData> Load();
  vtkSmartPointer<vtkImageData> LoadFile();
  vtkSmartPointer<vtkImageData> LoadInput();
  void Adopt(vtkImageData* radiance);
  bool SetAxis(const char* name, double axis[3], double x, double y, double z);

  std::string FileName;
  vtkSmartPointer<vtkAlgorithm> Producer;
  int ProducerPort = 0;
  vtkNew<vtkIBLImageReader> Reader;
  vtkTimeStamp SourceTime;
  vtkTimeStamp AttemptTime;

  double Up[3] = { 0.0, 1.0, 0.0 };
  double Right[3] = { 1.0, 0.0, 0.0 };
  double Rotation = 0.0;
  double Intensity = 1.0;
  double Tint[3] = { 1.0, 1.0, 1.0 };
  bool NormalizeExposure = false;

  vtkSmartPointer<vtkImageData> Radiance;
  vtkTimeStamp RadianceTime;
  double MeanLuminance = 0.0;
  vtkIdType NumberOfNotFiniteTexels = 0;
  vtkIdType NumberOfTooLargeTexels = 0;
  vtkIdType NumberOfNegativeTexels = 0;
};

#endif
