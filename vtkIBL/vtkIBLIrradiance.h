// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLIrradiance
 * @brief diffuse light as spherical-harmonic coefficients, for users, probes and export
 *
 * Projects the environment's radiance, as it was read, on real orthonormal harmonics: index l (l + 1) + m, no
 * Condon-Shortley sign, z the polar axis of the formulas: 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2 ... Irradiance is
 * that convolved with the clamped cosine, pi, 2 pi/3, pi/4, 0, -pi/24 ... a band (Ramamoorthi & Hanrahan 2001).
 * Intensity and Tint are not in it. All of it is made on the CPU, from lat-long images and from cube faces.
 */
#ifndef vtkIBLIrradiance_h
#define vtkIBLIrradiance_h

#include "vtkIBLStage.h"
#include "vtkSmartPointer.h"

#include <memory> // For std::unique_ptr

class vtkIBLEnvironment;

class VTKIBL_EXPORT vtkIBLIrradiance : public vtkIBLStage
{
public:
  static vtkIBLIrradiance* New();
  vtkTypeMacro(vtkIBLIrradiance, vtkIBLStage);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where the light comes from.
   */
  void SetEnvironment(vtkIBLEnvironment* environment);
  vtkIBLEnvironment* GetEnvironment() const;
  ///@}

  ///@{
  /**
   * The last band: 2, the default, 4 or 8; (order + 1)^2 coefficients. Odd bands above 1 give no irradiance, so there
   * is nothing between. Over eight HDRIs irradiance is off by 4.1 %, 1.7 % and 0.6 % of its mean, most of it beside
   * small bright lights, which too low an order smears over the far side.
   */
  void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * Keep bright texels out of the coefficients, and add their light in GetIrradiance() as that of points, exactly: what
   * a texel has above a thousandth of all light, and above 100 times the mean. Then it is off by 2.3 %, 0.8 % and 0.2
   * %. Default off. Without effect on cube faces.
   */
  void SetKeepBrightTexels(bool keep);
  vtkGetMacro(KeepBrightTexels, bool);
  vtkBooleanMacro(KeepBrightTexels, bool);
  ///@}

  ///@{
  /**
   * The coefficients of radiance [radiance x sr], RGB, in the environment's own frame; the cosine is not convolved in.
   * `index` is clamped to [0, GetNumberOfCoefficients() - 1]. Nine zeros before the first Update().
   */
  int GetNumberOfCoefficients() const;
  void GetRadianceCoefficient(int index, double rgb[3]) const;
  ///@}

  /**
   * The same as the world sees them, turned by the environment's Up, Right and Rotation as they are now: fills 3 x
   * GetNumberOfCoefficients() doubles. Turning the environment builds nothing.
   */
  void GetWorldCoefficients(double* rgb) const;

  ///@{
  /**
   * The texels that were kept out: unit direction in the environment's frame and the radiance that was taken; returns
   * the solid angle [sr]. `index` is in [0, GetNumberOfBrightTexels() - 1].
   */
  int GetNumberOfBrightTexels() const;
  double GetBrightTexel(int index, double direction[3], double radiance[3]) const;
  ///@}

  /**
   * Irradiance [radiance x sr] on a surface whose unit normal is `normal`, in the environment's own frame. Never
   * negative.
   */
  void GetIrradiance(const double normal[3], double rgb[3]) const;

  /**
   * Irradiance over pi of bands 0 to 2, bright texels in it, as seven vectors that a shader evaluates with a few dot
   * products (Sloan 2008, appendix A10): iblPackedIrradiance in shaders/vtkIBLHarmonicsFunctions.glsl. In the
   * environment's frame.
   */
  void GetPacked(float vectors[7][4]) const;

protected:
  vtkIBLIrradiance();
  ~vtkIBLIrradiance() override;

  bool UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime) override;
  vtkIBLStatistics* GetInputStatistics() const override;
  std::vector<vtkIBLStatistics::Work> Build(vtkOpenGLRenderWindow* window) override;
  void Release() override;

private:
  vtkIBLIrradiance(const vtkIBLIrradiance&) = delete;
  void operator=(const vtkIBLIrradiance&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
  vtkSmartPointer<vtkIBLEnvironment> Environment;
  int Order = 2;
  bool KeepBrightTexels = false;
};

#endif
