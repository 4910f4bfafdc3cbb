// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLProbe
 * @brief light at a place in the scene: from where, for whom, and from what it is made
 *
 * A probe holds the light that arrives at its Position. Surfaces in its influence volume are lit by it instead of the
 * sky, which takes over where the volume ends; where volumes overlap, the smaller one lies on top. What the probe sees
 * is taken to be on its proxy, a box or an ellipsoid, so that a reflection is right from everywhere in it
 * (parallax correction: Bjorke 2004, Lagarde & Zanuttini 2012).
 *
 * The light is that of an Environment, or captured: the scene itself, rendered to six faces, whenever something changed
 * that the probe sees. What bounds it sets are in world coordinates, of any size and offset.
 */
#ifndef vtkIBLProbe_h
#define vtkIBLProbe_h

#include "vtkIBLModule.h" // For export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <array> // For std::array

class vtkIBLEnvironment;
class vtkImageData;
class vtkProp;
class vtkRenderer;

class VTKIBL_EXPORT vtkIBLProbe : public vtkObject
{
public:
  static vtkIBLProbe* New();
  vtkTypeMacro(vtkIBLProbe, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where the light is captured, or was. Default the origin. Inside a wall it sees the wall, from behind.
   */
  void SetPosition(double x, double y, double z);
  vtkGetVector3Macro(Position, double);
  ///@}

  enum Proxies
  {
    Infinite, ///< far away, as the sky: reflections do not shift with the place
    Box,
    Ellipsoid ///< the one that touches the box's sides; a sphere where they are equal
  };
  ///@{
  /**
   * What the light is taken to come from. Default Box.
   */
  vtkSetClampMacro(Proxy, int, Infinite, Ellipsoid);
  vtkGetMacro(Proxy, int);
  ///@}

  ///@{
  /**
   * Extent of the proxy: xmin, xmax, ymin, ymax, zmin, zmax, before Orientation turns it about its own middle. Default
   * -1 to 1. A side that is not positive, or not finite, is an error, and the old bounds stay.
   */
  void SetBounds(const double bounds[6]);
  void SetBounds(double xmin, double xmax, double ymin, double ymax, double zmin, double zmax);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Rotation of proxy and influence volume in degrees, about Z, then X, then Y, as vtkProp3D has it. Default 0 0 0.
   */
  void SetOrientation(double x, double y, double z);
  vtkGetVector3Macro(Orientation, double);
  ///@}

  ///@{
  /**
   * The outer bounds of what it lights, of the proxy's shape and turned with it about the proxy's middle: a box where
   * there is no proxy. Default, and after SetInfluenceToBounds(): the proxy, its walls in full, and around it as far as
   * the blend goes; without a proxy, everything.
   */
  void SetInfluenceBounds(const double bounds[6]);
  void SetInfluenceBounds(double xmin, double xmax, double ymin, double ymax, double zmin, double zmax);
  void SetInfluenceToBounds();
  void GetInfluenceBounds(double bounds[6]) const;
  bool HasInfluenceBounds() const { return this->OwnInfluence; }
  ///@}

  ///@{
  /**
   * How far inside the outer bounds the influence is full, in world units; at most half the extent. Default, and below
   * 0: a tenth of the shortest side. 0: no blending, a hard edge.
   */
  void SetBlendDistance(double distance);
  double GetBlendDistance() const;
  ///@}

  ///@{
  /**
   * Factor on its light, [0, inf). Default 1.
   */
  void SetIntensity(double intensity);
  vtkGetMacro(Intensity, double);
  ///@}

  /**
   * Bounds around all visible props of `renderer` that probes capture, and Position in their middle.
   */
  void FitToScene(vtkRenderer* renderer);

  ///@{
  /**
   * Light from there instead of the scene, seen from Position: a file, a panorama or six faces, turned, dimmed and
   * tinted as the environment says. Null, the default: captured.
   */
  void SetEnvironment(vtkIBLEnvironment* environment);
  vtkIBLEnvironment* GetEnvironment() const;
  ///@}

  enum UpdateModes
  {
    Once,      ///< when first needed, and after Capture()
    OnChange,  ///< those faces in which something moved, changed, came or went
    Interval,  ///< all faces every UpdateInterval
    EveryFrame ///< all faces
  };
  ///@{
  /**
   * When a captured probe captures, and only while a surface in sight uses it. Default OnChange.
   */
  vtkSetClampMacro(UpdateMode, int, Once, EveryFrame);
  vtkGetMacro(UpdateMode, int);
  ///@}

  ///@{
  /**
   * Milliseconds between captures in mode Interval, [0, inf). Default 100.
   */
  vtkSetClampMacro(UpdateInterval, double, 0.0, 1e9);
  vtkGetMacro(UpdateInterval, double);
  ///@}

  ///@{
  /**
   * Milliseconds that an update may take from a frame: it stops after the step that passes them (a face, or a layer of
   * the specular ladder) and goes on in the next; the light changes when all of it is there. The first light is never
   * cut up. 0, the default: all in one frame.
   */
  vtkSetClampMacro(TimeBudget, double, 0.0, 1e9);
  vtkGetMacro(TimeBudget, double);
  ///@}

  ///@{
  /**
   * Frames over which new light fades in over the old, in [0, 100]. Default 0: at once.
   */
  vtkSetClampMacro(FadeFrames, int, 0, 100);
  vtkGetMacro(FadeFrames, int);
  ///@}

  ///@{
  /**
   * How often light goes back and forth between the surfaces that a capture shows, in [0, 8]: 0, the default, shows
   * them lit by the sky and the scene's lights; each bounce captures once more, with the probes' own light on them.
   */
  vtkSetClampMacro(Bounces, int, 0, 8);
  vtkGetMacro(Bounces, int);
  ///@}

  /**
   * Captures again in the next frame that uses it, whatever the mode.
   */
  void Capture();

  ///@{
  /**
   * Whether captures show `prop`. True for all at first. Lights that move with the camera never light what they show,
   * since the view would change the light.
   */
  static void SetCaptured(vtkProp* prop, bool captured);
  static bool IsCaptured(vtkProp* prop);
  ///@}

  ///@{
  /**
   * How many faces were captured so far, and how often its light was made anew.
   */
  vtkGetMacro(NumberOfCapturedFaces, vtkTypeInt64);
  vtkGetMacro(NumberOfUpdates, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Keeps `radiance`, n x n x 6 RGB as vtkIBLRenderPass::CaptureProbe() gives it, with this probe's place, proxy,
   * influence and intensity in one OpenEXR file of six parts, which other tools show; and reads such a file: its light
   * becomes the Environment. False, with an error, when that fails; then an older file, or the probe, stays as it was.
   */
  bool WriteFile(const char* fileName, vtkImageData* radiance);
  bool ReadFile(const char* fileName);
  static bool CanReadFile(const char* fileName); // by its header
  ///@}

#ifndef __VTK_WRAP__
  ///@{
  /**
   * For vtkIBL's own classes. World coordinates of the proxy as rows of an affine matrix from the coordinates in which
   * it is the unit cube or ball; how long these coordinates' units are in the world; the influence volume's middle and
   * half extent in them; and how much of `bounds` along
   * each axis, multiplied, may lie in that volume: 0 is nothing, 1 all.
   */
  void GetWorldFromUnit(double rows[3][4]) const;
  void GetUnitLengths(double lengths[3]) const;
  void GetUnitInfluence(double middle[3], double half[3]) const;
  double GetReach(const double bounds[6]) const;
  double GetVolume() const; // of the influence; infinite without bounds
  vtkMTimeType GetCaptureTime() const
  {
    return this->CaptureTime.GetMTime();
  }
  void Count(int faces, int updates)
  {
    this->NumberOfCapturedFaces += faces;
    this->NumberOfUpdates += updates;
  }
  ///@}
#endif

protected:
  vtkIBLProbe();
  ~vtkIBLProbe() override;

private:
  vtkIBLProbe(const vtkIBLProbe&) = delete;
  void operator=(const vtkIBLProbe&) = delete;

  bool SetBox(const char* name, double target[6], const double bounds[6]);
  std::array<std::array<double, 3>, 3> GetAxes() const;

  double Position[3] = { 0.0, 0.0, 0.0 };
  int Proxy = Box;
  double Bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  double Orientation[3] = { 0.0, 0.0, 0.0 };
  bool OwnInfluence = false;
  double InfluenceBounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  double BlendDistance = -1.0;
  double Intensity = 1.0;
  vtkSmartPointer<vtkIBLEnvironment> Environment;
  int UpdateMode = OnChange;
  double UpdateInterval = 100.0;
  double TimeBudget = 0.0;
  int FadeFrames = 0;
  int Bounces = 0;
  vtkTimeStamp CaptureTime;
  vtkTypeInt64 NumberOfCapturedFaces = 0;
  vtkTypeInt64 NumberOfUpdates = 0;
};

#endif
